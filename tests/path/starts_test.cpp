// Several equilibria of one joint, found from several starts, against closed forms.
#include "genu/path/starts.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

using test::bone_on_ground;
using test::contact;
using test::kNoTurn;
using test::scene_model;
using test::spring;
using test::step;
using test::surface;

constexpr double kAnchorDistance = 0.1, kEndOffset = 0.02, kSpringStiffness = 5e3;  // m, m, N/m

/// Two springs (5 N/mm) from the bone's origin to (-100, 0, height) and (100, 0, height) mm, at rest where their ends
/// lie 20 mm off the line between the anchors.
std::string two_springs(double y, double z) {
  const double slack = 1e3 * std::hypot(kAnchorDistance, kEndOffset);
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
  const double slack = std::hypot(kAnchorDistance, kEndOffset), squeezed = slack - kAnchorDistance;
  const double flat_energy = kSpringStiffness * squeezed * squeezed;
  // Second derivatives of 2 k/2 (l - l0)^2, l = sqrt(100^2 + h^2) mm: at h = 0 and at h = +-20 mm.
  const double flat_curvature = -2 * kSpringStiffness * squeezed / kAnchorDistance;
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
      EXPECT_NEAR(std::abs(h), kEndOffset, 1e-12);
      EXPECT_NEAR(*e.energy / flat_energy, 0, 1e-12);
    }
  }
  EXPECT_EQ(stable, 2);
  EXPECT_EQ(unstable, 1);
  EXPECT_EQ(starts, static_cast<std::size_t>(found.count));
  EXPECT_EQ(s.model.moving_count, 1);
}

TEST(Starts, AShallowTrussHasTwoStableStatesAndAFlatOne) {
  const auto s = scene_model(bone_on_ground("{ z = 1 }") + two_springs(0, 0) +
                             step("prescribe = { " + kNoTurn + ", \"j.x\" = 0, \"j.y\" = 0 }"));
  const StartSearch found = search(s, 16);
  expect_double_well(s, found, 5);
  EXPECT_TRUE(found.failed.empty());
}

