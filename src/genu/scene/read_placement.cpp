#include <Eigen/Geometry>

#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"

namespace genu {

namespace {

/// A unit vector, whatever the scale of the numbers given; the fallback where the key is absent or wrong.
Vec3 read_axis(ReadContext& context, const Item& item, const Vec3& fallback, bool& good) {
  // Its length means nothing, and so may be any.
  const NumberRule any{.unit = 1, .unit_name = {}, .above = {}, .at_least = {}, .largest = 1e300, .smallest = 0};
  const auto axis = read_vector(context, item, any);
  if (!axis) {
    good = good && !item;
    return fallback;
  }
  if (axis->isZero(0)) {
    refuse(context, item, Code::out_of_range, "an axis must not be zero");
    good = false;
    return fallback;
  }
  return axis->stableNormalized();
}

}  // namespace

Mat3 read_axes(ReadContext& context, Section& section) {
  Mat3 R = Mat3::Identity();
  const Item x_item = section.find("x_axis"), z_item = section.find("z_axis");
  bool good = true;
  Vec3 x = read_axis(context, x_item, Vec3::UnitX(), good);
  const Vec3 z = read_axis(context, z_item, Vec3::UnitZ(), good);
  if (!good) return R;
  if (x.cross(z).norm() < kParallelSine) {
    if (x_item) {
      refuse(context, x_item, Code::conflict,
             z_item ? "is parallel to z_axis" : "is parallel to the default z_axis [0, 0, 1]");
      return R;
    }
    x = Vec3::UnitY();
  }
  x = (x - x.dot(z) * z).normalized();
  R.col(0) = x;
  R.col(1) = z.cross(x);
  R.col(2) = z;
  return R;
}

Pose read_placement(ReadContext& context, Section& section) {
  const auto origin = read_vector(context, section.find("origin"), length_rule(context));
  return {read_axes(context, section), origin.value_or(Vec3::Zero())};
}

}  // namespace genu
