#include "genu/assemble/build_surface.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

SurfaceDef definition(SurfaceDef::Shape shape) {
  SurfaceDef def;
  def.shape = shape;
  def.placement.p = Vec3(0, 0, 1);
  def.radius = 0.02;
  def.radii = Vec3(0.03, 0.03, 0.02);
  def.major_radius = 0.015;
  def.minor_radius = 0.005;
  def.terms = {{0, 0, 0.02}};
  return def;
}

TEST(BuildSurface, EveryShapeTakesItsSizesPlacementAndSide) {
  using Shape = SurfaceDef::Shape;
  const Vec3 x(0.04, 0, 1);  // 40 mm along x from the surface's origin
  const std::pair<Shape, double> expected[] = {{Shape::plane, 0},
                                               {Shape::sphere, 0.02},
                                               {Shape::ellipsoid, 0.01},
                                               {Shape::cylinder, 0.02},
                                               {Shape::torus, 0.02},
                                               {Shape::polynomial, -0.02},
                                               {Shape::cylindrical_polynomial, 0.02}};
  for (const auto& [shape, gap] : expected) {
    SurfaceDef def = definition(shape);
    const auto surface = make_analytic_surface(def);
    ASSERT_TRUE(surface) << static_cast<int>(shape);
    EXPECT_NEAR(surface->gap(x).value(), gap, 1e-15) << static_cast<int>(shape);
    def.inside = true;
    EXPECT_NEAR(make_analytic_surface(def)->gap(x).value(), -gap, 1e-15) << static_cast<int>(shape);
  }
}

TEST(BuildSurface, AMeshHasNoFormula) { EXPECT_FALSE(make_analytic_surface(definition(SurfaceDef::Shape::mesh))); }

TEST(BuildSurface, APatchLimitsTheSurfaceAndMustHoldAPartOfIt) {
  SurfaceDef def = definition(SurfaceDef::Shape::plane);
  def.patch.emplace();
  def.patch->box[0] = std::pair(-0.01, 0.02);
  EXPECT_TRUE(within_patch(make_analytic_surface(def), def)->is_unbounded());
  def.patch->box[1] = std::pair(-0.01, 0.01);
  const auto part = within_patch(make_analytic_surface(def), def);
  EXPECT_FALSE(part->is_unbounded());
  EXPECT_NEAR(part->edge_distance(Vec3(0.015, 0, 1)), 0.005, 1e-17);
  def.patch->box[2] = std::pair(0.01, 0.02);
  EXPECT_FALSE(within_patch(make_analytic_surface(def), def));
}

}  // namespace
}  // namespace genu
