// All derivatives of all equations at once, by finite differences of the residual at states that solve nothing.
#include "genu/model/linearization.h"

#include <random>

#include <gtest/gtest.h>

#include "support/finite_difference.h"
#include "support/scene_model.h"
#include "support/transport.h"

namespace genu {
namespace {

using test::contact;
using test::ligament;
using test::load;
using test::surface;

/// All residuals in the order wrench, constraints, contacts.
VecX residual(const Linearization& at) {
  const Eigen::Index n = at.wrench.size(), m = at.constraint.size(), c = static_cast<Eigen::Index>(at.contacts.size());
  VecX out(n + m + 5 * c);
  out << at.wrench, at.constraint, VecX::Zero(5 * c);
  for (Eigen::Index i = 0; i < c; ++i)
    out.segment<5>(n + m + 5 * i) = at.contacts[static_cast<std::size_t>(i)].residual;
  return out;
}

/// Their derivatives to twists, multipliers and, for each contact, ds_A, ds_B and force, put together from the blocks.
MatX jacobian(const Linearization& at) {
  const Eigen::Index n = at.wrench.size(), m = at.constraint.size(), c = static_cast<Eigen::Index>(at.contacts.size());
  MatX J = MatX::Zero(n + m + 5 * c, n + m + 5 * c);
  J.topLeftCorner(n, n) = at.stiffness;
  J.block(n, 0, m, n) = at.gradient;
  J.block(0, n, n, m) = at.gradient.transpose();
  for (Eigen::Index i = 0; i < c; ++i) {
    const ContactBlock& block = at.contacts[static_cast<std::size_t>(i)];
    const Eigen::Index first = n + m + 5 * i;
    J.block<5, 4>(first, first) = block.d_surface;
    for (int side = 0; side < 2; ++side) {
      const int moving = at.contact_bodies[static_cast<std::size_t>(i)][static_cast<std::size_t>(side)];
      if (moving < 0) continue;
      J.block<5, 6>(first, 6 * moving) = block.d_twist.middleCols<6>(6 * side);
      J.block<6, 4>(6 * moving, first) = block.wrench_d_surface.middleRows<6>(6 * side);
      J.block<6, 1>(6 * moving, first + 4) = block.direction.segment<6>(6 * side);
    }
  }
  return J;
}

/// The residual after the change x of the unknowns, contact points' bases carried along.
VecX residual_after(const JointModel& model, const State& state, const Target& target, const VecX& x) {
  Correction change;
  const int m = static_cast<int>(constraint_count(model, target)) + held_count(state),
            c = static_cast<int>(state.contacts.size());
  change.resize(model.moving_count, m, c);
  const Eigen::Index n = 6 * model.moving_count;
  change.twist = x.head(n);
  change.multipliers = x.segment(n, m);
  for (int i = 0; i < c; ++i) {
    change.surface[static_cast<std::size_t>(i)] = x.segment<4>(n + m + 5 * i);
    change.forces[i] = x[n + m + 5 * i + 4];
  }
  State moved;
  EXPECT_TRUE(retract(model, state, change, 1, moved));
  for (std::size_t i = 0; i < state.contacts.size(); ++i) {
    const ContactGeometry& from = state.contacts[i].geometry;
    ContactGeometry& to = moved.contacts[i].geometry;
    to = {test::transported(from.a, to.a), test::transported(from.b, to.b)};
  }
  Linearization out;
  linearize(model, moved, target, out);
  return residual(out);
}

/// A state off every solution: bodies shaken, multipliers and forces set, one contact near its surfaces for each pair.
State shaken(const JointModel& model, const Target& target, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  State state = reference_state(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].moving < 0) continue;
    Vec6 twist;
    for (int i = 0; i < 6; ++i) twist[i] = (i < 3 ? 1e-3 : 0.1) * unit(random);
    state.poses[b] = retract(state.poses[b], twist);
  }
  update_coordinates(model, state);
  for (std::size_t m = 0; m < constraint_count(model, target); ++m) state.multipliers.push_back(20 * unit(random));
  for (int p = 0; p < static_cast<int>(model.pairs.size()); ++p) {
    const auto& pair = model.pairs[static_cast<std::size_t>(p)];
    const Pose &X_a = state.poses[static_cast<std::size_t>(pair.body_a)],
               &X_b = state.poses[static_cast<std::size_t>(pair.body_b)];
    ActiveContact c{p, 1, {}, 100 + 50 * unit(random)};
    // Any point of A, and a point of B about 2 mm from it.
    SurfacePoint a;
    EXPECT_TRUE(pair.a->project(Vec3(4e-3, 3e-3, -30e-3), a));
    c.geometry.a = a;
    EXPECT_TRUE(pair.b->project(X_b.inverse() * (X_a * a.p + 2e-3 * Vec3{unit(random), unit(random), unit(random)}),
                                c.geometry.b));
    state.contacts.push_back(c);
  }
  return state;
}

