#include "genu/new_scene/new_side.h"

#include <cmath>

#include "genu/new_scene/fit_doubts.h"
#include "genu/new_scene/new_fibula.h"
#include "genu/new_scene/tolerances.h"
#include "genu/study/layout_doubts.h"

namespace genu {

Side side_of(const NewScene& asked, const KneeLayout& knee, const NewBones& bones, const KneeLandmarks& landmarks) {
  if (asked.left) return {*asked.left, "as you said"};
  if (landmarks.left) return {*landmarks.left, "by the names of the landmarks"};
  if (const auto left = landmarks.left_by_epicondyles(knee)) return {*left, "by the epicondyles"};
  if (const auto left = bones.fibula ? left_by_fibula(bones.fibula->mesh, knee) : std::nullopt)
    return {*left, "by the side of the fibula; --side says otherwise"};
  const auto seen = seems_left(knee);
  const Side by_shape{seen.value_or(false), why_this_side(knee) + "; --side says otherwise"};
  if (seen && std::abs(knee.ridge) + std::abs(knee.plateau) > kSideSure * knee.width) return by_shape;
  if (const auto left = fits_left(bones.femur_shape(), bones.tibia_shape(), knee))
    return {*left, "the reference knee fits better so; --side says otherwise"};
  return seen ? by_shape : Side{false, "not told by the meshes; --side left or right decides"};
}

}  // namespace genu
