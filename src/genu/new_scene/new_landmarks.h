// What landmarks that a person has placed say of a new knee: ends of ligaments, epicondyles, centres of joints, the
// side.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "genu/atlas/given_end.h"
#include "genu/core/diagnostics.h"
#include "genu/new_scene/knee_frames.h"
#include "genu/study/knee_layout.h"

namespace genu {

struct AskedLandmarks {
  std::string file{};
  double unit = 1e-3;   ///< m: of a table, whose numbers say none
  double error = 0;     ///< m: of points whose file states none; 0: kLandmarkError
  std::string space{};  ///< the frame that the meshes name; empty: none
};

struct KneeLandmarks {
  std::vector<GivenEnd> ends{};
  std::map<std::string, Vec3> places{};      ///< m: "medial epicondyle", "hip centre", ... as landmark_names.h has them
  std::map<std::string, FilePlace> where{};  ///< of ends and places, by name
  std::optional<bool> left{};                ///< which knee it is, by the names
  std::string turned{};  ///< how the file's frame was brought into that of the meshes; empty: as it is

  const Vec3* place(const std::string& name) const;
  /// m: from the medial to the lateral epicondyle; empty where one of them is missing.
  std::optional<Vec3> across() const;
  /// The axis of the files that is nearest to the direction from the ankle, or the knee, to the hip, or the knee.
  std::optional<Vec3> proximal() const;
  /// Which knee it is by its epicondyles.
  std::optional<bool> left_by_epicondyles(const KneeLayout& knee) const;
};

/// In the frame of the meshes. Names that mean nothing become warnings. Empty, with the reasons in `out`, where the
/// file is refused: it cannot be read, no name in it means anything, or names contradict each other.
[[nodiscard]] std::optional<KneeLandmarks> read_knee_landmarks(const AskedLandmarks& asked, const Mesh& femur,
                                                               const Mesh& tibia, Diagnostics& out);

/// Doubts, as warnings: points that are off the bones, or far from where the reference knee has them. `knee` is without
/// the landmarks.
void doubt_landmarks(const KneeLandmarks& landmarks, const Mesh& femur, const Mesh& tibia, const KneeLayout& knee,
                     bool left, Diagnostics& out);

/// The clinical description as a scene writes it: frame_words(), and origins under femur_origin and tibia_origin.
/// `frames` hold where no landmark says better.
std::map<std::string, std::string> clinical_words(const KneeLandmarks& landmarks, const KneeLayout& knee,
                                                  const KneeFrames& frames, bool left);

/// A line for the terminal.
std::string landmarks_choice(const KneeLandmarks& landmarks, const std::string& file);

}  // namespace genu
