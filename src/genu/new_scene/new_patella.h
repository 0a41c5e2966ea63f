// The patella that `genu new` writes, where it is given a mesh of it: body, contact, ligaments and quadriceps.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "genu/atlas/fitted_knee.h"
#include "genu/core/diagnostics.h"
#include "genu/new_scene/new_words.h"
#include "genu/results/result_table.h"

namespace genu {

struct NewPatella {
  std::string text;  ///< tables of a scene, in the frame of the meshes; lengths are words between @; empty: none
  std::map<std::string, std::string> lengths;  ///< what stands for these words
  std::string ramp;                            ///< what grows with the load in the first step
  std::string unit;                            ///< of its mesh
  std::string choice;                          ///< what was found, for the terminal
};

/// That of `bones`, with the ligaments of the reference knee where that fits on femur and tibia (`fitted`). None where
/// none is asked for; none, with the reasons in `out`, where it cannot be a patella there: an error, or a warning where
/// only the reference does not fit. `words`: of the knee.
NewPatella patella_of(const NewScene& asked, const NewBones& bones, const std::optional<FittedKnee>& fitted,
                      const KneeLayout& knee, const Words& words, Diagnostics& out);

/// Lengthens fibres between femur and patella that strain by more than kMostNewStrain in the poses that were found:
/// they are straight here, and a long way round in the reference. Whether one changed.
bool settle_patella(const ResultTable& poses, std::map<std::string, std::string>& lengths);

}  // namespace genu
