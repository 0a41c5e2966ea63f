// Several equilibria of one joint, found from several starts, against closed forms.
#include "genu/solver/starts.h"

#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/solved.h"

namespace genu {
namespace {

using test::bone_on_ground;
using test::contact;
using test::kNoTurn;
using test::scene_model;
using test::spring;
using test::step;
using test::surface;

constexpr double kHalf = 0.1, kRise = 0.02, kStiffness = 5e3;  // m, m, N/m

/// Two springs (5 N/mm) from the bone's origin to (-100, 0, height) and (100, 0, height) mm, at rest where their ends
/// lie 20 mm off the line between the anchors.
std::string truss(double y, double z) {
  const double slack = 1e3 * std::hypot(kHalf, kRise);
  const auto anchor = [&](int x) {
    return "[" + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) + "]";
  };
  return "[ligament.left]\nfrom = { body = \"bone\", point = [0, 0, 0] }\nto = { body = \"ground\", point = " +
         anchor(-100) + " }\nlaw = \"spring\"\nstiffness = 5\nslack_length = " + fmt::format("{:.17g}", slack) +
         "\n[ligament.right]\nfrom = { body = \"bone\", point = [0, 0, 0] }\nto = { body = \"ground\", point = " +
         anchor(100) + " }\nlaw = \"spring\"\nstiffness = 5\nslack_length = " + fmt::format("{:.17g}", slack) + "\n";
}

StartSearch search(const test::SceneModel& s, int count) {
  ContactField field(s.model);
  StartOptions options;
  options.count = count;
  return search_starts(s.model, field, test::target_of(s.scene), reference_state(s.model).coordinates, options, {});
}

/// Both shallow states, with the energy 0, and between them the flat one, which pushes the springs together.
void expect_double_well(const test::SceneModel& s, const StartSearch& found, std::size_t coordinate) {
  const double slack = std::hypot(kHalf, kRise), squeezed = slack - kHalf;
  const double flat_energy = kStiffness * squeezed * squeezed;
  // Second derivatives of 2 k/2 (l - l0)^2, l = sqrt(100^2 + h^2) mm: at h = 0 and at h = +-20 mm.
  const double flat_curvature = -2 * kStiffness * squeezed / kHalf;
  ASSERT_EQ(found.equilibria.size(), 3u);
  int stable = 0, unstable = 0;
  std::size_t starts = found.failed.size();
  for (const Equilibrium& e : found.equilibria) {
    starts += e.starts.size();
    const double h = e.pose.state.coordinates[0][coordinate];
    ASSERT_TRUE(e.energy.has_value());
    if (std::abs(h) < 1e-9) {
      ++unstable;
      EXPECT_EQ(e.stability.verdict, Stability::Verdict::unstable);
      EXPECT_NEAR(*e.energy / flat_energy, 1, 1e-9);
      EXPECT_NEAR(e.stability.smallest / (flat_curvature * 1e-4), 1, 1e-6);
    } else {
      ++stable;
      EXPECT_EQ(e.stability.verdict, Stability::Verdict::stable);
      EXPECT_NEAR(std::abs(h), kRise, 1e-12);
      EXPECT_NEAR(*e.energy / flat_energy, 0, 1e-12);
    }
  }
  EXPECT_EQ(stable, 2);
  EXPECT_EQ(unstable, 1);
  EXPECT_EQ(starts, static_cast<std::size_t>(found.count));
  EXPECT_EQ(s.model.moving_count, 1);
}

TEST(Starts, AShallowTrussHasTwoStableStatesAndAFlatOne) {
  const auto s = scene_model(bone_on_ground("{ z = 1 }") + truss(0, 0) +
                             step("prescribe = { " + kNoTurn + ", \"j.x\" = 0, \"j.y\" = 0 }"));
  const StartSearch found = search(s, 16);
  expect_double_well(s, found, 5);
  EXPECT_TRUE(found.failed.empty());
}

TEST(Starts, ABallOnAFloorBetweenTwoWells) {
  const auto s = scene_model(bone_on_ground("{ y = 1, z = 20 }") + truss(0, 20) +
                             surface("ball", "bone", "sphere", "radius = 20") + surface("floor", "ground", "plane") +
                             contact("foot", "ball", "floor") + test::load("weight", "force = [0, 0, -30]") +
                             step("prescribe = { " + kNoTurn + ", \"j.x\" = 0 }"));
  const StartSearch found = search(s, 16);
  expect_double_well(s, found, 4);
  std::printf("%zu of 16 starts find none\n", found.failed.size());
  EXPECT_LE(found.failed.size(), 3u);  // the box reaches deeper under the floor than the ball is high
  for (const Equilibrium& e : found.equilibria) {
    ASSERT_EQ(e.pose.state.contacts.size(), 1u);
    EXPECT_NEAR(e.pose.state.contacts[0].force, 30, 1e-9);
  }
}

TEST(Starts, TheKneeHasOneEquilibrium) {
  const auto s = scene_model(test::knee(step("prescribe = { \"knee.flexion\" = 20 }")));
  const StartSearch found = search(s, 12);
  EXPECT_EQ(found.equilibria.size(), 1u);
  ASSERT_FALSE(found.equilibria.empty());
  EXPECT_EQ(found.equilibria[0].starts.size() + found.failed.size(), 12u);
  EXPECT_EQ(found.equilibria[0].stability.verdict, Stability::Verdict::stable);
  std::printf("%zu of 12 starts reach it\n", found.equilibria[0].starts.size());
  EXPECT_GE(found.equilibria[0].starts.size(), 10u);
}

TEST(Starts, AStartWithoutEquilibriumIsSaid) {
  const auto s = scene_model(bone_on_ground() + test::load("push", "force = [0, 0, 1]") +
                             step("prescribe = { " + kNoTurn + ", \"j.x\" = 0, \"j.y\" = 0 }"));
  const StartSearch found = search(s, 3);
  EXPECT_TRUE(found.equilibria.empty());
  ASSERT_EQ(found.failed.size(), 3u);
  EXPECT_EQ(found.failed[2].start, 3);
  EXPECT_NE(found.failed[0].report.status, PoseStatus::ok);
}

TEST(Starts, TheSameEveryTime) {
  const auto s = scene_model(test::knee(step("prescribe = { \"knee.flexion\" = 10 }")));
  const StartSearch one = search(s, 5), two = search(s, 5);
  ASSERT_EQ(one.equilibria.size(), two.equilibria.size());
  for (std::size_t i = 0; i < one.equilibria.size(); ++i) {
    EXPECT_EQ(one.equilibria[i].starts, two.equilibria[i].starts);
    EXPECT_EQ(one.equilibria[i].pose.state.coordinates, two.equilibria[i].pose.state.coordinates);
    EXPECT_EQ(one.equilibria[i].energy, two.equilibria[i].energy);
  }
}

TEST(Starts, AStartThatOverlapsDeeplyIsDrawnBack) {
  // One start of the box is a ball far under the floor, which would come to rest there.
  const auto s = scene_model(test::held_ball(step("prescribe = { " + kNoTurn + ", \"j.x\" = 0 }"), 20));
  ContactField field(s.model);
  StartOptions options;
  options.count = 8;
  options.translation = 100;
  const StartSearch found =
      search_starts(s.model, field, test::target_of(s.scene), reference_state(s.model).coordinates, options, {});
  ASSERT_EQ(found.equilibria.size(), 1u);
  EXPECT_EQ(found.equilibria[0].starts.size() + found.failed.size(), 8u);
  EXPECT_NEAR(found.equilibria[0].pose.state.coordinates[0][5], 0.02, 1e-12);
}

TEST(Starts, VanDerCorput) {
  const double twos[] = {0.5, 0.25, 0.75, 0.125, 0.625}, threes[] = {1 / 3., 2 / 3., 1 / 9., 4 / 9., 7 / 9.};
  for (int i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(van_der_corput(i, 2), twos[i]);
    EXPECT_DOUBLE_EQ(van_der_corput(i, 3), threes[i]);
  }
}

TEST(Starts, OnlyFreeCoordinatesMoveAndStayInTheirBox) {
  const auto s = scene_model(test::knee(step("prescribe = { \"knee.flexion\" = 30 }")));
  const StartOptions options;
  const Target target = test::target_of(s.scene);
  const double box = options.translation * s.model.scales.length;
  const JointValues& reference = s.model.joints[0].reference;
  std::array<double, 6> low, high;
  low.fill(1);
  high.fill(-1);
  for (int k = 1; k <= 200; ++k) {
    const JointValues q = start_coordinates(s.model, target, {reference}, k, 1, options)[0];
    EXPECT_DOUBLE_EQ(q[0], 30 * std::numbers::pi / 180);
    for (std::size_t i = 1; i < 6; ++i) {
      const double share = (q[i] - reference[i]) / (i < 3 ? options.angle : box);
      if (k == 1) {
        EXPECT_EQ(share, 0);
      }
      low[i] = std::min(low[i], share);
      high[i] = std::max(high[i], share);
    }
  }
  for (std::size_t i = 1; i < 6; ++i) {
    EXPECT_GE(low[i], -1);
    EXPECT_LE(high[i], 1);
    EXPECT_LT(low[i], -0.97);
    EXPECT_GT(high[i], 0.97);
  }
}

}  // namespace
}  // namespace genu
