// A scene in memory: the same numbers as a file that says what was changed.
#include "genu/api/scene.h"

#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/knee.h"

namespace genu::api {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto place = text.find(what);
  EXPECT_NE(place, std::string::npos) << what;
  return place == std::string::npos ? text : text.replace(place, what.size(), with);
}

/// The text without the table [ligament.NAME].
std::string without_table(const std::string& text, const std::string& header) {
  const auto begin = text.find("[" + header + "]");
  EXPECT_NE(begin, std::string::npos) << header;
  return text.substr(0, begin) + text.substr(std::min(text.size(), text.find("\n[", begin) + 1));
}

std::string csv(const Scene& scene) { return scene.run().poses().csv(); }

TEST(Scene, GivesTheBytesOfAFileWithTheChangedNumber) {
  Scene knee = load(knee_file());
  const std::string before = csv(knee);
  const std::string value = "37200.0";
  knee.set("ligament.AAC.stiffness", 0.5 * knee.value("AAC.stiffness"));
  EXPECT_EQ(csv(knee), csv(parse(replaced(text_of(knee_file()), value, "18600.0"), knee_file())));
  EXPECT_NE(csv(knee), before);
  EXPECT_THAT(knee.changes(), ElementsAre("AAC.stiffness = 18600 N (37200)"));
  knee.set("AAC.stiffness", 37200);
  EXPECT_EQ(csv(knee), before);
  EXPECT_TRUE(knee.changes().empty());
}

TEST(Scene, GivesThoseOfAFileWithAnotherPointOrAnotherSurface) {
  Scene knee = load(knee_file());
  knee.set("AAC.from.x", 12.5);
  const std::string moved = replaced(text_of(knee_file()), "12.25", "12.5");
  EXPECT_EQ(csv(knee), csv(parse(moved, knee_file())));
  knee.set("femur_medial.minor_radius", 5.25);
  EXPECT_EQ(csv(knee), csv(parse(replaced(moved, "minor_radius = 5", "minor_radius = 5.25"), knee_file())));
}

TEST(Scene, GivesThoseOfAFileWithoutWhatIsLeftOut) {
  const Scene knee = load(knee_file());
  const std::string before = csv(knee);
  const Scene cut = knee.without("ligament.A*C");
  std::string text = text_of(knee_file());
  for (const char* name : {"AAC", "APC", "AMC"}) text = without_table(text, std::string("ligament.") + name);
  EXPECT_EQ(csv(cut), csv(parse(text, knee_file())));
  EXPECT_THAT(cut.ligaments(), ElementsAre("PAC", "PPC", "LC", "PMC"));
  EXPECT_THAT(cut.changes(), ElementsAre("without ligament.A*C: 3 ligaments"));
  EXPECT_EQ(csv(knee), before);
  EXPECT_EQ(csv(knee.without("medial")),
            csv(parse(without_table(text_of(knee_file()), "contact.medial"), knee_file())));
}

TEST(Scene, OfCartilageGivesThoseOfAFileWithTheChange) {
  const std::string file = genu::test::source_folder() + "/meshes/lenhart_polynomial/scene-cells.toml";
  const std::string text = replaced(text_of(file), "increments = 9", "increments = 1");
  Scene knee = parse(text, file);
  const std::string before = csv(knee);
  knee.set("medial.modulus", 8);  // MPa
  const std::string softer = replaced(text, "modulus = 10", "modulus = 8");
  EXPECT_EQ(csv(knee), csv(parse(softer, file)));
  knee.set("MCLd1.stiffness", 250);
  EXPECT_EQ(csv(knee), csv(parse(replaced(softer, "stiffness = 500", "stiffness = 250"), file)));
  EXPECT_NE(csv(knee), before);
  EXPECT_THAT(refusal_of([&] { knee.set("*.poisson", 0.5); }), HasSubstr("must be >= 0 and < 0.5"));
}

TEST(Scene, KeepsStepsFactorsOfTheLoadsThatStay) {
  const std::string loads =
      "\n[load.a]\nbody = \"femur\"\nforce = [1, 0, 0]\n[load.b]\nbody = \"femur\"\nforce = [0, 2, 0]\n";
  const std::string factors = "load = { a = [0, 1], b = [1, 0] }\n";
  const std::string text = text_of(knee_file());
  const auto step = text.find("[[step]]\n");
  ASSERT_NE(step, std::string::npos);
  const auto with = [&](const std::string& these, const std::string& those) {
    return parse(text.substr(0, step) + these + "\n[[step]]\n" + those + text.substr(step + 9), knee_file());
  };
  EXPECT_EQ(csv(with(loads, factors).without("load.a")),
            csv(with("\n[load.b]\nbody = \"femur\"\nforce = [0, 2, 0]\n", "load = { b = [1, 0] }\n")));
}

