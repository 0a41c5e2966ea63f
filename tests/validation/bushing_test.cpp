// Bodies on bushings against closed forms: large turns, chains, a ring under pressure, a damped oscillation.
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "motion_scene.h"
#include "support/scenes.h"

namespace genu {
namespace {

using test::table_of;

std::string free_joint(const std::string& child, const std::string& parent, const std::string& reference) {
  return fmt::format(R"([body.{0}]
[joint.{0}]
type = "free"
parent = "{1}"
child = "{0}"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
reference = {2}
)",
                     child, parent, reference);
}

/// A block on a bushing whose axes are turned against the world's, 20 mm from the block's origin.
std::string block(const std::string& more) {
  return R"(format = 1
units = { length = "mm", angle = "rad" }
[body.ground]
fixed = true
)" + free_joint("block", "ground", "{ x = 10, y = -4, z = 30, a = 0.2, b = -0.1, c = 0.4 }") +
         R"([bushing.pad]
from = { body = "ground", origin = [10, -4, 50], x_axis = [1, 1, 0], z_axis = [1, -1, 2] }
to = { body = "block" }
)" + more;
}

TEST(Bushing, ABlockUnderAForceThroughItsFrameMovesByTheForceOverTheStiffness) {
  const Mat3 R = (Mat3() << Vec3(1, 1, 0).normalized(), Vec3(1, -1, 2).cross(Vec3(1, 1, 0)).normalized(),
                  Vec3(1, -1, 2).normalized())
                     .finished();
  const Vec3 force(30, -12, 55), stiffness(20, 30, 40);
  // Where the frame lies on the block at the reference: the block's own axes, by the joint's rotations.
  const Mat3 B = (Eigen::AngleAxisd(0.2, Vec3::UnitX()) * Eigen::AngleAxisd(-0.1, Vec3::UnitY()) *
                  Eigen::AngleAxisd(0.4, Vec3::UnitZ()))
                     .toRotationMatrix();
  const Vec3 point = B.transpose() * Vec3(0, 0, 20);
  const ResultTable t = table_of(
      block(fmt::format("stiffness = [20, 30, 40]\nrotation_stiffness = [2, 3, 4]\n[load.push]\nbody = \"block\"\n"
                        "force = [30, -12, 55]\npoint = [{:.17g}, {:.17g}, {:.17g}]\n[[step]]\nload = {{ push = [0, 1] "
                        "}}\nincrements = 4\n",
                        point.x(), point.y(), point.z())));
  ASSERT_EQ(t.rows(), 5u);
  const Vec3 moved = (R.transpose() * force).cwiseQuotient(stiffness);  // mm
  for (std::size_t row = 0; row < t.rows(); ++row)
    for (int i = 0; i < 3; ++i) {
      const std::string axis(1, "xyz"[i]);
      EXPECT_NEAR(t.number(row, "pad." + axis + "_mm"), moved[i] * static_cast<double>(row) / 4, 1e-10);
      EXPECT_NEAR(t.number(row, "pad.turn_" + axis + "_deg"), 0, 1e-9);
      EXPECT_NEAR(t.number(row, "pad.force_" + axis + "_N"), -(R.transpose() * force)[i] * static_cast<double>(row) / 4,
                  1e-9);
    }
}

/// With one stiffness about all axes the moment is that times the rotation vector, whatever its direction and size.
TEST(Bushing, ABlockUnderAMomentTurnsAboutItByALargeAngle) {
  const ResultTable t =
      table_of(block("stiffness = [20, 20, 20]\nrotation_stiffness = [2, 2, 2]\n[load.twist]\nbody = \"block\"\n"
                     "moment = [3, -2, 4]\n[[step]]\nload = { twist = [0, 1] }\nincrements = 10\n"));
  ASSERT_EQ(t.rows(), 11u);
  for (std::size_t row = 0; row < t.rows(); ++row) {
    const double angle =
        Vec3(t.number(row, "pad.turn_x_deg"), t.number(row, "pad.turn_y_deg"), t.number(row, "pad.turn_z_deg")).norm();
    EXPECT_NEAR(angle, to::kDegree * std::sqrt(29.0) / 2 * static_cast<double>(row) / 10, 1e-8)
        << "2.69 rad at the end";
    for (const char* axis : {"x", "y", "z"})
      EXPECT_NEAR(t.number(row, std::string("pad.force_") + axis + "_N"), 0, 1e-9);
  }
}

