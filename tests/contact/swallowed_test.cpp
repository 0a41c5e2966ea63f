// A surface inside another one that it does not cross: seen from either side, for closed and open surfaces.
#include "genu/contact/swallowed.h"

#include <gtest/gtest.h>

#include "contact/contact_pairs.h"
#include "genu/contact/proximity.h"
#include "genu/surface/blend_surface.h"
#include "genu/surface/patch.h"
#include "support/layers.h"

namespace genu {
namespace {

const Proximity::Options kDefaultOptions{};

std::unique_ptr<BlendSurface> blend(Mesh mesh) {
  Diagnostics out;
  auto surface = BlendSurface::build(std::move(mesh), {}, "mesh", out);
  EXPECT_TRUE(surface) << (out.items().empty() ? "" : to_string(out.items().front()));
  return surface;
}

Mesh ball_mesh(double radius) { return make_sphere({}, radius, false)->triangles(radius / 12, Vec3::Zero(), 1); }

/// The part of a mesh below the height z.
Mesh cap(Mesh mesh, double z) {
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return mesh.vertices[static_cast<std::size_t>(t[0])].z() > z ||
           mesh.vertices[static_cast<std::size_t>(t[1])].z() > z ||
           mesh.vertices[static_cast<std::size_t>(t[2])].z() > z;
  });
  return mesh;
}

/// The smallest gap as the solver sees it, whichever of the two is named first.
void expect_overlap(const Surface& a, const Surface& b, const Pose& X_ab, double at_least, const char* what) {
  Proximity ab(a, b, kDefaultOptions), ba(b, a, kDefaultOptions);
  EXPECT_LT(ab.smallest_sample_gap(X_ab), -at_least) << what;
  EXPECT_LT(ba.smallest_sample_gap(X_ab.inverse()), -at_least) << what << ", named the other way";
}

void expect_free(const Surface& a, const Surface& b, const Pose& X_ab, const char* what) {
  Proximity ab(a, b, kDefaultOptions), ba(b, a, kDefaultOptions);
  EXPECT_GE(ab.smallest_sample_gap(X_ab), 0) << what;
  EXPECT_GE(ba.smallest_sample_gap(X_ab.inverse()), 0) << what << ", named the other way";
}

TEST(Swallowed, AClosedBodyInsideALargerOne) {
  const auto large = blend(ball_mesh(0.03)), small = blend(ball_mesh(0.01)), alike = blend(ball_mesh(0.0292));
  const auto closed_form = make_sphere({}, 0.03, false);
  const Mat3 R = exp_rotation({1, 2, 3});
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.004, -0.003, 0.002), Vec3(0, 0.015, 0)}) {
    expect_overlap(*large, *small, {R, p}, 4e-3, "10 mm in 30 mm");
    expect_overlap(*closed_form, *small, {R, p}, 4e-3, "10 mm in a closed form of 30 mm");
  }
  // Everywhere within the band of the smooth surface, and facing the same way.
  expect_overlap(*large, *alike, {R, Vec3(1e-4, 0, 0)}, 5e-4, "0.8 mm of play, swallowed");
  for (const double apart : {0.0401, 0.05, 0.1}) expect_free(*large, *small, {R, {apart, 0, 0}}, "side by side");
}

TEST(Swallowed, ABallInItsSocketIsNot) {
  const auto ball = blend(ball_mesh(0.02));
  Mesh turned = ball_mesh(0.022);
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  const auto socket = blend(turned);
  const auto closed_form = make_sphere({}, 0.022, true);
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.001, 0, -0.001)}) {
    expect_free(*socket, *ball, {exp_rotation({1, 2, 3}), p}, "meshed socket");
    expect_free(*closed_form, *ball, {exp_rotation({1, 2, 3}), p}, "socket in closed form");
  }
}

TEST(Swallowed, OpenSheetsHaveTheirInsideBehindThem) {
  const auto plateau = blend(test::sheet(0.02, 20)), condyle = blend(cap(ball_mesh(0.015), -0.003));
  const auto patch =
      make_patch(make_plane({}, false), {}, {{{{{-0.02, 0.02}}, {{-0.02, 0.02}}, {}}}, {}}, {true, true, false});
  for (const double depth : {0.004, 0.011, 0.02, 0.03}) {
    // The lowest point of the condyle so far below the plateau.
    const Pose X{exp_rotation({0, 0, 1}), {0.002, 0.001, 0.015 - depth}};
    expect_overlap(*plateau, *condyle, X, 0.7 * depth, "a condyle's face behind a plateau");
    expect_overlap(*patch, *condyle, X, 0.7 * depth, "the same, the plateau in closed form");
  }
  for (const double height : {1e-4, 0.001, 0.01, 0.05}) {
    expect_free(*plateau, *condyle, {Mat3::Identity(), {0, 0, 0.015 + height}}, "above");
    expect_free(*plateau, *condyle, {Mat3::Identity(), {0.04, 0, height - 0.01}}, "beyond the edge");
  }
}

TEST(Swallowed, RemembersNothingWrong) {
  const auto large = blend(ball_mesh(0.03)), small = blend(ball_mesh(0.01));
  Proximity kept(*small, *large, kDefaultOptions);
  for (const double apart : {0.06, 0.05, 0.041, 0.02, 0.0, 0.02, 0.041, 0.03, 0.07, 0.001}) {
    Proximity fresh(*small, *large, kDefaultOptions);
    const Pose X{Mat3::Identity(), {apart, 0, 0}};
    const double then = kept.smallest_sample_gap(X), now = fresh.smallest_sample_gap(X);
    EXPECT_EQ(then < 0, now < 0) << apart;
    EXPECT_EQ(now < 0, apart < 0.04) << apart;
  }
}

}  // namespace
}  // namespace genu
