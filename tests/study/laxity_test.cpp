#include "genu/study/laxity.h"

#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "genu/core/units.h"
#include "genu/results/result_table.h"
#include "genu/study/laxity_table.h"
#include "support/data.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"
#include "support/wheel_knee.h"

namespace genu {
namespace {

constexpr double kAhead = 2, kAlong = 30, kAhead0 = 25, kHeight = 20;  // N/mm, N/mm, mm, mm

std::string spring_between(const std::string& name, const std::string& from, const std::string& to, double k,
                           double slack) {
  return fmt::format(
      "[ligament.{}]\nfrom = {{ body = \"femur\", point = {} }}\nto = {{ body = \"tibia\", point = {} }}\nlaw = "
      "\"spring\"\nstiffness = {}\nslack_length = {}\n",
      name, from, to, k, slack);
}

/// A wheel (a torus) of the femur that rolls on the flat tibia. x is anterior, z proximal, y to the left.
std::string wheel(const std::string& side, const std::string& springs) {
  return test::wheel_on_plate(side) + springs +
         "[[step]]\nprescribe = { \"knee.flexion\" = [0, 10] }\nincrements = 5\n";
}

/// One spring ahead, slack without load, and two upright ones, symmetric: in a drawer test the tibia only slides.
std::string two_springs() {
  return wheel("right", spring_between("ahead", "[-25, 0, -20]", "[0, 0, 0]", kAhead, kAhead0) +
                            spring_between("left", "[0, 15, 0]", "[0, 15, 0]", kAlong / 2, 18) +
                            spring_between("right", "[0, -15, 0]", "[0, -15, 0]", kAlong / 2, 18));
}

/// Springs without symmetry; `y` is -1 for the mirrored knee.
std::string crooked(double y) {
  const auto at = [&](double px, double py, double pz) { return fmt::format("[{}, {}, {}]", px, y * py, pz); };
  return wheel(y > 0 ? "right" : "left", spring_between("ahead", at(-25, 3, -19), at(1, 0, 0), 5, 24) +
                                             spring_between("a", at(2, 25, 0), at(0, 26, -1), 20, 14) +
                                             spring_between("b", at(-3, -25, 0), at(0, -24, 0), 15, 14) +
                                             spring_between("across", at(1, 25, -18), at(0, 0, 0), 6, 24) +
                                             spring_between("behind", at(25, -2, -19), at(0, 1, 0), 4, 24));
}

LaxityChoice choice_of(std::vector<LaxityTest> tests, const std::vector<double>& degrees = {0}) {
  LaxityChoice choice;
  choice.tests = std::move(tests);
  for (const double angle : degrees) choice.flexions.push_back(units::kDegree * angle);
  return choice;
}

constexpr LaxityTest kDrawer{LaxityTest::Kind::drawer, 50};
constexpr LaxityTest kVarus{LaxityTest::Kind::varus, 1};
constexpr LaxityTest kRotation{LaxityTest::Kind::rotation, 0.5};

LaxityResult tested(const std::string& text, const LaxityChoice& choice, int expected = kExitOk,
                    const SceneChanges& changes = {}) {
  const test::TemporaryFolder folder;
  LaxityResult result;
  Diagnostics out;
  EXPECT_EQ(run_laxity({folder.write("scene.toml", text), changes}, folder / "out", choice, out, result), expected)
      << test::messages(out);
  return result;
}

TEST(Laxity, DrawerOfTwoSpringsIsTheClosedForm) {
  const LaxityResult result = tested(two_springs(), choice_of({kDrawer}));
  ASSERT_EQ(result.scenes.size(), 1u);
  const LaxityCurve& curve = result.scenes[0].angles.at(0).curves.at(0);
  ASSERT_EQ(curve.rows.size(), 41u);
  const double slack = 18, h = kHeight;
  double worst_force = 0, worst_slope = 0;
  for (const LaxityRow& row : curve.rows) {
    const double x = 1e3 * (row.motion.anterior - curve.rows[0].motion.anterior), l = std::hypot(h, x);
    const double force = kAhead * x + kAlong * (1 - slack / l) * x;
    const double slope = kAhead + kAlong * (1 - slack / l) + kAlong * slack * x * x / (l * l * l);
    worst_force = std::max(worst_force, std::abs(force - row.load));
    worst_slope = std::max(worst_slope, std::abs(slope - 1 / (1e3 * row.compliance)));
    EXPECT_NEAR(row.motion.adduction, 0, 1e-12);
    EXPECT_NEAR(row.motion.distraction, units::kMillimetre * h, 1e-12);
  }
  EXPECT_LT(worst_force, 1e-8) << "N";
  EXPECT_LT(worst_slope, 1e-8) << "N/mm";
  EXPECT_LT(curve.loop(), 1e-12) << "forth and back, m";
  const LaxityRow* up = curve.at(kDrawer.load);
  const LaxityRow* down = curve.at(-kDrawer.load);
  ASSERT_TRUE(up && down);
  EXPECT_GT(up->motion.anterior, curve.rows[0].motion.anterior) << "an anterior force moves the tibia forward";
  EXPECT_NEAR(up->motion.anterior - curve.rows[0].motion.anterior,
              curve.rows[0].motion.anterior - down->motion.anterior, 1e-12);
}

TEST(Laxity, EachLoadMovesTheTibiaItsWay) {
  const LaxityResult result = tested(crooked(1), choice_of({kDrawer, kVarus, kRotation}, {0, 10}));
  for (const LaxityAngle& angle : result.scenes[0].angles) {
    ASSERT_EQ(angle.curves.size(), 3u);
    for (const LaxityCurve& curve : angle.curves) {
      ASSERT_TRUE(curve.at(curve.test.load) && curve.at(-curve.test.load));
      const double here = curve.test.displacement(curve.rows[0].motion);
      EXPECT_GT(curve.test.displacement(curve.at(curve.test.load)->motion), here) << curve.test.name();
      EXPECT_LT(curve.test.displacement(curve.at(-curve.test.load)->motion), here) << curve.test.name();
      EXPECT_LT(curve.loop(), 1e-12) << curve.test.name();
    }
  }
  EXPECT_TRUE(result.scenes[0].knee.floating);
}

TEST(Laxity, SlopesAreThoseOfTheCurves) {
  LaxityChoice choice = choice_of({kDrawer, kVarus, kRotation}, {5});
  choice.increments = 1000;
  const LaxityResult result = tested(crooked(1), choice);
  for (const LaxityCurve& curve : result.scenes[0].angles[0].curves) {
    const auto u = [&](int k) {
      return curve.test.displacement(curve.at(k * curve.test.load / choice.increments)->motion);
    };
    const double h = curve.test.load / choice.increments;
    const double slope = (8 * (u(1) - u(-1)) - (u(2) - u(-2))) / (12 * h);
    EXPECT_NEAR(curve.rows[0].compliance / slope, 1, 1e-8) << curve.test.name();
  }
}

TEST(Laxity, MirroredKneesHaveTheSameTable) {
  const LaxityChoice choice = choice_of({kDrawer, kVarus, kRotation}, {0, 10, 20});
  const ResultTable right = laxity_summary(tested(crooked(1), choice).scenes),
                    left = laxity_summary(tested(crooked(-1), choice).scenes);
  ASSERT_EQ(right.columns(), left.columns());
  ASSERT_EQ(right.rows(), 9u);
  for (std::size_t row = 0; row < right.rows(); ++row)
    for (const std::string& column : right.columns())
      if (const double value = right.number(row, column); std::isfinite(value) && column != "loop") {
        EXPECT_NEAR(left.number(row, column), value, 1e-7 * std::max(1.0, std::abs(value))) << row << " " << column;
      }
}

TEST(Laxity, SameBytesOnAnyNumberOfThreads) {
  const LaxityChoice choice = choice_of({kDrawer, kVarus}, {0, 5, 10, 15});
  const auto csv = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return laxity_csv(tested(crooked(1), choice).scenes);
  };
  const std::string one = csv(1);
  EXPECT_GT(one.size(), 1000u);
  EXPECT_EQ(one, csv(4));
}

TEST(Laxity, AChangedSceneStandsBesideTheWrittenOne) {
  const LaxityChoice choice = choice_of({kDrawer});
  const LaxityResult result = tested(two_springs(), choice, kExitOk, {{"ahead"}, {}});
  ASSERT_EQ(result.scenes.size(), 2u);
  EXPECT_EQ(result.scenes[0].name, "as written");
  EXPECT_EQ(result.scenes[1].name, "without ahead");
  const auto total = [&](std::size_t k) {
    const LaxityCurve& c = result.scenes[k].angles[0].curves[0];
    return c.at(kDrawer.load)->motion.anterior - c.at(-kDrawer.load)->motion.anterior;
  };
  EXPECT_GT(total(1), 1.1 * total(0));
  EXPECT_NEAR(1 / (1e3 * result.scenes[1].angles[0].curves[0].rows[0].compliance), kAlong * (1 - 18 / kHeight), 1e-8);
  EXPECT_TRUE(test::contains(result.text, "without ahead")) << result.text;
}

TEST(Laxity, TheStepsOfTheSceneNeedNotPrescribeFlexion) {
  const LaxityChoice choice = choice_of({kDrawer});
  const std::string loaded = test::with_first(two_springs(), "prescribe = { \"knee.flexion\" = [0, 10] }\n",
                                              "load = { weight = [0.5, 1] }\n") +
                             "[load.weight]\nbody = \"tibia\"\nforce = [0, 0, 40]\n";
  const std::string driven = test::with_first(two_springs(), "increments = 5\n",
                                              "drive = \"pull\"\nincrements = 5\n[[step]]\nincrements = 1\n") +
                             "[load.pull]\nbody = \"tibia\"\nmoment = [0, 1, 0]\n";
  for (const std::string& text : {loaded, driven}) {
    const LaxityResult result = tested(text, choice);
    EXPECT_EQ(result.scenes.at(0).angles.at(0).curves.at(0).rows.size(), 41u);
    EXPECT_EQ(laxity_rows(result.scenes).rows(), 42u);
  }
}

TEST(Laxity, ACurveThatEndsBothWaysSaysBothAndHasNoLoop) {
  const std::string text = test::with_first(two_springs(), "shape = \"plane\"\n",
                                            "shape = \"plane\"\npatch = { x = [-3, 3], y = [-20, 20] }\n");
  const test::TemporaryFolder folder;
  LaxityResult result;
  Diagnostics out;
  ASSERT_EQ(run_laxity(folder.write("scene.toml", text), folder / "out", choice_of({kDrawer}), out, result),
            kExitIncomplete)
      << test::messages(out);
  const ResultTable table = laxity_summary(result.scenes);
  const std::string status = std::get<std::string>(table.at(0, table.column_index("status")));
  EXPECT_TRUE(test::contains(status, "anterior ends at") && test::contains(status, "; posterior ends at")) << status;
  EXPECT_TRUE(std::isnan(table.number(0, "loop")));
  const std::string summary = test::read_file(folder / "out/summary.json");
  EXPECT_TRUE(test::contains(summary, "\"asked\": 41")) << summary;
  EXPECT_FALSE(test::contains(summary, "\"solved\": 41")) << summary;
}

TEST(Laxity, WhatARunWouldDoubtIsDoubted) {
  const auto limited = [](const std::string& limit) { return two_springs() + "[plausible]\n" + limit + "\n"; };
  const LaxityResult result = tested(limited("ligament_force = 20"), choice_of({kDrawer}), kExitDoubtful);
  ASSERT_EQ(result.verdict.size(), 2u);
  EXPECT_EQ(result.verdict[0], "All 1 curves are complete, with doubts.");
  EXPECT_TRUE(test::contains(result.verdict[1], " at 0 deg, 50 N ")) << result.verdict[1];
  EXPECT_TRUE(test::contains(result.verdict[1], "(limit 20 N)")) << result.verdict[1];
  LaxityChoice pressed = choice_of({kDrawer});
  pressed.compression = 200;  // the contact bears it and the springs' pull
  const LaxityResult borne = tested(limited("contact_force = 2"), pressed);
  EXPECT_EQ(borne.verdict.size(), 1u) << borne.verdict.back();
  tested(limited("contact_force = 0.5"), pressed, kExitDoubtful);
}

TEST(Laxity, CompressionActsAtAllPoses) {
  LaxityChoice choice = choice_of({kDrawer});
  const LaxityResult light = tested(two_springs(), choice);
  choice.compression = 200;
  const LaxityResult pressed = tested(two_springs(), choice);
  const auto force = [](const LaxityResult& r) {
    double sum = 0;
    for (const ActiveContact& c : r.scenes[0].angles[0].neutral.record.point.pose.state.contacts) sum += c.force;
    return sum;
  };
  EXPECT_NEAR(force(pressed) - force(light), 200, 1e-6);
}

TEST(Laxity, TheAngleIsFlexionWhateverTheSignOfTheRotation) {
  const LaxityChoice choice = choice_of({kDrawer, kVarus, kRotation}, {0, 10, 20});
  std::string extended = test::with_first(crooked(1), "\"flexion y\"", "\"extension -y\"");
  extended = test::with_first(extended, "\"knee.flexion\" = [0, 10]", "\"knee.extension\" = [0, -10]");
  const LaxityResult flexed = tested(crooked(1), choice), turned = tested(extended, choice);
  EXPECT_NEAR(turned.scenes.at(0).angles.at(1).neutral.motion.flexion, 10 * units::kDegree, 1e-12);
  const ResultTable one = laxity_summary(flexed.scenes), other = laxity_summary(turned.scenes);
  ASSERT_EQ(one.rows(), 9u);
  for (std::size_t row = 0; row < one.rows(); ++row)
    EXPECT_NEAR(other.number(row, "total"), one.number(row, "total"), 1e-7) << row;
}

TEST(Laxity, AnotherAxisThanTheFloatingOneIsSaid) {
  const std::string said = "not the floating axis";
  const std::string text =
      test::with_first(crooked(1), "\"adduction x\", \"rotation -z\"", "\"rotation -z\", \"adduction x\"");
  const LaxityResult other = tested(text, choice_of({kDrawer, kVarus}));
  ASSERT_EQ(other.verdict.size(), 2u);
  EXPECT_TRUE(test::contains(other.verdict[1], said)) << other.verdict[1];
  EXPECT_EQ(tested(text, choice_of({kDrawer})).verdict.size(), 1u) << "no varus moment";
  EXPECT_EQ(tested(crooked(1), choice_of({kDrawer, kVarus})).verdict.size(), 1u) << "about the floating axis";
}

TEST(Laxity, WhatTheSceneHoldsAndTheTestFreesIsSaid) {
  const std::string text =
      test::with_first(crooked(1), "\"knee.flexion\" = [0, 10]", "\"knee.flexion\" = [0, 10], \"knee.rotation\" = 0");
  const LaxityResult result = tested(text, choice_of({kDrawer}));
  ASSERT_EQ(result.verdict.size(), 2u);
  EXPECT_EQ(result.verdict[1], "Free in this test, prescribed in the scene's last step: knee.rotation.");
}

TEST(Laxity, WhatIsInterruptedReplacesNoWholeResult) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", two_springs()), out = folder / "out";
  LaxityChoice choice = choice_of({kDrawer});
  Diagnostics said;
  LaxityResult whole, part;
  ASSERT_EQ(run_laxity(scene, out, choice, said, whole), kExitOk) << test::messages(said);
  const std::string rows = test::read_file(out + "/laxity.csv");
  choice.cancelled = [] { return true; };
  EXPECT_EQ(run_laxity(scene, out, choice, said, part), kExitIncomplete);
  EXPECT_EQ(test::read_file(out + "/laxity.csv"), rows);
  EXPECT_EQ(part.folder, out + ".interrupted");
  EXPECT_TRUE(std::filesystem::exists(part.folder + "/laxity.csv"));
  EXPECT_TRUE(test::contains(part.verdict.at(0), "Interrupted")) << part.verdict.at(0);
}

