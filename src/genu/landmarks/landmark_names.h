// What the names of landmarks mean, in the spellings that people use.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace genu {

/// One end of a ligament, an epicondyle or the centre of a joint.
struct LandmarkMeaning {
  enum class Kind { ligament_end, medial_epicondyle, lateral_epicondyle, knee_centre, hip_centre, ankle_centre };
  Kind kind = Kind::ligament_end;
  std::string name;                    ///< "ACL femur": the same of all spellings
  std::vector<std::string> bundles{};  ///< of the reference knee, that end there
  bool femur = false;                  ///< of a ligament: else it ends on the tibia or the fibula
  bool fibula = false;
  std::optional<bool> left{};  ///< whose side the name says, where it says one
};

/// Empty where the name means nothing that is known. Any case; words in any order; "femur", "femoral", "fem", "origin",
/// ...; a number at the end tells points of one landmark apart; "left", "R", ... tell the side.
std::optional<LandmarkMeaning> meaning_of(std::string_view name);

/// The names of all landmarks that are known, in words for people.
std::string known_landmarks();

}  // namespace genu
