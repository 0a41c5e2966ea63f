#include "genu/model/surface_rates.h"

#include <cstdio>
#include <random>

#include <gtest/gtest.h>

#include "support/finite_difference.h"
#include "support/scene_model.h"

namespace genu {
namespace {

/// A point that stands still sees the gap fall by w and its foot's normal turn by -T grad w.
TEST(SurfaceRates, AreWhatAPointInSpaceSeesOfTheEditedSurface) {
  const std::string placed = "\norigin = [3, -2, 5]\nx_axis = [1, 2, 0]\nz_axis = [2, -1, 3]";
  const std::pair<const char*, const char*> shapes[] = {
      {"plane", ""},
      {"sphere", "radius = 12"},
      {"cylinder", "radius = 9"},
      {"ellipsoid", "radii = [10, 13, 17]"},
      {"torus", "major_radius = 15\nminor_radius = 5"},
      {"polynomial", "terms = [[0, 0, 1], [1, 0, 0.1], [2, 0, 0.02], [1, 1, 0.01], [0, 3, 0.0003], [2, 2, 0.00002]]"},
      {"polynomial",
       "chart = \"cylindrical\"\nterms = [[0, 0, 15], [1, 0, 0.5], [2, 0, -0.4], [1, 1, 0.02], [0, 2, 0.002]]"}};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> some(-8e-3, 8e-3);
  double worst = 0;
  int compared = 0;
  for (const auto& [shape, sizes] : shapes) {
    for (const char* side : {"", "\ninside = true"}) {
      const PlacedScene scene =
          test::scene_model(test::bone_on_ground() + test::surface("s", "bone", shape, sizes + placed + side)).scene;
      const SurfaceDef& def = scene.surfaces[0];
      for (int k = 0; k < 5; ++k) {
        SurfacePoint point;
        const Vec3 start =
            def.placement * (Vec3(9e-3, 6e-3, 4e-3) + Vec3{some(random), some(random), some(random)} / 2);
        ASSERT_TRUE(test::formula_surface(def)->project(start, point)) << shape;
        for (const Parameter& p : parameters_of(scene)) {
          if (!p.of_surface() || p.kind == Parameter::Kind::offset) continue;
          const SurfaceChange change = surface_change(def, p, point);
          const auto seen = test::derivative(
              [&](double share) {
                PlacedScene edited = scene;
                *parameter_number(edited, p) += share * p.change;
                SurfacePoint foot;
                EXPECT_TRUE(test::formula_surface(edited.surfaces[0])->project(point.p, foot));
                return Eigen::Vector3d(point.n.dot(foot.p - point.p), point.T.col(0).dot(foot.n),
                                       point.T.col(1).dot(foot.n));
              },
              0.01);
          const Vec3 told(p.change * change.w, -p.change * change.gradient[0], -p.change * change.gradient[1]);
          const double error = std::max(std::abs(told[0] - seen[0]) / 1e-3, (told - seen).tail<2>().norm() / 0.1);
          EXPECT_LT(error, 1e-8) << shape << side << " " << p.name << ": " << told.transpose() << " against "
                                 << seen.transpose();
          worst = std::max(worst, error);
          ++compared;
        }
      }
    }
  }
  std::printf("%d changes, worst error %.2g of 1 mm and 0.1\n", compared, worst);
  EXPECT_GT(compared, 300);
}

}  // namespace
}  // namespace genu
