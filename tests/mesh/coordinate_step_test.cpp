#include "genu/mesh/coordinate_step.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/surface/tessellate.h"
#include "support/sheet_mesh.h"

namespace genu {
namespace {

/// An ellipsoid in mm, its coordinates passed through `round`.
template <class Round>
CoordinateStep step_of(const Round& round, double away = 0) {
  Mesh mesh = geodesic_mesh({30, 20, 10}, 2);
  for (Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) v[k] = round(v[k] + away);
  return coordinate_step(mesh);
}

/// Through memory: GCC 12 at -O3 drops the rounding where it makes vectors of three such conversions.
double as_float(double x) {
  const volatile float rounded = static_cast<float>(x);
  return static_cast<double>(rounded);
}

TEST(CoordinateStep, IsWhatTheNumbersWereRoundedTo) {
  const CoordinateStep none = step_of([](double x) { return x; });
  EXPECT_EQ(none.decimal, 0);
  EXPECT_EQ(none.single, 0);
  for (const double decimals : {1e0, 1e1, 1e2, 1e4, 1e7}) {
    const CoordinateStep s = step_of([&](double x) { return std::round(x * decimals) / decimals; });
    EXPECT_DOUBLE_EQ(s.decimal, 1 / decimals);
  }
  const CoordinateStep single = step_of(as_float);
  EXPECT_EQ(single.decimal, 0);
  EXPECT_DOUBLE_EQ(single.single, std::ldexp(1, -19)) << "floats from 16 to 32";
  const CoordinateStep both = step_of([](double x) { return as_float(std::round(100 * x) / 100); });
  EXPECT_DOUBLE_EQ(both.decimal, 0.01) << "decimals saved as floats";
  EXPECT_DOUBLE_EQ(step_of(as_float, 1e6).single, 0.0625);
  EXPECT_EQ(step_of(as_float, 1e6).decimal, 0) << "there every float is nearly a multiple of everything";
}

TEST(CoordinateStep, APlateOnAGridIsNotRounded) {
  Mesh plate = test::bent_sheet(6, [](double u, double v) { return Vec3(6 * u, 6 * v, 0); });
  EXPECT_EQ(coordinate_step(plate).decimal, 0);
  plate.vertices[12].z() = 1;  // a hump: now the heights are whole numbers too
  EXPECT_EQ(coordinate_step(plate).decimal, 1);
}

}  // namespace
}  // namespace genu