/// Near half a turn, where the moment jumps, the answer is doubted, and the judge declines.
TEST(Bushing, NearHalfATurnItIsDoubted) {
  const auto turned_to = [](int degrees) {
    return test::solution_of(fmt::format(R"(format = 1
units = {{ length = "mm", angle = "deg" }}
[body.ground]
fixed = true
{}[bushing.pad]
from = {{ body = "ground" }}
to = {{ body = "block" }}
stiffness = [20, 20, 20]
rotation_stiffness = [1, 1, 1]
[[step]]
prescribe = {{ "block.a" = [0, {}], "block.b" = 0, "block.c" = 0 }}
increments = 5
)",
                                         free_joint("block", "ground", "{}"), degrees));
  };
  EXPECT_EQ(turned_to(140).summary.exit_code, kExitOk);
  const Solution far = turned_to(178);
  EXPECT_EQ(far.summary.exit_code, kExitDoubtful);
  EXPECT_NE(far.summary.verdict.front().find("bushing pad turns by 178 deg"), std::string::npos);
}

/// A cantilever of blocks under an end moment: each bushing turns by M / k, so the tip by n M / k, an arc of a circle.
TEST(Bushing, AChainUnderAnEndMomentIsAnArc) {
  constexpr int kBlocks = 8;
  constexpr double kMoment = 0.6, kStiffness = 2.5;
  std::string scene = "format = 1\nunits = { length = \"mm\", angle = \"rad\" }\n[body.b0]\nfixed = true\n";
  for (int k = 1; k <= kBlocks; ++k) {
    const std::string before = fmt::format("b{}", k - 1), here = fmt::format("b{}", k);
    scene += free_joint(here, before, "{ x = 10 }") +
             fmt::format(
                 "[bushing.f{0}]\nfrom = {{ body = \"{1}\", origin = [10, 0, 0] }}\nto = {{ body = \"{2}\" }}\n"
                 "stiffness = [500, 200, 200]\nrotation_stiffness = [1, 4, {3}]\n",
                 k, before, here, kStiffness);
  }
  scene += fmt::format(
      "[load.bend]\nbody = \"b{}\"\nmoment = [0, 0, {}]\n[[step]]\nload = {{ bend = [0, 1] }}\n"
      "increments = 3\n",
      kBlocks, kMoment);
  const ResultTable t = table_of(scene);
  ASSERT_EQ(t.rows(), 4u);
  for (int k = 1; k <= kBlocks; ++k) {
    EXPECT_NEAR(t.number(3, fmt::format("b{}.c_deg", k)), to::kDegree * kMoment / kStiffness, 1e-8) << k;
    EXPECT_NEAR(t.number(3, fmt::format("f{}.moment_z_Nm", k)), -kMoment, 1e-10) << k;
    EXPECT_EQ(test::word(t, 3, "stability"), "stable");
  }
}

