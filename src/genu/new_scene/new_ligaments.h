// The ligaments that `genu new` writes for two meshes.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "genu/atlas/fitted_knee.h"
#include "genu/new_scene/knee_frames.h"
#include "genu/results/result_table.h"
#include "genu/study/knee_layout.h"

namespace genu {

struct NewLigaments {
  std::string text;  ///< tables of a scene, in the frame of the meshes; lengths are words between @
  std::map<std::string, std::string> lengths;  ///< what stands for these words
  std::string note;                            ///< where they are from, for the scene's comment
  std::string choice;                          ///< the same for the terminal
  std::optional<std::string> turned;           ///< that the bones stand askew to the axes of their files
  std::optional<std::string> doubt;            ///< why the reference knee could not be laid on the bones
  std::optional<KneeFrames> frames;            ///< of the bones, where the reference knee fits
  std::optional<FittedKnee> fitted;            ///< the reference knee, where it fits
  double beside_fibula = 0;                    ///< m: put_on_fibula(), where there is one
  double misfit = 0;                           ///< m: sum of the median misfits of the reference knee on both meshes
};

/// Those of the reference knee where it fits on both meshes (bones where there are some, else cartilage), a fibre each
/// with the error of its insertions beside it; else five of common proportions. `bare`: what touches are these meshes
/// themselves, so that bones have no cartilage between them. `fibula`: null where there is none.
NewLigaments ligaments_of(const Mesh& femur, const Mesh& tibia, const Mesh* fibula, const KneeLayout& knee, bool left,
                          bool bare);

/// Settles slack lengths by the poses of passive flexion that were found with them: the largest strain of each fibre up
/// to kSettledFlexion is then that of its bundle, 0.015 to 0.08, and beyond not above kMostNewStrain. In the first
/// rounds (from 0) menisci settle too. Whether a length changed by more than kSettledLength.
bool settle_ligaments(const ResultTable& poses, int round, std::map<std::string, std::string>& lengths);

/// What stands between the braces of `reference`: the first pose of passive flexion that was found, in balance under a
/// small part of the load, to 0.01 mm and 0.01 deg. Empty where there is none.
std::string balanced_reference(const ResultTable& poses);

}  // namespace genu
