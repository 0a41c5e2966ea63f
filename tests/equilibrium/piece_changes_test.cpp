// Ligaments that become taut or slack, pass a transition or meet a jump of their law: one free motion, exact answers.
#include "genu/equilibrium/piece_changes.h"
#include "genu/model/build_model.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

using test::follow;
using test::Followed;
using test::kNoTurn;
using Kind = PathEvent::Kind;

const std::string kUpright = "\"j.x\" = 0, \"j.y\" = 0, " + kNoTurn;

/// A bone that moves along z, held by a spring of `spring` N/mm which rests at z = 0, with a ligament `rope` from
/// 20 mm below, lifted by `lift` N.
std::string lifted(const std::string& law, const std::string& steps, double spring = 1) {
  return test::bone_on_ground("{ z = 0 }") + test::spring("s", "[0, 0, 0]", "[0, 0, -20]", spring, 20) +
         (law.empty() ? "" : test::ligament("rope", "[0, 0, 0]", "[0, 0, -20]", law)) +
         test::load("lift", "force = [0, 0, 1]") + steps;
}
std::string loads(double from, double to, int increments) {
  return test::step("prescribe = { " + kUpright + " }\nload = { lift = [" + std::to_string(from) + ", " +
                    std::to_string(to) + "] }\nincrements = " + std::to_string(increments));
}

double z_mm(const PosePoint& p) { return 1e3 * p.pose.state.poses[1].p.z(); }
double load_of(const PathEvent& e) { return e.target.load_factors[0]; }

struct KinkCase {
  std::string law;
  double length;  // mm: where it becomes taut
};

TEST(PieceChanges, TautAndSlackAreLocatedExactlyForEveryLaw) {
  const std::vector<KinkCase> cases = {
      {"law = \"quadratic\"\nstiffness = 2000\nslack_length = 25", 25},
      {"law = \"linear\"\nstiffness = 2e6\nslack_length = 25", 25},  // 80 000 times stiffer than the spring
      {"law = \"blankevoort\"\nstiffness = 2000\ntransition_strain = 0.5\nslack_length = 25", 25},
      {"law = \"abdel-rahman\"\nstiffness = 9\ntoe_stiffness = 3\ntransition_strain = 0.5\nslack_length = 25", 25},
      {"law = \"table\"\npoints = [[0.1, 0], [0.2, 50], [0.4, 200]]\nslack_length = 25", 27.5},
      {"law = \"table\"\npoints = [[0.1, 50], [0.2, 150]]\nslack_length = 25", 26.25}};
  double worst = 0;
  for (const KinkCase& c : cases) {
    const Followed w = follow(lifted(c.law, loads(0, 15, 3) + loads(15, 0, 3)));
    ASSERT_TRUE(w.result.complete) << c.law << "\n" << w.story();
    const auto taut = w.of(Kind::taut), slack = w.of(Kind::slack);
    ASSERT_EQ(taut.size(), 1u) << c.law << "\n" << w.story();
    ASSERT_EQ(slack.size(), 1u) << c.law << "\n" << w.story();
    EXPECT_EQ(taut[0].what, "rope");
    const double exact = c.length - 20;  // N, at 1 N/mm
    worst = std::max({worst, std::abs(load_of(taut[0]) - exact), std::abs(load_of(slack[0]) - exact)});
    for (const PosePoint& p : w.points) EXPECT_LE(p.report.iterations, 60) << c.law << " " << p.t;
  }
  EXPECT_LT(worst, 1e-6);
  RecordProperty("worst_N", std::to_string(worst));
}

TEST(PieceChanges, NewtonNeedsFewIterationsOnEitherSideOfAKink) {
  const std::string law = "law = \"linear\"\nstiffness = 2e6\nslack_length = 25";
  const Followed w = follow(lifted(law, loads(0, 15, 15)));
  ASSERT_TRUE(w.result.complete) << w.story();
  for (const PosePoint& p : w.points) {
    const double load = p.target.load_factors[0];
    const double z = load <= 5 ? load : (load + 8e4 * 5) / (1 + 8e4);
    EXPECT_NEAR(z_mm(p), z, 1e-9) << load;
    if (std::abs(load - 5.5) > 1) {
      EXPECT_LE(p.report.iterations, 3) << load;
    }
  }
}

