// A picture of a knee from six sides: bones, ends of ligaments with their errors, and landmarks, for a person to check.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

struct PictureEnd {
  Vec3 at = Vec3::Zero();  ///< m
  double error = 0;        ///< m: standard deviation; 0: none is known
  bool given = false;      ///< by a landmark
};
struct PictureFibre {
  std::string group;  ///< fibres of one name are drawn as one ligament
  PictureEnd femur, tibia;
};

struct KneePicture {
  std::vector<const Mesh*> femur, tibia;  ///< in one frame; of each the bone first, then its cartilage
  Vec3 anterior, proximal, lateral;       ///< unit
  Vec3 centre = Vec3::Zero();             ///< m: amid the plateau
  double width = 0;                       ///< m: of the tibia
  std::vector<PictureFibre> fibres;
  std::vector<std::pair<std::string, Vec3>> places;  ///< landmarks beside these
  std::string title;
  std::vector<std::string> notes;  ///< lines under the title
};

/// By what why_not_replaced() knows such a file.
inline constexpr const char* kKneePictureMark = "<!-- knee picture of genu new -->";

/// SVG. Anterior, posterior, medial and lateral views; the femur from below and the tibia from above, alone.
std::string knee_picture(const KneePicture& knee);

}  // namespace genu
