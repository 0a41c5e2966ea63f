// Elastic layers of curved bodies on a plane against integrals over the exact shapes: what smooth surfaces bring over
// the triangles of the same mesh. The table of docs/scene-reference.md is what this prints.
#include <cstdio>

#include <gtest/gtest.h>

#include "contact/layer_shapes.h"
#include "genu/core/pose.h"

namespace genu::layer_tests {
namespace {

constexpr double kThickness = 5e-3, kDelta = 1e-3, kReach = 15e-3;
const LayerLaw kLaw{LayerLaw::Kind::linear, 1e7};

struct LayerErrors {
  double force, area, peak;
};

/// Worst of several places of the bowl over the triangles.
LayerErrors worst(const ElasticLayer& layer, const Carried& truth) {
  LayerErrors out{0, 0, 0};
  for (int k = 0; k < 5; ++k) {
    const Pose X{exp_rotation(Vec3(0, 0, 0.3 * k)), Vec3(0.23e-3 * k, 0.31e-3 * k, -kDelta)};
    const Carried found = carried(layer, {}, X);
    out.force = std::max(out.force, std::abs(found.force / truth.force - 1));
    out.area = std::max(out.area, std::abs(found.area / truth.area - 1));
    out.peak = std::max(out.peak, std::abs(found.peak / truth.peak - 1));
  }
  return out;
}

TEST(LayerClosedForms, SmoothSurfacesAgainstTriangles) {
  const double K = kLaw.confined_modulus / kThickness;
  std::printf("| shape | triangles | summed over | force | area | largest pressure |\n|---|---|---|---|---|---|\n");
  const auto print = [](const Bowl& bowl, const Pressed& p, const char* over, const LayerErrors& e) {
    std::printf("| %s | %d | %s | %.3f %% | %.3f %% | %.3f %% |\n", bowl.name.c_str(), p.triangles, over, 100 * e.force,
                100 * e.area, 100 * e.peak);
  };
  for (const Bowl& bowl : {sphere(25e-3), ellipsoid(40e-3, 20e-3, 25e-3), torus(20e-3, 15e-3)})
    for (const double edge : {2.5e-3, bowl.name == "sphere" ? 1.25e-3 : 1.6e-3}) {
      const auto mesh = as_mesh(bowl, edge);
      const Pressed fine = smooth(mesh, edge, kReach, kLaw, kThickness, kThickness);
      const LayerErrors smooth_error = worst(*fine.layer, exact(bowl, kDelta, K));
      print(bowl, fine, "smooth surfaces", smooth_error);
      for (const bool from_bowl : {false, true}) {
        const Pressed flat = triangles(mesh, edge, kReach, kLaw, kThickness, kThickness, from_bowl);
        const LayerErrors error = worst(*flat.layer, exact(bowl, kDelta, K, from_bowl ? 1 : 0));
        print(bowl, flat, from_bowl ? "its triangles" : "the plane's triangles", error);
        EXPECT_LT(smooth_error.force, error.force) << bowl.name;
        EXPECT_LT(smooth_error.area, error.area) << bowl.name;
        EXPECT_LT(smooth_error.peak, error.peak) << bowl.name;
      }
      if (edge > 2e-3) continue;
      EXPECT_LT(smooth_error.force, 1e-3) << bowl.name;
      EXPECT_LT(smooth_error.area, 1e-3) << bowl.name;
      EXPECT_LT(smooth_error.peak, 1e-3) << bowl.name;
    }
}

/// Root mean square over places of the bowl, so that a lucky one tells nothing.
LayerErrors typical(const ElasticLayer& layer, const Carried& truth) {
  constexpr int kPlaces = 12;
  LayerErrors out{0, 0, 0};
  for (int k = 0; k < kPlaces; ++k) {
    const Pose X{exp_rotation(Vec3(0, 0, 0.5 * k)), Vec3(0.23e-3 * k, 0.31e-3 * k, -kDelta)};
    const Carried found = carried(layer, {}, X);
    out.force += std::pow(found.force / truth.force - 1, 2) / kPlaces;
    out.area += std::pow(found.area / truth.area - 1, 2) / kPlaces;
    out.peak += std::pow(found.peak / truth.peak - 1, 2) / kPlaces;
  }
  return {std::sqrt(out.force), std::sqrt(out.area), std::sqrt(out.peak)};
}

struct Refined {
  LayerErrors coarse, fine;
  double finer;  ///< edges of the coarse triangles over those of the fine ones
  LayerErrors order() const {
    const double step = std::log(finer);
    return {std::log(coarse.force / fine.force) / step, std::log(coarse.area / fine.area) / step,
            std::log(coarse.peak / fine.peak) / step};
  }
};

template <typename Press>
Refined refined(Press press, const Carried& truth) {
  const Pressed coarse = press(4e-3), fine = press(1e-3);
  return {typical(*coarse.layer, truth), typical(*fine.layer, truth),
          std::sqrt(static_cast<double>(fine.triangles) / coarse.triangles)};
}

/// Over smooth surfaces force and largest pressure are of fourth order (Richardson; the blend of a mesh is of fourth
/// order itself; of a closed form the largest pressure is exact), the area, cut off along straight lines, of the
/// second. Over triangles what their facets miss of the shape is of second order, and the area, a count of triangles,
/// of the first.
TEST(LayerClosedForms, OrderOfConvergence) {
  const double K = kLaw.confined_modulus / kThickness;
  for (const Bowl& bowl : {sphere(25e-3), ellipsoid(40e-3, 20e-3, 25e-3), torus(20e-3, 15e-3)}) {
    const Refined form =
        refined([&](double edge) { return smooth(bowl.surface, edge, kReach, kLaw, kThickness, kThickness); },
                exact(bowl, kDelta, K));
    const Refined blend =
        refined([&](double edge) { return smooth(as_mesh(bowl, edge), edge, kReach, kLaw, kThickness, kThickness); },
                exact(bowl, kDelta, K));
    const Refined flat = refined(
        [&](double edge) { return triangles(as_mesh(bowl, edge), edge, kReach, kLaw, kThickness, kThickness, true); },
        exact(bowl, kDelta, K, 1));
    const auto print = [&](const char* what, const Refined& r) {
      std::printf("%-10s %-12s force %.1e order %.1f, area %.1e order %.1f, peak %.1e order %.1f (x %.1f)\n",
                  bowl.name.c_str(), what, r.fine.force, r.order().force, r.fine.area, r.order().area, r.fine.peak,
                  r.order().peak, r.finer);
    };
    print("closed form", form), print("blend", blend), print("triangles", flat);
    EXPECT_GT(form.order().force, 3.5) << bowl.name;
    EXPECT_GT(form.order().area, 1.5) << bowl.name;
    EXPECT_LT(form.coarse.peak, 1e-9) << bowl.name;
    EXPECT_GT(blend.order().force, 3.5) << bowl.name;
    EXPECT_GT(blend.order().area, 2) << bowl.name;
    EXPECT_GT(blend.order().peak, 3.5) << bowl.name;
    EXPECT_GT(flat.order().force, 1.6) << bowl.name;
    EXPECT_GT(flat.order().area, 0.6) << bowl.name;
    EXPECT_GT(flat.order().peak, 1.4) << bowl.name;
    EXPECT_LT(form.fine.force, 5e-5) << bowl.name;
    EXPECT_LT(blend.fine.force, 2e-4) << bowl.name;
    EXPECT_LT(flat.fine.force, 3e-2) << bowl.name;
  }
}

TEST(LayerClosedForms, ParaboloidsOfWinkler) {
  // A shallow contact: F = pi K delta^2 sqrt(R1 R2), A = 2 pi delta sqrt(R1 R2), the largest pressure K delta.
  const double K = kLaw.confined_modulus / kThickness, delta = 1e-5;
  const struct {
    Bowl bowl;
    double R1, R2;
  } cases[] = {{sphere(25e-3), 25e-3, 25e-3},
               {ellipsoid(40e-3, 20e-3, 25e-3), 64e-3, 16e-3},
               {torus(20e-3, 15e-3), 35e-3, 15e-3}};
  for (const auto& c : cases) {
    const double root = std::sqrt(c.R1 * c.R2);
    const Carried all = exact(c.bowl, delta, K);
    EXPECT_NEAR(all.force / (std::numbers::pi * K * delta * delta * root), 1, 2 * delta / c.R2);
    EXPECT_NEAR(all.area / (2 * std::numbers::pi * delta * root), 1, 2 * delta / c.R2);
    const Pressed pressed = smooth(c.bowl.surface, 0.5e-3, 3e-3, kLaw, kThickness, kThickness);
    const Pose X{Mat3::Identity(), Vec3(0, 0, -delta)};
    EXPECT_NEAR(carried(*pressed.layer, {}, X, 2).force / all.force, 1, 1e-4) << c.bowl.name;
  }
}

}  // namespace
}  // namespace genu::layer_tests
