// Breaks of laws located between the ends of a substep: exact places, forward and back, in and out again.
#include "genu/path/law_events.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/model/ligament_pieces.h"
#include "support/solved.h"

namespace genu {
namespace {

using test::follow;
using test::Followed;
using Kind = PathEvent::Kind;

// A crank: the bone turns about x by the angle a; a ligament from 30 mm off the axis to 40 mm off it on the ground has
// L^2 = 30^2 + 40^2 - 2 30 40 cos a.
double angle_at(double length) { return std::acos((30.0 * 30 + 40 * 40 - length * length) / (2 * 30 * 40)); }

/// What stays free, the motion along the axis, is held by a spring.
std::string crank(double angle) {
  return test::bone_on_ground("{ a = " + std::to_string(angle) + " }") +
         test::spring("centre", "[0, 0, 0]", "[0, 0, 0]", 10, 0);
}
std::string rope(const std::string& name, const std::string& law) {
  return test::ligament(name, "[0, 30, 0]", "[0, 40, 0]", law);
}
std::string turn(double from, double to, int increments) {
  return test::step(
      "prescribe = { \"j.a\" = [" + std::to_string(from) + ", " + std::to_string(to) +
      "], \"j.b\" = 0, \"j.c\" = 0, \"j.y\" = 0, \"j.z\" = 0 }\nincrements = " + std::to_string(increments));
}
double angle_of(const PathEvent& e) { return e.target.prescribed[0].value; }

struct Place {
  std::string name;
  Kind up, down;
  double length;  // mm
};
/// Smooth breaks and sharp ones, at which the path stops, one after the other.
const std::string kAll =
    rope("abdel",
         "law = \"abdel-rahman\"\nstiffness = 9\ntoe_stiffness = 3\ntransition_strain = 0.5\nslack_length = 20") +
    rope("quadratic", "law = \"quadratic\"\nstiffness = 2000\nslack_length = 25") +
    rope("linear", "law = \"linear\"\nstiffness = 2000\nslack_length = 33") +
    rope("toe", "law = \"blankevoort\"\nstiffness = 2000\ntransition_strain = 0.3\nslack_length = 40") +
    rope("table", "law = \"table\"\npoints = [[0, 0], [0.1, 0], [0.2, 10], [0.4, 100]]\nslack_length = 45");
const std::vector<Place> kPlaces = {{"abdel", Kind::taut, Kind::slack, 20},
                                    {"quadratic", Kind::taut, Kind::slack, 25},
                                    {"abdel", Kind::transition, Kind::transition, 30},
                                    {"linear", Kind::taut, Kind::slack, 33},
                                    {"toe", Kind::taut, Kind::slack, 40},
                                    {"table", Kind::taut, Kind::slack, 49.5},
                                    {"toe", Kind::transition, Kind::transition, 52}};

TEST(LawEvents, OfEveryLawAreWhereTheLengthSaysThereAndBack) {
  double worst = 0;
  for (const int increments : {1, 3, 40}) {
    Followed w = follow(crank(0.2) + kAll + turn(0.2, 2.9, increments) + turn(2.9, 0.2, increments));
    ASSERT_TRUE(w.result.complete) << w.story();
    EXPECT_FALSE(w.of(Kind::reaction_turns).empty()) << "the moment is largest somewhere";
    std::erase_if(w.events, [](const PathEvent& e) { return e.kind == Kind::reaction_turns; });
    ASSERT_EQ(w.events.size(), 2 * kPlaces.size()) << w.story();
    for (std::size_t i = 0; i < kPlaces.size(); ++i) {
      const PathEvent &there = w.events[i], &back = w.events[2 * kPlaces.size() - 1 - i];
      EXPECT_EQ(there.what.substr(0, kPlaces[i].name.size()), kPlaces[i].name) << w.story();
      EXPECT_EQ(back.what, there.what) << w.story();
      EXPECT_EQ(there.kind, kPlaces[i].up) << w.story();
      EXPECT_EQ(back.kind, kPlaces[i].down) << w.story();
      const double exact = angle_at(kPlaces[i].length);
      worst = std::max({worst, std::abs(angle_of(there) - exact), std::abs(angle_of(back) - exact)});
    }
  }
  EXPECT_LT(worst, 1e-8) << "rad";
  RecordProperty("worst_rad", std::to_string(worst));
}

TEST(LawEvents, SmoothBreaksTakeNoSubstep) {
  const std::string smooth = rope("quadratic", "law = \"quadratic\"\nstiffness = 2000\nslack_length = 25");
  const std::string never = rope("quadratic", "law = \"quadratic\"\nstiffness = 2000\nslack_length = 80");
  const std::string sharp = rope("linear", "law = \"linear\"\nstiffness = 2000\nslack_length = 25");
  const auto substeps = [](const std::string& law) {
    const Followed w = follow(crank(0.2) + law + turn(0.2, 2.9, 40));
    EXPECT_TRUE(w.result.complete) << w.story();
    return w.result.substeps;
  };
  EXPECT_EQ(substeps(smooth), substeps(never));
  EXPECT_GT(substeps(sharp), substeps(never));
}

TEST(LawEvents, ALigamentMayBeTautAndSlackAgainInsideOneSubstep) {
  // The longest the rope becomes is 70 mm, at a = pi; the increments around it are 0.2 rad.
  double worst = 0;
  for (const double less : {1e-2, 1e-4, 1e-6}) {
    const double slack_length = 70 * (1 - less);
    const Followed w = follow(
        crank(2.05) + turn(2.05, 4.05, 10) +
        rope("r", "law = \"quadratic\"\nstiffness = 2000\nslack_length = " + fmt::format("{:.17g}", slack_length)));
    ASSERT_EQ(w.events.size(), 2u) << less << "\n" << w.story();
    EXPECT_EQ(w.events[0].kind, Kind::taut);
    EXPECT_EQ(w.events[1].kind, Kind::slack);
    const double exact = angle_at(slack_length);
    worst = std::max(
        {worst, std::abs(angle_of(w.events[0]) - exact), std::abs(angle_of(w.events[1]) - (2 * M_PI - exact))});
  }
  EXPECT_LT(worst, 1e-8) << "rad";
  for (const double more : {1e-2, 1e-4, 1e-9}) {
    const Followed w = follow(
        crank(2.05) + turn(2.05, 4.05, 10) +
        rope("r", "law = \"quadratic\"\nstiffness = 2000\nslack_length = " + fmt::format("{:.17g}", 70 * (1 + more))));
    EXPECT_TRUE(w.events.empty()) << more << "\n" << w.story();
  }
}

TEST(LawEvents, OfAPathThatBendsUnderLoadAreWhereTheLawSays) {
  // z + F(20 + z) = load in N and mm: the rope from 20 mm below becomes taut at z = 2 and passes its toe at z = 6.4.
  const std::string law = "law = \"blankevoort\"\nstiffness = 300\ntransition_strain = 0.2\nslack_length = 22";
  const std::string scene = test::bone_on_ground("{ z = 0 }") + test::spring("s", "[0, 0, 0]", "[0, 0, -20]", 1, 20) +
                            test::ligament("rope", "[0, 0, 0]", "[0, 0, -20]", law) +
                            test::load("lift", "force = [0, 0, 1]");
  const std::string held = "prescribe = { \"j.x\" = 0, \"j.y\" = 0, " + test::kNoTurn + " }\n";
  const Followed w = follow(scene + test::step(held + "load = { lift = [0, 60] }\nincrements = 1") +
                            test::step(held + "load = { lift = [60, 0] }\nincrements = 7"));
  ASSERT_TRUE(w.result.complete) << w.story();
  ASSERT_EQ(w.events.size(), 4u) << w.story();
  const double taut = 2, toe = 6.4 + 300 * 0.1;
  double worst = 0;
  for (const auto& [i, exact] : {std::pair<std::size_t, double>{0, taut}, {1, toe}, {2, toe}, {3, taut}})
    worst = std::max(worst, std::abs(w.events[i].target.load_factors[0] - exact));
  EXPECT_LT(worst, 1e-7) << "N\n" << w.story();
}

TEST(LawEvents, OfAKneeComeInPathOrderAndAtTheSamePlacesOnTheWayBack) {
  const Followed w = follow(test::knee(test::step("prescribe = { \"knee.flexion\" = [0, 90] }\nincrements = 6") +
                                       test::step("prescribe = { \"knee.flexion\" = [90, 0] }\nincrements = 45")));
  ASSERT_TRUE(w.result.complete) << w.story();
  const std::size_t n = w.events.size() / 2;
  ASSERT_GE(n, 3u);
  ASSERT_EQ(w.events.size(), 2 * n) << w.story();
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) {
      EXPECT_GE(w.events[i].t, w.events[i - 1].t) << w.story();
    }
    EXPECT_EQ(w.events[i].what, w.events[2 * n - 1 - i].what) << w.story();
    worst = std::max(worst, std::abs(w.events[i].t - (1 - w.events[2 * n - 1 - i].t)));
  }
  EXPECT_LT(worst, 1e-8) << "of 90 deg\n" << w.story();
}

