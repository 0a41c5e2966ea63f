// NonsmoothPoints against differences of the wrench on both sides of them.
#include "genu/model/nonsmooth_points.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/model/linearization.h"
#include "support/scene_model.h"

namespace genu {
namespace {

using test::bone_on_ground;
using test::ligament;
using test::load;

/// The wrench on the bone after `twist` * h from the reference pose, at all load factors 1.
VecX wrench_after(const JointModel& model, const VecX& twist, double h) {
  State state = reference_state(model);
  state.pieces.clear();
  Correction by;
  by.resize(model.moving_count, 0, 0);
  by.twist = twist;
  State moved;
  EXPECT_TRUE(retract(model, state, by, h, moved));
  Target target;
  target.load_factors.assign(model.loads.size(), 1.0);
  Linearization at;
  linearize_forces(model, moved, target, at);
  return at.wrench;
}

std::vector<NonsmoothPoint> nonsmooth_points_of(const JointModel& model, double force = 0) {
  State state = reference_state(model);
  state.pieces.clear();
  Target target;
  target.load_factors.assign(model.loads.size(), 1.0);
  return nonsmooth_points_near(model, state, target, {.least = 1e-9, .most = 1e-6, .idle = force, .little = force});
}

/// What the derivative of the wrench jumps by, across each of many twists, is what the kinks say.
void expect_jumps(const JointModel& model) {
  const std::vector<NonsmoothPoint> kinks = nonsmooth_points_of(model);
  const Eigen::Index n = 6 * model.moving_count;
  double size = 0;
  for (const NonsmoothPoint& k : kinks) size += std::abs(k.above - k.below) * k.gradient.norm() * k.wrench.norm();
  for (Eigen::Index j = 0; j < n; ++j) {
    VecX twist = VecX::Unit(n, j);
    twist[(j + 2) % n] += 0.5;
    constexpr double h = 1e-8;
    const VecX here = wrench_after(model, twist, 0);
    const VecX forth = (wrench_after(model, twist, h) - here) / h, back = (here - wrench_after(model, twist, -h)) / h;
    VecX jump = VecX::Zero(n);
    for (const NonsmoothPoint& k : kinks) {
      const double rate = k.gradient.dot(twist);
      jump += (rate > 0 ? k.above - k.below : k.below - k.above) * rate * k.wrench;
    }
    EXPECT_LT((forth - back - jump).norm(), 1e-6 * size) << j;
  }
}

TEST(NonsmoothPoints, WhereALigamentBecomesTaut) {
  const auto s = test::scene_model(
      bone_on_ground("{ z = 20 }") +
      ligament("taut", "[3, 0, 5]", "[10, 20, -30]", "law = \"linear\"\nstiffness = 1000\nreference_strain = 0") +
      ligament("loose", "[0, 0, 0]", "[0, 0, -30]", "law = \"linear\"\nstiffness = 1000\nreference_strain = -0.01"));
  const auto kinks = nonsmooth_points_of(s.model);
  ASSERT_EQ(kinks.size(), 1U);
  EXPECT_EQ(kinks[0].below, 0);
  EXPECT_GT(kinks[0].above, 0);
  expect_jumps(s.model);
}

TEST(NonsmoothPoints, WhereATableBeginsAndEnds) {
  for (const char* points : {"[[0, 0], [0.1, 10]]", "[[-0.1, 10], [0, 0]]"}) {
    const auto s = test::scene_model(bone_on_ground("{ z = 20 }") + ligament("l", "[3, 0, 5]", "[10, 20, -30]",
                                                                             std::string("law = \"table\"\npoints = ") +
                                                                                 points + "\nreference_strain = 0"));
    ASSERT_EQ(nonsmooth_points_of(s.model).size(), 1U) << points;
    expect_jumps(s.model);
  }
}

TEST(NonsmoothPoints, AToeIsNoneButWhereItHardlyPulls) {
  const std::string text =
      bone_on_ground("{ z = 20 }") +
      ligament("l", "[3, 0, 5]", "[10, 20, -30]", "law = \"quadratic\"\nstiffness = 1000\nreference_strain = 1e-6");
  const auto s = test::scene_model(text);
  EXPECT_TRUE(nonsmooth_points_of(s.model).empty());
  const auto kinks = nonsmooth_points_of(s.model, 1e-8);  // it pulls with 1e-9 N
  ASSERT_EQ(kinks.size(), 1U);
  EXPECT_GT(kinks[0].here, 0);
  EXPECT_EQ(kinks[0].below, 0);
  EXPECT_EQ(kinks[0].above, 0);
}

std::string hinge(const std::string& more) {
  return "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[body.base]\nfixed = true\n[body.arm]\n"
         "[joint.h]\ntype = \"revolute\"\nparent = \"base\"\nchild = \"arm\"\naxis = [0, 1, 0]\n" +
         more;
}

TEST(NonsmoothPoints, AtTheStopOfAJoint) {
  for (const char* limits : {"{ from = 0, to = 20, stiffness = 2 }", "{ from = -20, to = 0, stiffness = 2 }"}) {
    const auto s = test::scene_model(hinge(std::string("stiffness = 0.5\nlimits = ") + limits + "\n"));
    ASSERT_EQ(nonsmooth_points_of(s.model).size(), 1U);
    expect_jumps(s.model);
  }
  const auto between = test::scene_model(hinge("limits = { from = -20, to = 20, stiffness = 2 }\n"));
  EXPECT_TRUE(nonsmooth_points_of(between.model).empty());
}

TEST(NonsmoothPoints, AtTheEndsOfALoadOverACoordinate) {
  for (const char* table : {"[[0, 0], [10, 1]]", "[[-10, 0], [0, 1]]"}) {
    const auto s = test::scene_model(hinge(std::string("stiffness = 0.5\n[load.w]\non = \"h.angle\"\nvalue = -1\n") +
                                           "scale = { over = \"h.angle\", table = " + table +
                                           " }\n[load.f]\nbody = \"arm\"\npoint = [10, 2, 30]\nforce = [3, 1, -2]\n" +
                                           "scale = { over = \"h.angle\", table = " + table + " }\n"));
    ASSERT_EQ(nonsmooth_points_of(s.model).size(), 2U);
    expect_jumps(s.model);
  }
}

}  // namespace
}  // namespace genu