/// With `held` every ligament whose law jumps is held at its jump.
void expect_exact(const std::string& text, double time = 0, bool held = false) {
  const test::SceneModel s = test::scene_model(text);
  Target target = test::target_of(s.scene, 0.4);
  target.time = time;
  std::mt19937 random(17);
  for (int repeat = 0; repeat < 4; ++repeat) {
    State state = shaken(s.model, target, random);
    for (LigamentPiece& piece : state.pieces) {
      const auto& breaks = s.model.ligaments[static_cast<std::size_t>(piece.ligament)].law.sharp_breaks();
      piece.held = held && breaks.back().jumps();
      if (piece.held) piece.piece = static_cast<int>(breaks.size()) - 1, piece.force = 70;
    }
    ASSERT_EQ(held_count(state) > 0, held);
    Linearization at;
    linearize(s.model, state, target, at);
    const MatX exact = jacobian(at);
    const MatX difference = test::jacobian([&](const VecX& x) { return residual_after(s.model, state, target, x); },
                                           VecX::Zero(exact.cols()), 2e-5);
    // Entry against the largest of its row: rows are forces, moments, lengths or sines.
    for (Eigen::Index row = 0; row < exact.rows(); ++row) {
      const double scale = exact.row(row).cwiseAbs().maxCoeff();
      const double error = (exact.row(row) - difference.row(row)).cwiseAbs().maxCoeff();
      ASSERT_LT(error, 1e-7 * scale) << "row " << row << " of " << exact.rows() << "\n"
                                     << exact.row(row) << "\n"
                                     << difference.row(row);
      ASSERT_GT(scale, 0) << row;
    }
  }
}

const char* const kLoads = R"(
[load.push]
body = "bone"
force = [10, -20, -100]
moment = [0.3, 0.2, -0.4]
point = [3, 4, 5]
[load.follow]
body = "bone"
force = [-7, 30, -60]
moment = [0.2, -0.5, 0.1]
point = [-3, 6, 15]
frame = "body"
)";

TEST(Linearization, IsExactOnAKnee) {
  expect_exact(test::knee(kLoads) +
               "[[step]]\nprescribe = { \"knee.flexion\" = [10, 60], \"knee.rotation\" = 4, \"knee.y\" = 3 }\n"
               "load = { push = [0, 2] }\n");
}

TEST(Linearization, IsExactBetweenTwoMovingBodies) {
  std::string text = test::knee(kLoads) + R"(
[body.patella]
[joint.pf]
type = "free"
parent = "bone"
child = "patella"
rotations = ["tilt y", "spin x", "turn -z"]
translations = ["s", "t", "u"]
reference = { s = 2, t = 38, tilt = 5, turn = 8 }
)";
  text += surface("back", "patella", "ellipsoid", "radii = [12, 14, 16]") +
          surface("groove", "bone", "torus",
                  "x_axis = [0, 1, 0]\nz_axis = [1, 0, 0]\nmajor_radius = 30\nminor_radius = 6") +
          contact("pf", "back", "groove");
  text += R"([ligament.tendon]
from = { body = "patella", point = [1, 2, -14] }
to = { body = "bone", point = [0, 20, -50] }
law = "linear"
stiffness = 4000
reference_strain = 0.03
[ligament.quadriceps]
from = { body = "patella", point = [-1, 2, 14] }
to = { body = "ground", point = [0, 20, 80] }
law = "spring"
stiffness = 30
reference_force = 90
[load.pull]
body = "patella"
force = [1, 2, 50]
point = [3, 4, 5]
frame = "body"
)";
  expect_exact(
      text + "[[step]]\nprescribe = { \"knee.flexion\" = 20, \"pf.spin\" = 3, \"pf.turn\" = [0, 9], \"pf.s\" = 1 }\n");
}

/// A second moving body, and ligaments that run over all three on the way from one to another.
std::string ropes(const std::string& law) {
  return test::knee("") + R"(
[body.patella]
[joint.pf]
type = "free"
parent = "bone"
child = "patella"
rotations = ["tilt y", "spin x", "turn -z"]
translations = ["s", "t", "u"]
reference = { s = 2, t = 38, tilt = 5, turn = 8 }
[ligament.rope]
from = { body = "ground", point = [3, 30, -60] }
via = [{ body = "ground", point = [1, 40, -40] }, { body = "bone", point = [0, 25, -15] }, { body = "bone", point = [2, 30, -8] }, { body = "patella", point = [1, 2, -14] }, { body = "bone", point = [5, 30, 30] }]
to = { body = "patella", point = [-9, 4, 10] }
)" + law +
         "[[step]]\nprescribe = { \"knee.flexion\" = 20, \"pf.spin\" = 3 }\n";
}