TEST(Laxity, WhatCannotBeTestedIsRefused) {
  const auto refused = [](const std::string& text) {
    const test::TemporaryFolder folder;
    LaxityResult result;
    Diagnostics out;
    EXPECT_EQ(run_laxity(folder.write("scene.toml", text), {}, choice_of({kDrawer}), out, result), kExitRefused);
    return test::messages(out);
  };
  std::string plain = two_springs();
  const std::size_t first = plain.find("grood_suntay"), last = plain.find('\n', first);
  plain.erase(first, last - first);
  EXPECT_TRUE(test::contains(refused(plain), "no joint has grood_suntay"));
  std::string still = two_springs();
  still.replace(still.find("[body.femur]\nfixed = true\n[body.tibia]\n"), 39,
                "[body.femur]\n[body.tibia]\nfixed = true\n");
  EXPECT_FALSE(refused(still).empty());
  const std::string hip = test::with_first(two_springs(), "[body.femur]\nfixed = true\n",
                                           "[body.pelvis]\nfixed = true\n[body.femur]\n"),
                    joint = "[joint.hip]\nparent = \"pelvis\"\nchild = \"femur\"\norigin = [0, 0, 400]\n";
  EXPECT_TRUE(test::contains(refused(hip + joint + "type = \"revolute\"\naxis = [0, 1, 0]\nstiffness = 5\n"),
                             "body.femur: can move"));
  const std::string adducted =
      test::with_first(two_springs(), "\"flexion y\", \"adduction x\"", "\"adduction x\", \"flexion y\"");
  EXPECT_TRUE(test::contains(refused(adducted), "not about the femur's flexion axis"));
}