TEST(PieceChanges, BlankevoortPassesItsTransition) {
  // Toe to line at L = 22 mm, F = 500 * 0.05 = 25 N with e_t = 0.1.
  const Followed w = follow(
      lifted("law = \"blankevoort\"\nstiffness = 500\ntransition_strain = 0.1\nslack_length = 20", loads(1, 41, 4)));
  ASSERT_TRUE(w.result.complete) << w.story();
  const auto passed = w.of(Kind::transition);
  ASSERT_EQ(passed.size(), 1u) << w.story();
  EXPECT_NEAR(load_of(passed[0]), 2 + 25, 1e-6);
}

// K2 = 0.25 N/mm^2, L0 = 16 mm, e_t = 0.5: the toe ends at L = 24 mm (z = 4 mm) with 16 N; the line begins there with
// 4 K1.
std::string abdel(double stiffness) {
  return "law = \"abdel-rahman\"\nstiffness = " + std::to_string(stiffness) +
         "\ntoe_stiffness = 0.25\ntransition_strain = 0.5\nslack_length = 16";
}
double toe_pose(double load) { return -6 + std::sqrt(20 + 4 * load); }  // z + (z + 4)^2 / 4 = load

TEST(PieceChanges, ARiseOfTheForceHoldsTheLigamentAtItsBreakUnderLoad) {
  const Followed w = follow(lifted(abdel(5), loads(1, 41, 20) + loads(41, 1, 20)));
  ASSERT_TRUE(w.result.complete) << w.story();
  ASSERT_EQ(w.points.size(), 41u);
  const auto held = w.of(Kind::held), passed = w.of(Kind::transition);
  ASSERT_EQ(held.size(), 2u) << w.story();
  ASSERT_EQ(passed.size(), 2u) << w.story();
  EXPECT_NEAR(load_of(held[0]), 20, 1e-6);
  EXPECT_NEAR(load_of(passed[0]), 24, 1e-6);
  EXPECT_NEAR(load_of(held[1]), 24, 1e-6);
  EXPECT_NEAR(load_of(passed[1]), 20, 1e-6);
  EXPECT_EQ(held[0].what, "rope at 24 mm, 16 N below and 20 N above");
  const test::SceneModel s = test::scene_model(lifted(abdel(5), ""));
  for (const PosePoint& p : w.points) {
    const double load = p.target.load_factors[0];
    const double z = load < 20 ? toe_pose(load) : load < 24 ? 4 : load / 6;
    EXPECT_NEAR(z_mm(p), z, 1e-9) << load;
    EXPECT_NEAR(show_ligament(s.model, p.pose.state, 1).force, load - z, 1e-9) << load;
    EXPECT_EQ(held_count(p.pose.state), load > 20 && load < 24 ? 1 : 0) << load;
  }
}

TEST(PieceChanges, AnyJumpIsCrossedUnderPrescribedLength) {
  for (const double stiffness : {5.0, 2.0}) {  // a rise to 20 N, a drop to 8 N
    const Followed w =
        follow(lifted(abdel(stiffness), test::step("prescribe = { \"j.z\" = [0.25, 8.25], \"j.y\" = 0, " + kNoTurn +
                                                   " }\nload = { lift = 0 }\nincrements = 16")));
    ASSERT_TRUE(w.result.complete) << w.story();
    const auto passed = w.of(Kind::transition);
    ASSERT_EQ(passed.size(), 1u) << w.story();
    EXPECT_TRUE(w.of(Kind::held).empty()) << w.story();
    EXPECT_TRUE(w.of(Kind::jump).empty()) << w.story();
    const auto z_prescribed = [](const PathEvent& e) { return 1e3 * e.target.prescribed[0].value; };
    EXPECT_NEAR(z_prescribed(passed[0]), 4, 1e-6);
    for (const PosePoint& p : w.points) {
      const double z = z_mm(p), rope = z < 4 ? (z + 4) * (z + 4) / 4 : stiffness * z;
      ASSERT_EQ(p.target.prescribed[0].coordinate.first.index, 5);
      EXPECT_NEAR(p.pose.state.multipliers[0], z + rope, 1e-9) << z;
    }
  }
}

