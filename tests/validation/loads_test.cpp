// Loads of every kind against closed forms, and on a knee against sums of forces made from the results alone.
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "support/scene_model.h"
#include "support/scenes.h"

namespace genu {
namespace {

using test::table_of;
using test::word;

/// A pendulum of 2 kg, 300 mm below its hinge, which turns about x alone.
constexpr double kTorque = 2 * 9.81 * 0.3;  // N m: m g l
std::string pendulum(const std::string& loads, const std::string& steps) {
  std::string text = test::bone_on_ground() + loads;
  text.insert(text.find("[body.ground]"), "gravity = [0, 0, -9.81]\n");
  text.insert(text.find("[body.bone]") + 12, "mass = 2\ncentre_of_mass = [0, 0, -300]\n");
  const std::string hinge =
      "prescribe = { \"j.b\" = 0, \"j.c\" = 0, \"j.x\" = 0, \"j.y\" = 0, \"j.z\" = 0 }\nincrements = 8\n";
  return text + "[[step]]\n" + hinge + steps;
}

TEST(Loads, APendulumUnderGravityHeldByAMoment) {
  const ResultTable t = table_of(pendulum("[load.hold]\non = \"j.a\"\nvalue = 4\n", "load = { hold = [0, 1.2] }\n"));
  ASSERT_EQ(t.rows(), 9u);
  for (std::size_t row = 0; row < t.rows(); ++row) {
    const double sine = 4 * 1.2 * static_cast<double>(row) / 8 / kTorque;
    EXPECT_NEAR(t.number(row, "j.a_deg") * units::kDegree, std::asin(sine), 1e-10) << row;
    EXPECT_NEAR(t.number(row, "stability.min_eigenvalue_Nmm"), 1e3 * kTorque * std::sqrt(1 - sine * sine), 1e-6) << row;
    EXPECT_NEAR(t.number(row, "j.z.reaction_N"), 2 * 9.81, 1e-9);
    EXPECT_NEAR(t.number(row, "j.y.reaction_N"), 0, 1e-9);
    EXPECT_EQ(word(t, row, "stability"), "stable");
  }
}

TEST(Loads, ASineInTimeSwingsThePendulumFromStepToStep) {
  const ResultTable t =
      table_of(pendulum("[load.drive]\non = \"j.a\"\nvalue = 2\n"
                        "scale = { sine = { amplitude = 1.5, frequency = 0.125, start = 1 } }\n",
                        "duration = 3\n[[step]]\nprescribe = { \"j.b\" = 0, \"j.c\" = 0, \"j.x\" = 0, \"j.y\" = 0, "
                        "\"j.z\" = 0 }\nincrements = 12\nduration = 6\n"));
  ASSERT_EQ(t.rows(), 21u);
  for (std::size_t row = 0; row < t.rows(); ++row) {
    const double k = static_cast<double>(row), time = row <= 8 ? 3 * k / 8 : 3 + 6 * (k - 8) / 12;
    const double drive = time < 1 ? 0 : 1.5 * std::sin(2 * std::numbers::pi * 0.125 * (time - 1));
    EXPECT_NEAR(t.number(row, "time_s"), time, 1e-12);
    EXPECT_NEAR(t.number(row, "drive.scale"), drive, 1e-12) << time;
    EXPECT_NEAR(t.number(row, "j.a_deg") * units::kDegree, std::asin(2 * drive / kTorque), 1e-10) << time;
  }
}

/// Springs that hold a body softly in all directions.
std::string soft_bed() {
  std::string text;
  int i = 0;
  for (const char* at : {"30, 0, 0", "-30, 0, 0", "0, 30, 0", "0, -30, 0", "0, 0, 30", "0, 5, -30"})
    text += test::ligament(fmt::format("bed_{}", ++i), fmt::format("[{}]", at), fmt::format("[{}]", at),
                           "law = \"spring\"\nstiffness = 2\nslack_length = 0");
  return text;
}

TEST(Loads, TowardAPointIsASpringOfConstantForce) {
  const std::string head = test::bone_on_ground() + soft_bed();
  const std::string toward = head +
                             test::load("pull",
                                        "point = [5, 8, 20]\nmagnitude = 50\n"
                                        "toward = { body = \"ground\", point = [40, -10, 60] }") +
                             "[[step]]\n";
  const std::string spring = head +
                             test::ligament("pull", "[5, 8, 20]", "[40, -10, 60]",
                                            "law = \"table\"\npoints = [[-0.99, 50], [9, 50]]\n"
                                            "slack_length = 50") +
                             "[[step]]\n";
  const ResultTable a = table_of(toward), b = table_of(spring);
  for (const char* column : {"j.a_deg", "j.b_deg", "j.c_deg", "j.x_mm", "j.y_mm", "j.z_mm"})
    EXPECT_LT(test::worst_difference(a, b, column), 1e-9) << column;
  EXPECT_LT(test::worst_difference(a, b, "stability.min_eigenvalue_Nmm"), 1e-6);
  EXPECT_GT(std::hypot(a.number(0, "j.x_mm"), a.number(0, "j.y_mm"), a.number(0, "j.z_mm")), 2);
}

TEST(Loads, AMomentScaledOverItsAngleIsASpring) {
  for (const double sign : {1.0, -1.0}) {
    const ResultTable t = table_of(test::bone_on_ground("{ a = 0.2 }") +
                                   fmt::format("[load.turn]\non = \"j.a\"\nvalue = {}\nscale = {{ over = \"j.a\", "
                                               "table = [[0, 1], [0.8, -1]] }}\n",
                                               3 * sign) +
                                   "[[step]]\nprescribe = { \"j.b\" = 0, \"j.c\" = 0, \"j.x\" = 0, \"j.y\" = 0, "
                                   "\"j.z\" = 0 }\n");
    ASSERT_GE(t.rows(), 1u);
    EXPECT_NEAR(t.number(0, "j.a_deg") * units::kDegree, 0.4, 1e-11);
    EXPECT_NEAR(t.number(0, "stability.min_eigenvalue_Nmm"), sign * 1e3 * 3 * 2 / 0.8, 1e-7);
    EXPECT_EQ(word(t, 0, "stability"), sign > 0 ? "stable" : "unstable");
    EXPECT_NEAR(t.number(0, "turn.scale"), 0, 1e-11);
  }
}

/// Forces f_x = c y and f_y = s c x on a body held by a spring k: K = [k, -c; -s c, k], with the eigenvalues
/// k +- c sqrt(s). Only s > 0 has a potential.
TEST(Loads, ForcesScaledOverEachOthersCoordinateMayFlutter) {
  for (const int s : {1, -1}) {
    const auto cross = [](const char* name, const char* force, const char* over) {
      return test::load(
          name, fmt::format("force = {}\nscale = {{ over = \"{}\", table = [[-10, -1], [10, 1]] }}", force, over));
    };
    const ResultTable t = table_of(
        test::bone_on_ground() +
        test::ligament("spring", "[0, 0, 0]", "[0, 0, 0]", "law = \"spring\"\nstiffness = 1\nslack_length = 0") +
        cross("along_x", "[5, 0, 0]", "j.y") + cross("along_y", s > 0 ? "[0, 5, 0]" : "[0, -5, 0]", "j.x") +
        "[[step]]\nprescribe = { \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0, \"j.z\" = 0 }\n");
    ASSERT_GE(t.rows(), 1u);
    EXPECT_NEAR(t.number(0, "stability.min_eigenvalue_Nmm"), s > 0 ? 100 - 50 : 100, 1e-9);
    EXPECT_EQ(word(t, 0, "stability"), s > 0 ? "stable" : "flutter");
  }
}

// The knee of two tori on two planes.

const std::array<const char*, 6> kCoordinates = {"knee.flexion_deg", "knee.adduction_deg", "knee.rotation_deg",
                                                 "knee.x_mm",        "knee.y_mm",          "knee.z_mm"};

Scene dortmans(const std::string& more) {
  const std::string file = test::dortmans_file();
  std::string text = test::read_file(file);
  text.replace(text.find("[[step]]"), std::string::npos, more);
  Diagnostics out;
  const auto scene = parse_scene(text, file, out);
  EXPECT_TRUE(scene.has_value()) << test::messages(out);
  return scene.value_or(Scene{});
}

TEST(Loads, OverFlexionIsTheSameAsFactorsAtThatFlexion) {
  const std::string force = "[load.push]\nbody = \"femur\"\nforce = [20, 60, -100]\npoint = [5, 0, 40]\n";
  const std::string bend = "[[step]]\nprescribe = { \"knee.flexion\" = [0, 60] }\nincrements = 6\n";
  const ResultTable over =
      test::solved(dortmans(force + "scale = { over = \"knee.flexion\", table = [[0, 0.2], [60, 1.4]] }\n" + bend))
          .poses;
  const ResultTable factors = test::solved(dortmans(force + bend + "load = { push = [0.2, 1.4] }\n")).poses;
  ASSERT_EQ(over.rows(), 7u);
  for (const char* column : kCoordinates) EXPECT_LT(test::worst_difference(over, factors, column), 1e-8) << column;
  for (const char* column : {"knee.flexion.reaction_Nm", "medial.force_N", "lateral.force_N", "AAC.force_N"})
    EXPECT_LT(test::worst_difference(over, factors, column), 1e-8) << column;
  // With the flexion held what it scales does not turn: the extra term of the tangent is projected out.
  EXPECT_LT(test::worst_difference(over, factors, "stability.min_eigenvalue_Nmm"), 1e-6);
  for (std::size_t row = 0; row < 7; ++row) EXPECT_NEAR(over.number(row, "push.scale"), 0.2 * (1 + double(row)), 1e-12);
}

/// What is left of all forces and moments (about the femur's origin) on the femur, from the columns of one row, the
/// points of the ligaments and the load's force in the world: tori on planes push up.
Vec6 left_over(const Scene& scene, const ResultTable& t, std::size_t row, const Vec3& load_force) {
  std::array<double, 6> q;
  for (std::size_t i = 0; i < 6; ++i) q[i] = t.number(row, kCoordinates[i]) * (i < 3 ? units::kDegree : 1e-3);
  const Eigen::AngleAxisd flexion(q[0], Vec3::UnitX()), adduction(q[1], Vec3::UnitY()), rotation(q[2], Vec3::UnitZ());
  const Mat3 R = (flexion * adduction * rotation).toRotationMatrix();
  const Vec3 p(q[3], q[4], q[5]);
  Vec6 sum = Vec6::Zero();
  const auto add = [&](const Vec3& force, const Vec3& arm) {
    sum.head<3>() += force;
    sum.tail<3>() += arm.cross(force);
  };
  for (const LigamentDef& l : scene.ligaments) {
    const Vec3 arm = R * l.from.point, pull = l.to.point - (p + arm);
    EXPECT_NEAR(t.number(row, l.name + ".length_mm"), 1e3 * pull.norm(), 1e-9);
    add(t.number(row, l.name + ".force_N") * pull.normalized(), arm);
  }
  for (const std::string side : {"medial", "lateral"}) {
    Vec3 at(0, 0, 0);
    for (int i = 0; i < 3; ++i) at[i] = 1e-3 * t.number(row, fmt::format("{0}.tibia_{0}.{1}_mm", side, "xyz"[i]));
    add(t.number(row, side + ".force_N") * Vec3::UnitZ(), at - p);
  }
  add(load_force, R * scene.loads[0].point);
  // The moment that works on the flexion alone: perpendicular to the axes of adduction and rotation.
  const Vec3 b2 = flexion * Vec3::UnitY(), b3 = flexion * adduction * Vec3::UnitZ(), dual = b2.cross(b3);
  sum.tail<3>() += t.number(row, "knee.flexion.reaction_Nm") / dual.x() * dual;
  return sum;
}

TEST(Loads, AForceFixedInTheWorldOrInTheFemurIsAnotherKnee) {
  const auto scene = [](const std::string& frame) {
    return dortmans("[load.push]\nbody = \"femur\"\nforce = [0, 60, -80]\npoint = [0, 0, 50]\nframe = \"" + frame +
                    "\"\n[[step]]\nprescribe = { \"knee.flexion\" = [0, 60] }\nincrements = 12\n");
  };
  const Vec3 force(0, 60, -80);  // 100 N
  const Scene world = scene("world"), body = scene("body");
  const ResultTable a = test::solved(world).poses, b = test::solved(body).poses;
  ASSERT_EQ(a.rows(), 13u);
  ASSERT_EQ(b.rows(), 13u);
  for (std::size_t row = 0; row < 13; ++row) {
    ASSERT_EQ(word(a, row, "status"), "ok");
    ASSERT_EQ(word(b, row, "status"), "ok");
    Mat3 R = Mat3::Identity();
    for (Eigen::Index i = 0; i < 3; ++i)
      R = R * Eigen::AngleAxisd(b.number(row, kCoordinates[static_cast<std::size_t>(i)]) * units::kDegree,
                                Mat3::Identity().col(i));
    const Vec6 dead = left_over(world, a, row, force), follower = left_over(body, b, row, R * force);
    EXPECT_LT(dead.head<3>().norm(), 1e-8) << row;
    EXPECT_LT(dead.tail<3>().norm(), 1e-9) << row;
    EXPECT_LT(follower.head<3>().norm(), 1e-8) << row;
    EXPECT_LT(follower.tail<3>().norm(), 1e-9) << row;
    EXPECT_NE(word(a, row, "stability"), "flutter") << "a dead force has a potential";
  }
  double apart_mm = 0, apart_deg = 0;
  for (const char* column : kCoordinates) {
    double& apart = std::string(column).ends_with("_mm") ? apart_mm : apart_deg;
    apart = std::max(apart, std::abs(a.number(12, column) - b.number(12, column)));
  }
  fmt::print("  at 60 deg the two knees are {:.2f} mm and {:.2f} deg apart\n", apart_mm, apart_deg);
  EXPECT_GT(apart_mm, 1);
  EXPECT_GT(apart_deg, 0.5);
}

}  // namespace
}  // namespace genu