TEST(Linearization, IsExactThroughViaPointsOnThreeBodies) {
  for (const char* law : {"law = \"quadratic\"\nstiffness = 3000\nreference_strain = 0.2\n",
                          "law = \"spring\"\nstiffness = 30\nreference_force = 90\n",
                          "law = \"linear\"\nstiffness = 3000\nreference_strain = 0.2\n"})
    expect_exact(ropes(law));
}

TEST(Linearization, IsExactWithALigamentHeldAtItsJump) {
  const std::string law =
      "law = \"abdel-rahman\"\nstiffness = 60\ntoe_stiffness = 2\ntransition_strain = 0.05\nreference_strain = "
      "0.05\n";
  expect_exact(ropes(law), 0, true);
  expect_exact(test::knee(test::ligament("held", "[10, 12, 5]", "[4, 20, -30]", law) +
                          "[[step]]\nprescribe = { \"knee.flexion\" = 20 }\n"),
               0, true);
}

/// A bone on a hinge with a spring, a plate fixed to it, and a rod free against the plate.
const char* const kJointsAndCombinations = R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.bone]
[body.plate]
[body.rod]
[joint.hinge]
type = "revolute"
parent = "ground"
child = "bone"
origin = [20, -10, 30]
axis = [1, 2, -2]
stiffness = 0.4
reference = { angle = 25 }
[joint.weld]
type = "fixed"
parent = "bone"
child = "plate"
origin = [5, 40, -8]
[joint.rod]
type = "free"
parent = "plate"
child = "rod"
rotations = ["a x", "b y", "c x"]
translations = ["x", "y", "z"]
reference = { b = 50, z = 15 }
[combination.coupled]
terms = { "hinge.angle" = 2, "rod.a" = -0.5, "rod.b" = 1.5 }
[combination.apart]
terms = { "rod.x" = 1, "rod.z" = -1 }
[ligament.tie]
from = { body = "rod", point = [3, 2, -14] }
to = { body = "ground", point = [0, 20, -50] }
law = "spring"
stiffness = 3
slack_length = 20
[[step]]
prescribe = { coupled = [10, 60], "rod.a" = 4, apart = 3 }
)";

TEST(Linearization, IsExactWithJointsAndCombinations) { expect_exact(std::string(kJointsAndCombinations) + kLoads); }

TEST(Linearization, IsExactWithLoadsOnAndOverHinges) {
  std::string text = kJointsAndCombinations;
  text.insert(text.find("[body.ground]"), "gravity = [1, 3, -9.81]\n");
  text.replace(text.find("[body.plate]"), 12, "[body.plate]\nmass = 4\ncentre_of_mass = [4, 5, 90]");
  expect_exact(text + R"([load.muscle]
on = "hinge.angle"
value = 3
scale = { over = "rod.b", table = [[-90, 1], [90, 3]] }
[load.follow]
body = "rod"
force = [-7, 30, -60]
frame = "body"
scale = { over = "hinge.angle", table = [[-90, 1], [90, 3]] }
)");
}

TEST(Linearization, ConstraintsAreSatisfiedAtTheReference) {
  const test::SceneModel s = test::scene_model(kJointsAndCombinations);
  State state = reference_state(s.model);
  Target target = test::target_of(s.scene);
  for (auto& p : target.prescribed) p.value = quantity_value(s.model, state.coordinates, p.coordinate);
  fit_multipliers(s.model, target, state);
  Linearization at;
  linearize(s.model, state, target, at);
  ASSERT_EQ(at.constraint.size(), 3 + 5 + 6);
  EXPECT_LT(at.constraint.cwiseAbs().maxCoeff(), 1e-15);
  // The tie does not pull at the bone: its wrench is the hinge's spring alone.
  const double angle = 25 * M_PI / 180, k = 0.4 * 180 / M_PI;
  const Vec3 axis = Vec3(1, 2, -2) / 3;
  EXPECT_LT((at.wrench.segment<3>(3) + k * angle * axis).norm(), 1e-13);
  EXPECT_LT(at.wrench.segment<3>(0).norm(), 1e-13);
}

