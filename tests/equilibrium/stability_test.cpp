// Eigenvalues of the tangent stiffness in closed form, and as the answer of the balanced joint to a small load.
#include "genu/equilibrium/stability.h"
#include "genu/model/build_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "genu/core/decompositions.h"
#include "genu/scene/centre_bodies.h"
#include "support/solved.h"

namespace genu {
namespace {

using test::bone_on_ground;
using test::contact;
using test::load;
using test::step;
using test::surface;
using Verdict = Stability::Verdict;

constexpr double kMetric = 0.01;  // m of translation count as 1 rad

/// The stability of a scene that is balanced as it stands, with pairs held closed at the points `at` (m, world).
Stability stability_of(const std::string& text, const std::vector<Vec3>& at = {}) {
  const auto s = test::scene_model(text);
  State state = reference_state(s.model);
  for (std::size_t i = 0; i < at.size(); ++i) test::hold(s.model, state, static_cast<int>(i), at[i]);
  const Target target = test::target_of(s.scene);
  Newton newton(s.model);
  const NewtonReport report = newton.solve(state, target, {});
  EXPECT_TRUE(report.converged()) << to_string(report.outcome);
  EXPECT_LE(report.iterations, 2);
  Linearization here;
  linearize(s.model, state, target, here);
  return assess_stability(here, s.model.scales.length);
}

/// All coordinates prescribed at 0 but the one named.
std::string all_but(const std::string& free) {
  std::string out;
  for (const char* name : {"x", "y", "z", "a", "b", "c"})
    if (free.find(name) == std::string::npos) out += (out.empty() ? "" : ", ") + std::string("\"j.") + name + "\" = 0";
  return step("prescribe = { " + out + " }");
}

TEST(Stability, SpringAlone) {
  const auto s = stability_of(bone_on_ground() + test::spring("s", "[0, 0, 0]", "[0, 0, 0]", 3, 0) + all_but("z"));
  EXPECT_EQ(s.free_motions, 1);
  EXPECT_NEAR(s.smallest, 3000 * kMetric * kMetric, 1e-13);
  EXPECT_EQ(s.verdict, Verdict::stable);
  EXPECT_FALSE(s.flutter);
  EXPECT_NEAR(std::abs(s.mode[2]), 1, 1e-12);
}

/// Six springs at rest, some with a weight that hangs or stands: bodies far from their origins are solved from another
/// one, but the eigenvalue stays that of twists about their own.
TEST(Stability, IsAboutTheBodysOwnOriginWhereverItIsSolvedFrom) {
  for (const bool unstable : {false, true}) {
    const auto s =
        test::scene_model(bone_on_ground("{ x = -1400 }") + test::spring("s1", "[1420, 10, 5]", "[20, 10, 45]", 3, 40) +
                          test::spring("s2", "[1390, 30, -5]", "[-10, 80, -5]", 4, 50) +
                          test::spring("s5", "[1415, -5, -30]", "[65, -5, -30]", 5, 50) +
                          test::spring("s6", "[1380, 15, 25]", "[-20, 45, 65]", 5, 50) +
                          test::spring("s3", "[1400, -20, 0]", "[30, -20, 0]", 5, 30) +
                          test::spring("s4", "[1405, 0, 20]", "[5, 20, 20]", unstable ? 1 : 6, 20) +
                          (unstable ? load("w", "force = [0, 0, -1000]\npoint = [1400, 0, 0]") +
                                          load("l", "force = [0, 0, 1000]\npoint = [1400, 0, -80]")
                                    : std::string()));
    const PlacedScene centred = place(s.source, choose_origins(s.source));
    ASSERT_GT(centred.origins[1].x(), 1.3);
    Diagnostics out;
    const auto model = build_model(centred, {}, out);
    ASSERT_TRUE(model.has_value());
    Stability found[2];
    const JointModel* models[] = {&s.model, &*model};
    for (int i = 0; i < 2; ++i) {
      Linearization here;
      linearize(*models[i], reference_state(*models[i]), test::target_of(s.scene), here);
      EXPECT_EQ(here.own_origins.size(), 3 * i);
      found[i] = assess_stability(here, 0.03);
    }
    EXPECT_NEAR(found[1].smallest / found[0].smallest, 1, 1e-7) << found[0].smallest;
    EXPECT_EQ(found[1].verdict, found[0].verdict);
    EXPECT_EQ(found[1].verdict, unstable ? Verdict::unstable : Verdict::stable);
  }
}

/// The metric about an origin 1 km or 1000 km away spans up to 16 decades; neither sign nor size may be lost in them.
TEST(Stability, KeepsSignAndSizeAboutAnOriginVeryFarAway) {
  double worst = 0;
  for (const double distance : {1e2, 1e3, 1e5, 1e6}) {
    for (int seed = 0; seed < 20; ++seed) {
      const auto number = [&](int i, int j) { return std::sin(1 + 3.7 * i + 1.3 * j + 0.9 * seed); };
      const MatX root = MatX::NullaryExpr(6, 6, [&](Eigen::Index i, Eigen::Index j) {
        return number(static_cast<int>(i), static_cast<int>(j)) + (i == j ? 3 : 0);
      });
      const Vec3 origin = distance * Vec3(number(7, 1), number(8, 1), number(9, 1)).normalized();
      Linearization at;
      at.wrench.setZero(6);
      at.stiffness.setZero(6, 6);
      at.gradient.setZero(0, 6);
      const MatX stiffness = root * root.transpose();  // J, in the metric
      const auto unit = [](Eigen::Index i) { return i < 3 ? kMetric : 1.0; };
      for (Eigen::Index i = 0; i < 6; ++i)
        for (Eigen::Index j = 0; j < 6; ++j) at.stiffness(i, j) = -stiffness(i, j) / unit(i) / unit(j);
      at.own_origins = origin;
      const Stability found = assess_stability(at, 0.03);
      EXPECT_EQ(found.verdict, Verdict::stable);
      // As large as the arm is, only turns count: the inverse of the largest response to a unit motion at the origin.
      Eigen::Matrix<double, 3, 6> arm = Eigen::Matrix<double, 3, 6>::Zero();
      arm << Mat3::Identity(), -skew(origin / kMetric);
      const MatX response = arm * stiffness.inverse() * arm.transpose();
      const double expected = 1 / symmetric_eigen(response).values[2];
      worst = std::max(worst, std::abs(found.smallest / expected - 1));
    }
  }
  EXPECT_LT(worst, 1e-6) << "relative error of the smallest eigenvalue";
}

/// Nothing but a weight and a contact: all motions are free of cost, and what rounding leaves of the terms that cancel
/// is neither a stiffness nor a complex pair.
TEST(Stability, BallOnAFloorIsNeutralWhereverItRollsTo) {
  for (int degrees = 0; degrees < 20; ++degrees) {
    const auto s =
        stability_of(bone_on_ground("{ a = " + std::to_string(degrees) + ", b = 7, z = 20, y = 0.3 }") +
                         surface("ball", "bone", "sphere", "radius = 20") + surface("floor", "ground", "plane") +
                         contact("c", "ball", "floor") + load("w", "force = [0, 0, -50]") +
                         step("prescribe = { \"j.a\" = " + std::to_string(degrees) + " }"),
                     {{0, 3e-4, 0}});
    EXPECT_EQ(s.verdict, Verdict::neutral) << degrees << " deg: " << s.smallest << " J";
    EXPECT_FALSE(s.flutter || s.complex_pair) << degrees;
  }
}

TEST(Stability, PendulumHangsStandsOrFloats) {
  // A weight of 50 N at the height h over its hinge: stiffness -50 N h.
  const auto pendulum = [](const std::string& h) {
    return stability_of(bone_on_ground() + load("w", "force = [0, 0, -50]\npoint = [0, 0, " + h + "]") + all_but("b"));
  };
  EXPECT_NEAR(pendulum("-30").smallest, 1.5, 1e-13);
  EXPECT_EQ(pendulum("-30").verdict, Verdict::stable);
  EXPECT_NEAR(pendulum("30").smallest, -1.5, 1e-13);
  EXPECT_EQ(pendulum("30").verdict, Verdict::unstable);
  EXPECT_EQ(pendulum("0").verdict, Verdict::neutral);
}

TEST(Stability, BallOnABallAndInABowl) {
  // The centre moves on a sphere of R + r or R - r: stiffness -+W / radius, with the contact's curvature in it.
  const double weight = 40;
  const auto on =
      stability_of(bone_on_ground("{ z = 30 }") + surface("ball", "bone", "sphere", "radius = 10") +
                       surface("hill", "ground", "sphere", "radius = 20") + contact("c", "ball", "hill") +
                       load("w", "force = [0, 0, -40]") + step("prescribe = { \"j.y\" = 0, " + test::kNoTurn + " }"),
                   {{0, 0, 0.02}});
  EXPECT_EQ(on.free_motions, 1);
  EXPECT_NEAR(on.smallest, -weight / 0.03 * kMetric * kMetric, 1e-12);
  EXPECT_EQ(on.verdict, Verdict::unstable);
  const auto in = stability_of(bone_on_ground("{ z = -15 }") + surface("ball", "bone", "sphere", "radius = 10") +
                                   surface("bowl", "ground", "sphere", "radius = 25\ninside = true") +
                                   contact("c", "ball", "bowl") + load("w", "force = [0, 0, -40]") +
                                   step("prescribe = { \"j.y\" = 0, " + test::kNoTurn + " }"),
                               {{0, 0, -0.025}});
  EXPECT_NEAR(in.smallest, weight / 0.015 * kMetric * kMetric, 1e-12);
  EXPECT_EQ(in.verdict, Verdict::stable);
}

TEST(Stability, RockingEggFollowsItsRollingRadius) {
  // An ellipse of half axes a (across) and c (upright) rocks over its radius a^2 / c with its centre c high: stiffness
  // W (a^2 / c - c), whichever way it is weighted.
  for (const double a : {12.0, 20.0, 31.0}) {
    const double c = 20;
    const auto s = stability_of(bone_on_ground("{ z = 20 }") +
                                    surface("egg", "bone", "ellipsoid", "radii = [" + std::to_string(a) + ", 15, 20]") +
                                    surface("floor", "ground", "plane") + contact("c", "egg", "floor") +
                                    load("w", "force = [0, 0, -40]") + all_but("bz"),
                                {Vec3::Zero()});
    EXPECT_EQ(s.free_motions, 1);
    const double exact = 40 * 1e-3 * (a * a / c - c);
    EXPECT_NEAR(s.smallest, exact, 1e-12) << a;
    EXPECT_EQ(s.verdict, exact == 0 ? Verdict::neutral : exact > 0 ? Verdict::stable : Verdict::unstable) << a;
  }
}

TEST(Stability, RockingCylinderOnACylinder) {
  // Rocking stone: radius r on radius R, centre of gravity h over the contact. Frictionless, x held: only the turn
  // about the roll's own axis is free, with the weight h - r over it.
  for (const double h : {3.0, 17.0}) {
    const auto s = stability_of(
        bone_on_ground("{ z = 30 }") +
            surface("roll", "bone", "cylinder", "z_axis = [0, 1, 0]\nx_axis = [1, 0, 0]\nradius = 10") +
            surface("base", "ground", "cylinder", "z_axis = [0, 1, 0]\nx_axis = [1, 0, 0]\nradius = 20") +
            contact("c", "roll", "base") +
            load("w", "force = [0, 0, -40]\npoint = [0, 0, " + std::to_string(h - 10) + "]") + all_but("bz"),
        {{0, 0, 0.02}});
    EXPECT_NEAR(s.smallest, -40e-3 * (h - 10), 1e-12) << h;
  }
}

TEST(Stability, FollowerLoadFlutters) {
  // Free: x and the turn b, held by a spring k at the height h; a load P along the body's own axis. In the metric
  //   K = [ k m^2, (k h -+ P) m; k h m, k h^2 ],   here [ 1, 1 -+ 3; 1, 1 ]: 1 +- i sqrt 2 or 1 +- 2.
  const auto follower = [](const std::string& p) {
    return stability_of(bone_on_ground() + test::spring("s", "[0, 0, 10]", "[0, 0, 10]", 10, 0) +
                        load("p", "force = [0, 0, " + p + "]\nframe = \"body\"") + all_but("bx"));
  };
  const Stability push = follower("300"), pull = follower("-300");
  EXPECT_TRUE(push.flutter);
  EXPECT_NEAR(push.smallest, 1, 1e-12);
  EXPECT_FALSE(pull.flutter);
  EXPECT_NEAR(pull.smallest, -1, 1e-12);
  EXPECT_EQ(pull.verdict, Verdict::unstable);
  // The same load constant in the world turns no force: the plain spring, singular about its own point, is left.
  EXPECT_FALSE(follower("0").flutter);
  EXPECT_STREQ(to_string(push), "flutter");
  EXPECT_STREQ(to_string(pull), "unstable");
  EXPECT_STREQ(to_string(follower("0")), to_string(follower("0").verdict));
}

TEST(Stability, FlutterIsToldBesideASofterMotion) {
  // The same, and the turn c against a spring so soft that the smallest eigenvalue is real.
  const Stability s = stability_of(bone_on_ground() + test::spring("s", "[0, 0, 10]", "[0, 0, 10]", 10, 0) +
                                   test::spring("soft", "[10, 0, 0]", "[10, 0, 0]", 0.1, 0) +
                                   load("p", "force = [0, 0, 300]\nframe = \"body\"") + all_but("bcx"));
  EXPECT_EQ(s.verdict, Verdict::stable);
  EXPECT_NEAR(s.smallest, 0.01, 1e-6);
  EXPECT_FALSE(s.flutter);
  EXPECT_STREQ(to_string(s), "flutter");
}

TEST(Stability, NothingFreeIsStable) {
  const auto model = test::scene_model(bone_on_ground() + all_but("z"));
  State state = reference_state(model.model);
  Target target = test::target_of(model.scene);
  target.prescribed.push_back({{0, 5}, 0});
  state.multipliers.assign(6, 0);
  Linearization here;
  linearize(model.model, state, target, here);
  const Stability s = assess_stability(here, model.model.scales.length);
  EXPECT_EQ(s.free_motions, 0);
  EXPECT_EQ(s.smallest, std::numeric_limits<double>::infinity());
  EXPECT_EQ(s.verdict, Verdict::stable);
  EXPECT_STREQ(to_string(s.verdict), "stable");
}

/// The joint pushed along its softest mode by a small load must yield by load / eigenvalue: contacts and the multiplier
/// of the prescribed angle curve on the way, so that an eigenvalue that leaves one of them out shows.
void expect_answer_to_a_load(const std::string& joint, const test::SceneModel& s, State state, const Target& target) {
  const auto metric = [](Eigen::Index i) { return i % 6 < 3 ? kMetric : 1.0; };
  Newton newton(s.model);
  ASSERT_TRUE(newton.solve(state, target, {}).converged());
  Linearization here;
  linearize(s.model, state, target, here);
  const Stability stability = assess_stability(here, s.model.scales.length);
  ASSERT_FALSE(stability.flutter);
  const double size = 1e-5;
  Vec6 motion;
  Pose moved[2];
  for (const int sign : {0, 1}) {
    JointModel pushed = s.model;
    Load push;
    push.body_a = 1;
    Vec6 wrench;
    for (Eigen::Index i = 0; i < 6; ++i)
      wrench[i] = (sign == 0 ? -size : size) * stability.smallest * stability.mode[i] / metric(i);
    push.force = wrench.head<3>();
    push.moment = wrench.tail<3>();
    pushed.loads.push_back(push);
    Target more = target;
    more.load_factors.push_back(1);
    State after = state;
    Newton again(pushed);
    ASSERT_TRUE(again.solve(after, more, {}).converged());
    moved[sign] = after.poses[1];
  }
  motion << (moved[1].p - moved[0].p) / (2 * size), log_rotation(moved[1].R * moved[0].R.transpose()) / (2 * size);
  for (Eigen::Index i = 0; i < 6; ++i)
    EXPECT_NEAR(motion[i] / metric(i), stability.mode[i], 1e-5)
        << joint << ", component " << i << " of " << stability.mode.transpose();
}

TEST(Stability, EigenvalueIsTheAnswerToALoad) {
  for (const double flexion : {10.0, 60.0}) {
    const auto k = test::solved_knee(flexion);
    EXPECT_GT(std::abs(k.pose.state.multipliers[0]), 0.1);  // N m: its curvature matters
    expect_answer_to_a_load("knee at " + std::to_string(flexion), k.scene, k.pose.state, k.target);
  }
}

}  // namespace
}  // namespace genu