TEST(PieceChanges, StepsUpAndDownAcrossAJumpNeverStallNewton) {
  // Some begin or end inside the held stretch, 20 to 24 N, or exactly where it begins and ends.
  std::string steps;
  const std::vector<std::pair<double, double>> ways = {{18, 26}, {26, 19}, {19, 22}, {22, 30}, {30, 20},
                                                       {20, 24}, {24, 23}, {23, 10}, {10, 24}, {24, 25}};
  for (const auto& [from, to] : ways) steps += loads(from, to, from < to ? 1 : 3);
  const Followed w = follow(lifted(abdel(5), steps));
  ASSERT_TRUE(w.result.complete) << w.story();
  int most = 0;
  for (const PosePoint& p : w.points) {
    const double load = p.target.load_factors[0];
    EXPECT_NEAR(z_mm(p), load < 20 ? toe_pose(load) : load < 24 ? 4 : load / 6, 1e-9) << load;
    most = std::max(most, p.report.iterations);
  }
  EXPECT_LE(most, 60) << "two events located on the way, in substeps of a few iterations each";
}

TEST(PieceChanges, PrescribedLengthsUpAndDownAcrossAJumpNeverStallNewton) {
  for (const double stiffness : {5.0, 2.0}) {  // a rise to 20 N, a drop to 8 N
    std::string steps;
    const std::vector<std::pair<double, double>> ways = {{3, 5}, {5, 3.5}, {3.5, 4}, {4, 4.5}, {4.5, 4}, {4, 3}};
    for (const auto& [from, to] : ways)
      steps += test::step("prescribe = { \"j.z\" = [" + std::to_string(from) + ", " + std::to_string(to) +
                          "], \"j.y\" = 0, " + kNoTurn + " }\nload = { lift = 0 }\nincrements = 1");
    const Followed w = follow(lifted(abdel(stiffness), steps));
    ASSERT_TRUE(w.result.complete) << w.story();
    int most = 0;
    for (const PosePoint& p : w.points) {
      const double z = 1e3 * p.target.prescribed[0].value;
      most = std::max(most, p.report.iterations);
      if (std::abs(z - 4) < 1e-9) continue;  // at the jump itself either side will do
      EXPECT_NEAR(p.pose.state.multipliers[0], z + (z < 4 ? (z + 4) * (z + 4) / 4 : stiffness * z), 1e-9) << z;
    }
    EXPECT_LE(most, 60);
  }
}

TEST(PieceChanges, ADropOfTheForceUnderLoadIsNamedAndTheNextEquilibriumFound) {
  const Followed w = follow(lifted(abdel(2), loads(1, 41, 20)));
  EXPECT_FALSE(w.result.complete);
  const auto jump = w.of(Kind::jump), snap = w.of(Kind::snaps);
  ASSERT_EQ(jump.size(), 1u) << w.story();
  ASSERT_EQ(snap.size(), 1u) << w.story();
  EXPECT_NEAR(load_of(jump[0]), 20, 1e-6);
  EXPECT_EQ(jump[0].what, "rope at 24 mm, 16 N below and 8 N above");
  EXPECT_EQ(snap[0].what, "to an equilibrium 2.7 mm and 0.0 deg away");  // from z = 4 to 20 / 3 mm
  const auto failed = std::find_if(w.points.begin(), w.points.end(), [](const PosePoint& p) { return !p.solved(); });
  ASSERT_NE(failed, w.points.end());
  EXPECT_EQ(failed->report.status, PoseStatus::no_equilibrium);
  EXPECT_NE(failed->report.why.find("rope"), std::string::npos) << failed->report.why;
}

TEST(PieceChanges, AColdStartFindsTheStateOfTheLawWhicheverItIs) {
  for (const double load : {3.0, 19.0, 21.0, 23.0, 25.0, 60.0}) {
    const Followed w = follow(lifted(abdel(5), loads(load, load, 1)));
    ASSERT_TRUE(w.result.complete) << load << "\n" << w.story();
    EXPECT_NEAR(z_mm(w.points[0]), load < 20 ? toe_pose(load) : load < 24 ? 4 : load / 6, 1e-9) << load;
  }
}