TEST(Starts, ABallOnAFloorBetweenTwoWells) {
  const auto s = scene_model(bone_on_ground("{ y = 1, z = 20 }") + two_springs(0, 20) +
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

/// A ball of radius 5 mm on z = -0.03 x^2 + 1.5e-4 x^4 + 0.01 y^2 (mm), pulled by a spring of 2 N/mm from 4 mm below
/// its centre to 40 mm below the hump's top, rest length 20 mm, and two of 1 N/mm along y. With y = 0 and turns about y
/// alone it is a curve: the ball's centre x - 5 n(x), energy E(x, turn).
struct Hump {
  static double height(double x) { return -0.03 * x * x + 1.5e-4 * std::pow(x, 4); }
  static double slope(double x) { return -0.06 * x + 6e-4 * std::pow(x, 3); }
  static Vec3 centre(double foot) {
    const double s = slope(foot), norm = std::hypot(1, s);
    return {foot - 5 * s / norm, 0, height(foot) + 5 / norm};
  }
  /// N mm. A frictionless ball turns until its eccentric spring points at its centre: the end is 4 mm nearer.
  static double energy(double foot) {
    const Vec3 c = centre(foot);
    const double down = (c - Vec3(0, 0, -40)).norm() - 4 - 20, side = std::hypot(36, c.x(), c.z()) - 20;
    return 0.5 * 2 * down * down + 2 * 0.5 * side * side;
  }
};

/// "x = -10" where the run of a user began, far down the slope.
std::string hump(double x, double z) {
  const auto spring_to = [](const char* name, const char* from, const char* to, const char* stiffness) {
    return std::string("[ligament.") + name + "]\nfrom = { body = \"bone\", point = " + from +
           " }\nto = { body = \"ground\", point = " + to + " }\nlaw = \"spring\"\nstiffness = " + stiffness +
           "\nslack_length = 20\n";
  };
  return bone_on_ground(fmt::format("{{ x = {}, z = {} }}", x, z)) + surface("ball", "bone", "sphere", "radius = 5") +
         surface("land", "ground", "polynomial", "terms = [[2, 0, -0.03], [4, 0, 0.00015], [0, 2, 0.01]]") +
         contact("foot", "ball", "land") + spring_to("down", "[0, 0, -4]", "[0, 0, -40]", "2") +
         spring_to("left", "[0, 4, 0]", "[0, 40, 0]", "1") + spring_to("right", "[0, -4, 0]", "[0, -40, 0]", "1") +
         step("increments = 1");
}

TEST(Starts, ABallOverAHumpRollsToBothSides) {
  const auto s = scene_model(hump(-10, 4));
  const StartSearch found = search(s, 2);
  // The closed form's least energy right of the hump, by golden section.
  double low = 1, high = 10;
  for (int i = 0; i < 200; ++i) {
    const double a = high - 0.6180339887498949 * (high - low), b = low + 0.6180339887498949 * (high - low);
    if (Hump::energy(a) < Hump::energy(b))
      high = b;
    else
      low = a;
  }
  const double rest = Hump::centre(0.5 * (low + high)).x() * 1e-3;
  const double at_rest = Hump::energy(0.5 * (low + high)) * 1e-3, on_top = Hump::energy(0) * 1e-3;
  ASSERT_EQ(found.equilibria.size(), 3u);
  std::array<int, 3> seen{};
  for (const Equilibrium& e : found.equilibria) {
    const double x = e.pose.state.coordinates[0][3];
    ASSERT_TRUE(e.energy.has_value());
    std::printf("x %.9g mm (closed form 0 or %.9g), energy %.12g N mm, %s\n", 1e3 * x, 1e3 * rest, 1e3 * *e.energy,
                to_string(e.found));
    const bool top = std::abs(x) < 1e-6;
    ++seen[top ? 1 : x < 0 ? 0 : 2];
    EXPECT_EQ(e.stability.verdict, top ? Stability::Verdict::unstable : Stability::Verdict::stable);
    EXPECT_NEAR(std::abs(x), top ? 0 : rest, 1e-9);  // golden section finds a minimum to the root of rounding
    EXPECT_NEAR(*e.energy / (top ? on_top : at_rest), 1, 1e-9);
  }
  EXPECT_EQ(seen, (std::array<int, 3>{1, 1, 1}));
}

TEST(Starts, BesideASaddleLieTheStablePoses) {
  const auto s = scene_model(hump(0, 5));  // one start, which is the saddle itself
  const StartSearch found = search(s, 1);
  ASSERT_EQ(found.equilibria.size(), 3u);
  EXPECT_EQ(found.equilibria[0].stability.verdict, Stability::Verdict::unstable);
  EXPECT_EQ(found.equilibria[1].found, Equilibrium::Found::beside);
  EXPECT_EQ(found.equilibria[1].first_start, 1);
  EXPECT_NEAR(found.equilibria[1].pose.state.coordinates[0][3], -found.equilibria[2].pose.state.coordinates[0][3],
              1e-12);
}

TEST(Starts, TheKneeThatAMomentBendsIsBistable) {
  // The path by arc length passes 0.3 N m three times (and once in extension): at 57.5, 98.2 and 128.9 deg.
  const auto file = scene_model(test::knee("[load.M]\non = \"knee.flexion\"\n[[step]]\nload = { M = 0.3 }\n"));
  ContactField field(file.model);
  StartOptions options;
  options.count = 40;
  options.angle = 90 * std::numbers::pi / 180;
  options.translation *= 4.5;
  const StartSearch found = search_starts(file.model, field, test::target_of(file.scene),
                                          reference_state(file.model).coordinates, options, {});
  for (const double flexion : {57.5, 98.2, 128.9}) {
    const auto near = std::find_if(found.equilibria.begin(), found.equilibria.end(), [&](const Equilibrium& e) {
      return std::abs(e.pose.state.coordinates[0][0] * 180 / std::numbers::pi - flexion) < 0.1;
    });
    ASSERT_NE(near, found.equilibria.end()) << flexion;
    EXPECT_EQ(near->stability.verdict, flexion == 98.2 ? Stability::Verdict::unstable : Stability::Verdict::stable);
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