TEST(Laxity, ACurveThatEndsStopsNoOther) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl");
  const std::string source = test::source_folder() + "/meshes/lenhart2015/";
  std::string text = test::read_file(source + "scene-cartilage.toml");
  for (std::size_t k; (k = text.find("../../../shared/data/")) != std::string::npos;)
    text.replace(k, 21, test::data_path(""));
  if (!test::contains(text, "grood_suntay")) {
    const std::string joint = "translations = [\"x\", \"y\", \"z\"]\n";
    text.insert(text.find(joint) + joint.size(),
                "grood_suntay = { side = \"right\", femur = { body = \"femur\", proximal = \"y\", anterior = \"x\" }, "
                "tibia = { body = \"tibia\", proximal = \"y\", anterior = \"x\" } }\n");
  }
  const LaxityChoice choice = choice_of({{LaxityTest::Kind::drawer, 134}, {LaxityTest::Kind::varus, 10}}, {0});
  const LaxityResult result = tested(text, choice, kExitIncomplete, {{"ACL*"}, {}});
  ASSERT_EQ(result.scenes.size(), 2u);
  for (const LaxityCurve& curve : result.scenes[0].angles[0].curves) {
    EXPECT_TRUE(curve.ended.empty());
    EXPECT_LT(curve.loop(), 1e-12) << curve.test.name();
  }
  const std::vector<LaxityCurve>& cut = result.scenes[1].angles[0].curves;
  ASSERT_EQ(cut.size(), 2u);
  ASSERT_EQ(cut[0].ended.size(), 1u);
  const std::string ends = "anterior ends at ";
  ASSERT_TRUE(cut[0].ended[0].starts_with(ends)) << cut[0].ended[0];
  // By triangles the stiffness jumps all along: near its zero there are several turns, within 0.002 N.
  EXPECT_NEAR(std::stod(cut[0].ended[0].substr(ends.size())), 80.395, 0.006);
  EXPECT_TRUE(cut[0].at(134) == nullptr && cut[0].at(-134) != nullptr) << "the posterior direction stands";
  EXPECT_TRUE(cut[1].ended.empty() && cut[1].at(10) && cut[1].at(-10));
}

}  // namespace
}  // namespace genu