TEST(PieceChanges, SmoothPathsSeeNoEvent) {
  const Followed w = follow(lifted("law = \"quadratic\"\nstiffness = 2000\nslack_length = 15", loads(0, 20, 4)));
  ASSERT_TRUE(w.result.complete);
  EXPECT_TRUE(w.events.empty()) << w.story();
}

/// F = A (exp(b e) - 1) from the slack length on.
class Exponential final : public ForceLaw {
 public:
  LawValue evaluate(double length) const override {
    const double e = length / kSlack - 1;
    if (e <= 0) return {};
    return {kA * std::expm1(kB * e), kA * kB / kSlack * std::exp(kB * e), kA * kSlack * (std::expm1(kB * e) / kB - e)};
  }
  std::vector<LawBreak> breaks() const override { return {{kSlack, {0, 0, true}, {0, kA * kB / kSlack}}}; }
  std::optional<double> slack_length() const override { return kSlack; }
  static constexpr double kSlack = 0.022, kA = 3, kB = 8;
};

TEST(PieceChanges, ALawOfTheCallersOwnIsSolvedLikeAnyOther) {
  test::SceneModel s = test::scene_model(lifted("", loads(0, 30, 6)));
  std::string why;
  const auto law = LigamentLaw::custom(std::make_shared<Exponential>(), why);
  ASSERT_TRUE(law) << why;
  add_ligament(s.model, {"own", LigamentPath({{1, Vec3::Zero()}, {0, Vec3(0, 0, -0.02)}}), *law});
  const Followed w = follow(s.model, plan_steps(s.scene));  // no scene tells of this law: the judge would not know it
  ASSERT_TRUE(w.result.complete) << w.story();
  ASSERT_EQ(w.of(Kind::taut).size(), 1u) << w.story();
  EXPECT_NEAR(load_of(w.of(Kind::taut)[0]), 2, 1e-6);
  for (const PosePoint& p : w.points) {
    const double z = z_mm(p), e = (z + 20) / 22 - 1;
    EXPECT_NEAR(z + (e > 0 ? 3 * std::expm1(8 * e) : 0), p.target.load_factors[0], 1e-9) << z;
  }
}

/// The knee with one more ligament, whose force rises by a jump, bent and straightened.
Followed bend(double stiffness) {
  const std::string law = "law = \"abdel-rahman\"\nstiffness = " + std::to_string(stiffness) +
                          "\ntoe_stiffness = 3\ntransition_strain = 0.05\nreference_strain = 0.04";
  return follow(test::knee(test::ligament("jump", "[5, 14, 2]", "[3, 4, -35]", law) +
                           test::step("prescribe = { \"knee.flexion\" = [0, 60] }\nincrements = 12") +
                           test::step("prescribe = { \"knee.flexion\" = [60, 0] }\nincrements = 12")));
}

TEST(PieceChanges, AKneeBendsThroughAHeldStretchAndBack) {
  const Followed w = bend(40);
  ASSERT_TRUE(w.result.complete) << w.story();
  const auto held = w.of(Kind::held), passed = w.of(Kind::transition);
  ASSERT_EQ(held.size(), 2u) << w.story();
  ASSERT_EQ(passed.size(), 2u) << w.story();
  EXPECT_LT(held[0].t, passed[0].t);
  EXPECT_NEAR(held[0].t, 1 - passed[1].t, 1e-7) << "let go on the way back where it was caught";
  EXPECT_NEAR(passed[0].t, 1 - held[1].t, 1e-7);
  for (std::size_t i = 0; i < 12; ++i) {
    const State &there = w.points[i].pose.state, &back = w.points[24 - i].pose.state;
    EXPECT_LT((there.poses[1].p - back.poses[1].p).norm(), 1e-10) << i;
    EXPECT_EQ(held_count(there), held_count(back)) << i;
  }
}

