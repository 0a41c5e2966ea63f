#include "genu/study/layout_doubts.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "genu/core/length_units.h"
#include "genu/core/units.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

/// m: how far a mesh reaches along `way`.
struct Extent {
  double low = 0, high = 0;
  double size() const { return high - low; }
  double middle() const { return (low + high) / 2; }
};

Extent extent_of(const Mesh& mesh, const Vec3& way) {
  Extent e{mesh.vertices.front().dot(way), mesh.vertices.front().dot(way)};
  for (const Vec3& p : mesh.vertices) {
    e.low = std::min(e.low, p.dot(way));
    e.high = std::max(e.high, p.dot(way));
  }
  return e;
}

/// A width (m) that no adult's tibia has, read from a file in units of so many metres, and the unit in which it would
/// have one.
std::string doubt_about_size(double width, double file_unit) {
  if (width >= kNarrowestTibia && width <= kWidestTibia) return {};
  std::string out = fmt::format("the tibia is {:.3g} mm wide, an adult's 60 to 95 mm", width / units::kMillimetre);
  for (const auto& [unit, metres] : kLengthUnits)
    if (const double other = metres * width / file_unit; other >= kNarrowestTibia && other <= kWidestTibia)
      return out +
             fmt::format(": in {} it would be {:.3g} mm. --units {} says so", unit, other / units::kMillimetre, unit);
  return out + ": check the unit of the meshes";
}

}  // namespace

std::vector<LayoutDoubt> doubts_about(const Mesh& femur, const Mesh& tibia, const KneeLayout& knee, double tibia_unit) {
  if (femur.vertices == tibia.vertices) return {{true, "are the same mesh: name a femur and a tibia"}};
  std::vector<LayoutDoubt> doubts;
  const std::string up = axis_word(knee.proximal);
  const double wide = extent_of(femur, knee.right).size() / extent_of(tibia, knee.right).size();
  if (wide > kMaxWidthRatio || wide < 1 / kMaxWidthRatio)
    doubts.push_back({true, fmt::format("one is {:.3g} times as wide as the other: are both in one unit?",
                                        std::max(wide, 1 / wide))});
  if (extent_of(femur, knee.proximal).middle() < extent_of(tibia, knee.proximal).middle())
    doubts.push_back({true, fmt::format("the femur lies below the tibia along {}: are the two swapped, or is "
                                        "--proximal the other way?",
                                        up)});
  else if (knee.facing < kMinFacing)
    doubts.push_back(
        {true, fmt::format("the femur lies over {:.0f} % of the tibia, seen along {}: are they in one frame, or is "
                           "--proximal another axis?",
                           100 * knee.facing, up)});
  else if (std::abs(knee.gap) > kMaxStartGap * knee.width)
    doubts.push_back({true, fmt::format("{} {:.0f} mm, a tibia {:.0f} mm wide: are they in one frame and one unit?",
                                        knee.gap > 0 ? "are apart by" : "reach into each other by",
                                        std::abs(knee.gap) / units::kMillimetre, knee.width / units::kMillimetre)});
  if (!doubts.empty()) return doubts;
  if (const std::string what = doubt_about_size(knee.width, tibia_unit); !what.empty()) doubts.push_back({false, what});
  for (const auto& [name, mesh] : {std::pair("femur", &femur), std::pair("tibia", &tibia)})
    if (mesh->triangles.size() < kFewKneeTriangles)
      doubts.push_back({false, fmt::format("the {} has {} triangles: what contact is on is made up of them alone", name,
                                           mesh->triangles.size())});
  return doubts;
}

std::optional<bool> seems_left(const KneeLayout& knee) {
  const double least = kSideTold * knee.width;
  if (knee.ridge > least && knee.plateau < -least) return false;
  if (knee.ridge < -least && knee.plateau > least) return true;
  return std::nullopt;
}

std::string why_this_side(const KneeLayout& knee) {
  const auto half = [](double right_less_left) { return right_less_left > 0 ? "right" : "left"; };
  return fmt::format(
      "the femur reaches {:.1f} mm further forward on its {} half, and the tibia is {:.1f} mm deeper from front to "
      "back "
      "on its {} half",
      std::abs(knee.ridge) / units::kMillimetre, half(knee.ridge), std::abs(knee.plateau) / units::kMillimetre,
      half(knee.plateau));
}

}  // namespace genu