// LawEvents by itself, over one substep of the crank whose poses are known without a solver.

struct Crank {
  test::SceneModel scene = test::scene_model(
      crank(0) + rope("r", "law = \"quadratic\"\nstiffness = 2000\nslack_length = 25") + turn(0, 1, 1));
  State at(double angle) const {
    State state = reference_state(scene.model);
    state.poses[1].R = Eigen::AngleAxisd(angle, Vec3::UnitX()).toRotationMatrix();
    return state;
  }
};

TEST(LawEvents, NeedNoTangents) {
  const Crank crank;
  const State from = crank.at(0.2), to = crank.at(1.4);
  LawEvents events(crank.scene.model);
  ASSERT_FALSE(events.none());
  int solves = 0;
  const auto pose_at = [&](double u, State& out) {
    ++solves;
    out = crank.at(0.2 + 1.2 * u);
    return true;
  };
  const auto& passed = events.over({from, nullptr}, {to, nullptr}, 1e-9, {pose_at, {}});
  ASSERT_EQ(passed.size(), 1u);
  EXPECT_NEAR(0.2 + 1.2 * passed[0].u, angle_at(25), 1e-8);
  EXPECT_LE(solves, 8);
}

TEST(LawEvents, WithTangentsTakeOneOrTwoSolves) {
  const Crank crank;
  const double h = 0.1, first = angle_at(25) - 0.037;
  const State from = crank.at(first), to = crank.at(first + h);
  LawEvents events(crank.scene.model);
  VecX twist = VecX::Zero(6);
  twist[3] = h;
  int solves = 0;
  const auto pose_at = [&](double u, State& out) {
    ++solves;
    out = crank.at(first + h * u);
    return true;
  };
  const auto& passed = events.over({from, &twist}, {to, &twist}, 1e-9, {pose_at, {}});
  ASSERT_EQ(passed.size(), 1u);
  EXPECT_EQ(passed[0].kind, Kind::taut);
  EXPECT_EQ(passed[0].what, "r");
  EXPECT_NEAR(first + h * passed[0].u, angle_at(25), 1e-10);
  EXPECT_NEAR(crank.scene.model.ligaments[1].path.length(passed[0].state.poses), 0.025, 1e-12);
  EXPECT_LE(solves, 2);
}