/// An ellipsoidal knee whose collateral ligament loses 98 N at 46.8311292 deg of flexion: adduction leaps by 2.2 deg.
/// `steps` bend it from wherever they like.
Followed leap(const std::string& steps) {
  const auto ellipsoid = [](const std::string& name, int x, int y_radius) {
    return "[surface." + name + "]\nbody = \"femur\"\nshape = \"ellipsoid\"\norigin = [" + std::to_string(x) +
           ", 0, 0]\nradii = [12, " + std::to_string(y_radius) + ", 20]\n[contact.c_" + name + "]\nsurfaces = [\"" +
           name + "\", \"plateau\"]\nmodel = \"rigid\"\n";
  };
  const auto fibre = [](const std::string& name, const std::string& from, const std::string& to,
                        const std::string& law) {
    return "[ligament." + name + "]\nfrom = { body = \"femur\", point = " + from +
           " }\nto = { body = \"tibia\", point = " + to + " }\n" + law + "\n";
  };
  return follow(
      "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[body.tibia]\nfixed = true\n[body.femur]\n"
      "[joint.knee]\ntype = \"free\"\nparent = \"tibia\"\nchild = \"femur\"\n"
      "rotations = [\"flexion x\", \"adduction y\", \"rotation z\"]\ntranslations = [\"x\", \"y\", \"z\"]\n"
      "reference = { z = 20 }\n[surface.plateau]\nbody = \"tibia\"\nshape = \"polynomial\"\n"
      "terms = [[0, 0, 0], [2, 0, 0.0005], [0, 2, 0.005]]\npatch = { x = [-40, 40], y = [-30, 30] }\n" +
      ellipsoid("med", -22, 24) + ellipsoid("lat", 22, 22) +
      fibre("ACL", "[8, -8, 0]", "[-3, 12, -3]", "law = \"quadratic\"\nstiffness = 30000\nreference_strain = 0.03") +
      fibre("PCL", "[-8, 8, -6]", "[0, -22, -12]",
            "law = \"blankevoort\"\nstiffness = 9000\ntransition_strain = 0.06\nreference_strain = 0.01") +
      fibre("LCL", "[38, 0, 6]", "[36, -12, -45]", "law = \"linear\"\nstiffness = 2000\nreference_strain = 0.03") +
      fibre("MCL", "[-38, 0, 6]", "[-24, 6, -60]",
            "via = [{ body = \"tibia\", point = [-41, 2, -12] }]\nlaw = \"abdel-rahman\"\nstiffness = 60\n"
            "toe_stiffness = 12\ntransition_strain = 0.05\nreference_strain = 0.02") +
      "[load.weight]\nbody = \"femur\"\nforce = [0, 0, -100]\n" + steps);
}

TEST(PieceChanges, ADropOnTheWayLeadsToTheSamePoseHoweverTheStepsAreCut) {
  const auto bent = [](const std::string& range, int increments) {
    return test::step("prescribe = { \"knee.flexion\" = " + range + " }\nincrements = " + std::to_string(increments));
  };
  std::vector<Followed> walks;
  for (const int increments : {1, 47}) walks.push_back(leap(bent("[0, 47]", increments)));
  walks.push_back(leap(bent("47", 1)));
  walks.push_back(leap(bent("[60, 47]", 13)));  // its approach passes the drop
  const Pose& first = walks[0].points.back().pose.state.poses[1];
  for (std::size_t i = 0; i < walks.size(); ++i) {
    const Followed& w = walks[i];
    ASSERT_TRUE(w.result.complete) << i << "\n" << w.story();
    const auto jump = w.of(Kind::jump);
    ASSERT_EQ(jump.size(), 1u) << w.story();
    EXPECT_NEAR(jump[0].target.prescribed[0].value * 180 / M_PI, 46.8311292, 1e-6) << i;
    EXPECT_TRUE(w.of(Kind::stepped_over).empty()) << i << "\n" << w.story();
    EXPECT_LT((w.points.back().pose.state.poses[1].p - first.p).norm(), 1e-11) << i;
    EXPECT_EQ(w.points.back().stability.verdict, Stability::Verdict::stable) << i;
  }
}

// Ropes over pulleys.

std::string rope(const std::string& via, const std::string& to, const std::string& law) {
  return "[ligament.rope]\nfrom = { body = \"bone\", point = [0, 0, 0] }\nvia = [" + via + "]\nto = " + to + "\n" +
         law + "\n";
}