TEST(Linearization, InternalForcesDoNoNetWork) {
  // Ligaments and contacts between the bodies of a world without a fixed part would balance; here the ground takes the
  // rest: the total wrench does not change when everything, ground included, is moved rigidly.
  const test::SceneModel s = test::scene_model(test::knee("[[step]]\nprescribe = { \"knee.flexion\" = 20 }\n"));
  const Target target = test::target_of(s.scene);
  std::mt19937 random(2);
  State state = shaken(s.model, target, random), moved = state;
  const Pose X{exp_rotation({0.3, 0.2, -1}), {0.1, -0.2, 0.05}};
  for (Pose& pose : moved.poses) pose = X * pose;
  Linearization at, there;
  linearize(s.model, state, target, at);
  linearize(s.model, moved, target, there);
  EXPECT_LT((X.R * at.wrench.head<3>() - there.wrench.head<3>()).norm(), 1e-11 * at.wrench.head<3>().norm());
  EXPECT_LT((X.R * at.wrench.tail<3>() - there.wrench.tail<3>()).norm(), 1e-10 * at.wrench.tail<3>().norm());
  EXPECT_NEAR(at.constraint[0], there.constraint[0], 1e-14);
}

/// Loads of every kind with every scale; the follower's size depends on a coordinate that it does not drive.
const char* const kScaledLoads = R"(
[load.drop]
body = "bone"
force = [5, -60, -40]
moment = [0.1, 0.2, -0.3]
point = [3, 4, 5]
frame = "body"
scale = { over = "knee.rotation", table = [[-20, 0.5], [0, 1], [20, 3]] }
[load.pull]
body = "bone"
point = [3, -4, 30]
toward = { body = "ground", point = [10, 50, 60] }
magnitude = 80
scale = { over = "knee.y", table = [[-5, 1], [2, 2], [8, 0.5]] }
[load.turn]
on = "knee.adduction"
value = 1.5
scale = { over = "time", table = [[0, 0], [1, 2], [3, 1]] }
[load.swing]
on = "knee.x"
value = -20
scale = { sine = { amplitude = 2, frequency = 0.4, start = 0.1 } }
)";

/// The knee of these loads, heavy.
std::string heavy_knee() {
  std::string text = test::knee(kScaledLoads);
  text.replace(text.find("[body.ground]"), 0, "gravity = [0, 3, -9.81]\n");
  text.replace(text.find("[body.bone]"), 11, "[body.bone]\nmass = 2.5\ncentre_of_mass = [4, 5, 90]");
  return text;
}

TEST(Linearization, IsExactWithLoadsOfEveryKind) {
  expect_exact(heavy_knee() + "[[step]]\nprescribe = { \"knee.flexion\" = [10, 60] }\nload = { pull = -1.5 }\n", 0.6);
}

TEST(Linearization, IsExactWithLoadsBetweenMovingBodies) {
  expect_exact(heavy_knee() + R"(
[body.patella]
mass = 0.1
[joint.pf]
type = "free"
parent = "bone"
child = "patella"
rotations = ["tilt y", "spin x", "turn -z"]
translations = ["s", "t", "u"]
reference = { s = 2, t = 38, tilt = 5, turn = 8 }
[load.tendon]
body = "patella"
point = [1, 2, -14]
toward = { body = "bone", point = [0, 20, -50] }
magnitude = 300
scale = { over = "knee.adduction", table = [[-30, 1], [30, 2]] }
[load.muscle]
on = "pf.turn"
scale = { over = "pf.s", table = [[-30, 1], [2, 5], [30, 2]] }
[load.lift]
on = "pf.u"
value = 40
[[step]]
prescribe = { "pf.tilt" = 3, "knee.flexion" = 20 }
)",
               1.3);
}

TEST(Linearization, LoadRateIsTheWrenchsDerivativeAlongAStep) {
  const test::SceneModel s = test::scene_model(heavy_knee() + test::step("load = { drop = [0.2, 2], turn = [1, -3] }"));
  const State state = reference_state(s.model);
  constexpr double kStart = 0.3, kDuration = 1.7;
  const auto target = [&](double t) {
    Target out = test::target_of(s.scene, t);
    out.time = kStart + kDuration * t;
    return out;
  };
  Target rate = target(0);
  rate.load_factors = {1.8, 0, -4, 0};
  rate.time = kDuration;
  const VecX fd = test::derivative(
      [&](double h) {
        Linearization at;
        linearize(s.model, state, target(0.37 + h), at);
        return VecX(at.wrench);
      },
      1e-3);
  const VecX exact = load_rate(s.model, state, target(0.37), rate);
  EXPECT_LT((exact - fd).cwiseAbs().maxCoeff(), 1e-8) << exact.transpose() << "\n" << fd.transpose();
  EXPECT_GT(exact.norm(), 100);
}

}  // namespace
}  // namespace genu