TEST(LawEvents, OfALeapAreAtItsEndAndOfTheNextSubstepNotToldAgain) {
  const Crank crank;
  const State from = crank.at(0.2), to = crank.at(1.4);
  LawEvents events(crank.scene.model);
  const auto& passed = events.over({from, nullptr}, {to, nullptr}, 1e-9, {});
  ASSERT_EQ(passed.size(), 1u);
  EXPECT_EQ(passed[0].u, 1);
  EXPECT_TRUE(events.over({to, nullptr}, {to, nullptr}, 1e-9, {}).empty());
  // A step that begins elsewhere than the last has ended: what was passed in between is told.
  EXPECT_EQ(events.over({from, nullptr}, {from, nullptr}, 1e-9, {}).size(), 1u);
}

TEST(LawEvents, APathOnWhichTheyAreNotLocatedHasTheSamePoses) {
  const std::string smooth = rope("quadratic", "law = \"quadratic\"\nstiffness = 2000\nslack_length = 25");
  const std::string scene = crank(0.2) + smooth + turn(0.2, 2.9, 40);
  PathOptions without;
  without.locate_law_breaks = false;
  const Followed all = follow(scene), poses = follow(scene, without);
  ASSERT_TRUE(poses.result.complete) << poses.story();
  EXPECT_FALSE(all.of(Kind::taut).empty()) << all.story();
  EXPECT_TRUE(poses.of(Kind::taut).empty()) << poses.story();
  EXPECT_EQ(poses.result.substeps, all.result.substeps);
  ASSERT_EQ(poses.points.size(), all.points.size());
  for (std::size_t k = 0; k < all.points.size(); ++k)
    EXPECT_EQ(poses.points[k].pose.state.coordinates[0], all.points[k].pose.state.coordinates[0]) << k;
}

TEST(LawEvents, AModelWithoutSmoothBreaksHasNone) {
  EXPECT_TRUE(
      LawEvents(test::scene_model(test::bone_on_ground() + test::spring("s", "[0, 0, 0]", "[0, 0, -20]", 1, 20) +
                                  rope("l", "law = \"linear\"\nstiffness = 2000\nslack_length = 25"))
                    .model)
          .none());
}

}  // namespace
}  // namespace genu