TEST(PieceChanges, ABodyHangsOverTwoPulleys) {
  // From the bone straight up to z = 100, across 30 mm, and down to the ground: 50 N stretch 5 N/mm by 10 mm.
  const Followed w = follow(
      test::bone_on_ground("{ z = 20 }") +
      rope("{ body = \"ground\", point = [0, 0, 100] }, { body = \"ground\", point = [30, 0, 100] }",
           "{ body = \"ground\", point = [30, 0, 0] }", "law = \"linear\"\nstiffness = 1000\nslack_length = 200") +
      test::load("w", "force = [0, 0, -50]") + test::step("prescribe = { " + kUpright + " }\nincrements = 1"));
  ASSERT_TRUE(w.result.complete) << w.story();
  EXPECT_NEAR(z_mm(w.points[0]), 230 - 210, 1e-10);
}

TEST(PieceChanges, ALoosePulleySharesItsLoadBetweenBothSides) {
  // The rope runs through the bone: 2 T h / sqrt(h^2 + 30^2) = 50 N for T = k (L - L0).
  const Followed w =
      follow(test::bone_on_ground("{ z = -45 }") +
             "[ligament.rope]\nfrom = { body = \"ground\", point = [-30, 0, 0] }\nvia = [{ body = \"bone\", "
             "point = [0, 0, 5] }]\nto = { body = \"ground\", point = [30, 0, 0] }\nlaw = \"spring\"\nstiffness "
             "= 5\nslack_length = 90\n" +
             test::load("w", "force = [0, 0, -50]") +
             test::step("prescribe = { \"j.y\" = 0, " + kNoTurn + " }\nincrements = 1"));
  ASSERT_TRUE(w.result.complete) << w.story();
  const double h = -(z_mm(w.points[0]) + 5), side = std::hypot(h, 30);
  EXPECT_NEAR(2 * 5 * (2 * side - 90) * h / side, 50, 1e-8);
  EXPECT_NEAR(w.points[0].pose.state.poses[1].p.x(), 0, 1e-12) << "it rolls to the middle";
  EXPECT_EQ(w.points[0].stability.verdict, Stability::Verdict::stable);
}

TEST(PieceChanges, AtwoodsBodiesPullOnOneRope) {
  // Bone and weight hang over two pulleys; the weight also lies on a spring of 2 N/mm at rest where z = 0. T = 30 N
  // carries the bone, the rest of the weight's 50 N presses the spring by 10 mm; the rope of 3 N/mm is 10 mm longer.
  const std::string joint =
      "[body.weight]\n[joint.k]\ntype = \"free\"\nparent = \"ground\"\nchild = \"weight\"\nrotations = [\"a x\", "
      "\"b y\", \"c z\"]\ntranslations = [\"x\", \"y\", \"z\"]\nreference = { x = 30 }\n";
  const Followed w = follow(
      test::bone_on_ground() + joint +
      rope("{ body = \"ground\", point = [0, 0, 100] }, { body = \"ground\", point = [30, 0, 100] }",
           "{ body = \"weight\", point = [0, 0, 0] }", "law = \"spring\"\nstiffness = 3\nslack_length = 230") +
      "[ligament.s]\nfrom = { body = \"weight\", point = [0, 0, 0] }\nto = { body = \"ground\", point = [30, 0, -40] "
      "}\nlaw = \"spring\"\nstiffness = 2\nslack_length = 40\n" +
      test::load("a", "force = [0, 0, -30]") + "[load.b]\nbody = \"weight\"\nforce = [0, 0, -50]\n" +
      test::step("prescribe = { " + kUpright +
                 ", \"k.x\" = 30, \"k.y\" = 0, \"k.a\" = 0, \"k.b\" = 0, \"k.c\" = 0 }\nincrements = 1"));
  ASSERT_TRUE(w.result.complete) << w.story();
  const State& state = w.points[0].pose.state;
  EXPECT_NEAR(1e3 * state.poses[2].p.z(), -10, 1e-9);
  // Length 230 + 10 = (100 - z) + 30 + (100 + 10): z = 0.
  EXPECT_NEAR(1e3 * state.poses[1].p.z(), 0, 1e-9);
}

}  // namespace
}  // namespace genu