TEST(Scene, RefusesWhatItsRulesForbidAndStaysAsItWas) {
  Scene knee = load(knee_file());
  EXPECT_THAT(refusal_of([&] { knee.set("AAC.stiffness", -2); }),
              HasSubstr("AAC.stiffness = -2: stiffness must be > 0"));
  EXPECT_THAT(refusal_of([&] { knee.set("AAC.stiffness", std::nan("")); }), HasSubstr("must be > 0"));
  EXPECT_THAT(refusal_of([&] {
                knee.set("A?C.stiffness", std::vector<double>{1, 2, -3});
              }),
              HasSubstr("AMC.stiffness"));
  EXPECT_THAT(refusal_of([&] { knee.set("A?C.stiffness", std::vector<double>{1, 2}); }), HasSubstr("means 3 numbers"));
  EXPECT_THAT(refusal_of([&] { knee.set("AAC.stifness", 2); }), HasSubstr("did you mean \"AAC.stiffness\""));
  EXPECT_THAT(refusal_of([&] { (void)knee.value("A?C.stiffness"); }), HasSubstr("means 3 numbers, not one"));
  EXPECT_THAT(refusal_of([&] { (void)knee.without("XYZ*"); }), HasSubstr("no ligament, bundle, contact or load"));
  EXPECT_TRUE(knee.changes().empty());
  EXPECT_EQ(csv(knee), csv(load(knee_file())));
}

TEST(Scene, ErrorsHaveTheirPlace) {
  const std::string text = replaced(text_of(knee_file()), "stiffness = 37200.0", "stiffness = -2");
  try {
    (void)parse(text, "bad.toml");
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_EQ(error.first().file, "bad.toml");
    EXPECT_GT(error.first().line, 0);
    EXPECT_GT(error.first().column, 0);
    EXPECT_EQ(error.first().key, "ligament.AAC.stiffness");
    EXPECT_EQ(error.first().code, "out-of-range");
  }
  EXPECT_THAT(refusal_of([] { (void)load("no/such/scene.toml"); }), HasSubstr("no/such/scene.toml"));
}

TEST(Scene, CopiesAreSolvedSideBySideToTheSameBytes) {
  Scene knee = load(knee_file());
  const std::string before = csv(knee);
  Scene other = knee;
  other.set("PAC.stiffness", 20000);
  const std::string changed = csv(other);
  std::vector<std::string> found(8);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < found.size(); ++k)
    threads.emplace_back([&, k, copy = k % 2 == 0 ? knee : other] { found[k] = csv(copy); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k], k % 2 == 0 ? before : changed) << k;
}

TEST(Scene, EvaluatesItsOwnResults) {
  const Scene bone = load(genu::test::source_folder() + "/tests/examples/hanging_bone.toml");
  const Results found = bone.run();
  Poses poses;
  for (const std::string& name : bone.coordinates()) {
    const bool angle = name.find("flexion") + name.find("adduction") + name.find("rotation") != 3 * std::string::npos;
    poses.names.push_back(name + (angle ? "_deg" : "_mm"));
    poses.columns.push_back(found[poses.names.back()]);
  }
  const Results evaluated = bone.evaluate(poses);
  EXPECT_EQ(evaluated.verdict(), "evaluated");
  EXPECT_NEAR(evaluated["front.force_N"][0], found["front.force_N"][0], 1e-9);
  EXPECT_NEAR(evaluated["bone.residual_force_z_N"][0], 0, 1e-9);
  EXPECT_THAT(refusal_of([&] { (void)bone.evaluate({{"joint.x_mm"}, {found["joint.x_mm"]}}); }), HasSubstr("joint.y"));
}

TEST(Scene, DifferentiatesAsDifferencesDo) {
  Scene knee = load(knee_file());
  const Sensitivity s = knee.sensitivity({"knee.rotation"}, {"AAC.stiffness", "PAC.reference_strain"});
  ASSERT_THAT(s.of, ElementsAre("knee.rotation_deg"));
  ASSERT_EQ(s.derivatives.size(), s.results.rows() * 2);
  const double value = knee.value("AAC.stiffness"), step = 1;
  knee.set("AAC.stiffness", value + step);
  const Results up = knee.run();
  knee.set("AAC.stiffness", value - step);
  const Results down = knee.run();
  for (std::size_t row : {10U, 40U, 60U})
    EXPECT_NEAR(s.derivatives[2 * row], (up["knee.rotation_deg"][row] - down["knee.rotation_deg"][row]) / (2 * step),
                1e-6 * std::abs(s.derivatives[2 * row]) + 1e-12)
        << row;
  EXPECT_DOUBLE_EQ(s.effects[2 * 10], s.derivatives[2 * 10] * 0.01 * value);
}

TEST(Scene, OfAFormulaNeedsNoFile) {
  const Results found = make({}).run();
  EXPECT_EQ(found.verdict(), "solved");
  EXPECT_GT(found.rows(), 10U);
  EXPECT_THAT(refusal_of([] { (void)make({.kind = "stl"}); }), HasSubstr("is needed for a scene of meshes"));
}

}  // namespace
}  // namespace genu::api
