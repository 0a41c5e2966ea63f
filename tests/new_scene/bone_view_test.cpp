// A ball in front of a plate, as it looks from one side.
#include "genu/new_scene/bone_view.h"

#include <cmath>

#include <gtest/gtest.h>

namespace genu {
namespace {

Mesh plate() { return {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}; }

/// Of radius 0.5 about (0, 0, 0.6).
Mesh ball() {
  Mesh out;
  constexpr int kAround = 40, kDown = 20;
  for (int i = 0; i <= kDown; ++i)
    for (int j = 0; j < kAround; ++j) {
      const double a = 2 * 3.141592653589793 * j / kAround, b = 3.141592653589793 * i / kDown;
      out.vertices.emplace_back(0.5 * std::sin(b) * std::cos(a), 0.5 * std::sin(b) * std::sin(a),
                                0.6 + 0.5 * std::cos(b));
      if (i == kDown) continue;
      const int k = i * kAround + j, next = i * kAround + (j + 1) % kAround;
      out.triangles.push_back({k, k + kAround, next});
      out.triangles.push_back({next, k + kAround, next + kAround});
    }
  return out;
}

const ViewAxes kFront{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, kBack{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}};

TEST(BoneView, ShowsWhatIsNearest) {
  const Mesh first = plate(), second = ball();
  const std::vector<const Mesh*> meshes = {&first, &second};
  const BoneView front = view_of(meshes, kFront, {-1.5, -1.5}, {1.5, 1.5}, 0.01),
                 back = view_of(meshes, kBack, {-1.5, -1.5}, {1.5, 1.5}, 0.01);
  ASSERT_EQ(front.width, 300);
  const auto at = [](const BoneView& v, int x, int y) { return static_cast<std::size_t>(y * v.width + x); };
  EXPECT_EQ(front.mesh[at(front, 150, 150)], 1);
  EXPECT_NEAR(front.near[at(front, 150, 150)], 1.1, 1e-3);
  EXPECT_EQ(front.mesh[at(front, 60, 60)], 0);
  EXPECT_EQ(front.mesh[at(front, 10, 10)], -1);
  EXPECT_EQ(back.mesh[at(back, 150, 150)], 0);
  // As many pixels as the shapes are large.
  double of_ball = 0, of_plate = 0;
  for (const auto m : front.mesh) {
    if (m == 1) of_ball += 1e-4;
    if (m == 0) of_plate += 1e-4;
  }
  EXPECT_NEAR(of_ball, 3.1416 * 0.25, 0.01);
  EXPECT_NEAR(of_plate, 4 - 3.1416 * 0.25, 0.02);
}

TEST(BoneView, KnowsWhatCanBeSeen) {
  const Mesh first = plate(), second = ball();
  const std::vector<const Mesh*> meshes = {&first, &second};
  const BoneView front = view_of(meshes, kFront, {-1.5, -1.5}, {1.5, 1.5}, 0.01);
  EXPECT_TRUE(front.shows(kFront, {0, 0, 1.1}, 1e-3));
  EXPECT_FALSE(front.shows(kFront, {0, 0, 1.0}, 1e-3));
  EXPECT_FALSE(front.shows(kFront, {0, 0, 0}, 1e-3));
  EXPECT_TRUE(front.shows(kFront, {0.8, 0.8, 0}, 1e-3));
  EXPECT_TRUE(front.shows(kFront, {1.2, 1.2, -5}, 1e-3));  // nothing is there
  EXPECT_TRUE(front.shows(kFront, {9, 9, -5}, 1e-3));      // nor beyond the picture
}

TEST(BoneView, LightsFromAboveToTheLeft) {
  const Mesh mesh = ball();
  const std::vector<const Mesh*> meshes = {&mesh};
  const BoneView view = view_of(meshes, kFront, {-1, -1}, {1, 1}, 0.01);
  const auto light = [&](int x, int y) { return view.light[static_cast<std::size_t>(y * view.width + x)]; };
  EXPECT_GT(light(80, 75), light(120, 125));
  EXPECT_LE(light(100, 100), 1);
  EXPECT_GT(light(120, 125), 0);
}

}  // namespace
}  // namespace genu
