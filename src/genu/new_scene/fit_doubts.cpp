#include "genu/new_scene/fit_doubts.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "genu/new_scene/tolerances.h"

namespace genu {
namespace {

/// The smaller of both sides' misfits; nothing where the meshes cannot be laid out so.
std::optional<double> misfit_of(const Mesh& femur, const Mesh& tibia, const std::optional<KneeLayout>& knee) {
  if (!knee) return std::nullopt;
  return std::min(reference_misfit(femur, tibia, *knee, false), reference_misfit(femur, tibia, *knee, true));
}

}  // namespace

KneeAxes axes_of(const KneeLayout& knee, bool left) {
  return {knee.anterior, knee.proximal, left ? Vec3(-knee.right) : knee.right, knee.centre, knee.width,
          knee.gap,      knee.given};
}

double reference_misfit(const Mesh& femur, const Mesh& tibia, const KneeLayout& knee, bool left) {
  const FittedKnee fitted = fit_reference_knee(femur, tibia, axes_of(knee, left));
  return fitted.femur.median + fitted.tibia.median;
}

std::optional<bool> fits_left(const Mesh& femur, const Mesh& tibia, const KneeLayout& knee) {
  const double right = reference_misfit(femur, tibia, knee, false), left = reference_misfit(femur, tibia, knee, true);
  if (!(std::min(left, right) < kSideFits * std::max(left, right))) return std::nullopt;
  return left < right;
}

std::vector<LayoutDoubt> fit_doubts(const Mesh& femur, const Mesh& tibia, const KneeLayout& knee, double misfit) {
  std::vector<LayoutDoubt> out;
  if (misfit < kSmallMisfit) return out;
  const auto better = [&](const std::optional<double>& other) {
    return other && *other < kSideFits * kSideFits * misfit;
  };
  const auto numbers = [&](double other) {
    return fmt::format("the reference knee is off by {:.2g} mm then, and by {:.2g} mm as they are taken", 1e3 * other,
                       1e3 * misfit);
  };
  if (const auto swapped = misfit_of(tibia, femur, lay_out_knee(tibia, femur)); better(swapped))
    out.push_back({true, "are a tibia and a femur, exchanged: " + numbers(*swapped) +
                             ". Give the femur as --femur and the tibia as --tibia"});
  const Vec3 back = -knee.anterior;
  const auto turned = misfit_of(femur, tibia, lay_out_knee(femur, tibia, knee.proximal, back));
  if (out.empty() && better(turned))
    out.push_back({false, fmt::format("look as if anterior were {}, and not {}: {}. --anterior decides",
                                      axis_word(back), axis_word(knee.anterior), numbers(*turned))});
  return out;
}

}  // namespace genu