/// A ring of n pieces, each pushed outward by P: every section carries P / (2 sin(pi / n)), the hoop force p r of a
/// thin ring as n grows, and the ring grows by P / (4 k sin^2(pi / n)).
TEST(Bushing, ARingUnderPressureCarriesHoopForce) {
  constexpr int kPieces = 12;
  constexpr double kRadius = 20, kForce = 30, kStiffness = 400, kStep = 2 * std::numbers::pi / kPieces;
  std::string scene = "format = 1\nunits = { length = \"mm\", angle = \"rad\" }\n[body.ground]\nfixed = true\n", loads;
  for (int k = 0; k < kPieces; ++k) {
    const double c = std::cos(k * kStep), s = std::sin(k * kStep);
    scene +=
        free_joint(fmt::format("p{}", k), "ground",
                   fmt::format("{{ x = {:.17g}, y = {:.17g}, c = {:.17g} }}", kRadius * c, kRadius * s, k * kStep));
    // The face is half a step further on, its normal the ring's tangent there.
    const double half = kStep / 2, face = kRadius * std::cos(half);
    scene += fmt::format(
        "[bushing.h{0}]\nfrom = {{ body = \"p{0}\", origin = [{1:.17g}, {2:.17g}, 0], x_axis = [{3:.17g}, {4:.17g}, 0] "
        "}}\n"
        "to = {{ body = \"p{5}\" }}\nstiffness = [{6}, {6}, {6}]\nrotation_stiffness = [2, 2, 2]\n",
        k, face * std::cos(half) - kRadius, face * std::sin(half), -std::sin(half), std::cos(half), (k + 1) % kPieces,
        kStiffness);
    loads += fmt::format("[load.l{0}]\nbody = \"p{0}\"\nforce = [{1:.17g}, {2:.17g}, 0]\n", k, kForce * c, kForce * s);
  }
  scene +=
      loads +
      "[[step]]\nprescribe = { \"p0.x\" = 20, \"p0.y\" = 0, \"p0.z\" = 0, \"p0.a\" = 0, \"p0.b\" = 0, \"p0.c\" = 0 }\n";
  const ResultTable t = table_of(scene);
  ASSERT_GE(t.rows(), 1u);
  const double sine = std::sin(std::numbers::pi / kPieces), hoop = kForce / (2 * sine);
  for (int k = 0; k < kPieces; ++k) {
    EXPECT_NEAR(t.number(0, fmt::format("h{}.force_x_N", k)), -hoop, 1e-9) << k;
    EXPECT_NEAR(t.number(0, fmt::format("h{}.x_mm", k)), hoop / kStiffness, 1e-10) << k;
    EXPECT_NEAR(t.number(0, fmt::format("h{}.force_y_N", k)), 0, 1e-9) << k;
  }
  const double grown = kForce / (4 * kStiffness * sine * sine);
  EXPECT_NEAR(t.number(0, fmt::format("p{}.x_mm", kPieces / 2)), -kRadius - 2 * grown, 1e-9);
}

TEST(Bushing, ADampedBlockOscillates) {
  constexpr double kMass = 1.5, kStiffness = 90, kDamping = 3, kSpeed = 0.4;
  const Solution s = test::motion_of(test::kGround +
                                     R"([body.block]
mass = 1.5
inertia = [0.01, 0.02, 0.03]
[joint.j]
type = "free"
parent = "ground"
child = "block"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
[bushing.pad]
from = { body = "ground" }
to = { body = "block" }
stiffness = [90, 90, 90]
rotation_stiffness = [0.4, 0.4, 0.4]
damping = [3, 3, 3]
rotation_damping = [0.02, 0.02, 0.02]
)" + test::dynamics(2, 0.05, 1e-11, fmt::format("\"j.x\" = {}, \"j.b\" = 1.5", kSpeed)));
  const double delta = kDamping / (2 * kMass), omega = std::sqrt(kStiffness / kMass - delta * delta);
  const double delta_b = 0.02 / (2 * 0.02), omega_b = std::sqrt(0.4 / 0.02 - delta_b * delta_b);
  ASSERT_EQ(s.poses.rows(), 41u);
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    const double time = s.poses.number(row, "time_s");
    EXPECT_NEAR(s.poses.number(row, "j.x_mm"), 1e3 * kSpeed / omega * std::exp(-delta * time) * std::sin(omega * time),
                1e-5);
    EXPECT_NEAR(s.poses.number(row, "j.b_deg"),
                to::kDegree * 1.5 / omega_b * std::exp(-delta_b * time) * std::sin(omega_b * time), 1e-6);
    EXPECT_NEAR(s.poses.number(row, "energy.balance_J"), 0, 1e-8);
  }
}

}  // namespace
}  // namespace genu
