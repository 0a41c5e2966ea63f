// Poses and derivatives of a scene in memory.
#include "genu/api/scene.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/knee.h"

namespace genu::api {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(SceneRuns, EvaluatesItsOwnResults) {
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

TEST(SceneRuns, ForcesThatAreNoNumbersAreRefused) {
  const Scene bone = load(genu::test::source_folder() + "/tests/examples/hanging_bone.toml");
  std::vector<double> q = bone.start();
  EXPECT_THAT(refusal_of([&] { (void)bone.residual(q, {{}, std::nan("")}); }), HasSubstr("time = nan: must be finite"));
  for (double& x : q) x += 1e300;
  EXPECT_THAT(refusal_of([&] { (void)bone.residual(q, {}); }), HasSubstr("forces overflow"));
  EXPECT_THAT(refusal_of([&] { (void)bone.stiffness(q, {}); }), HasSubstr("forces overflow"));
}

TEST(SceneRuns, DifferentiatesAsDifferencesDo) {
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

}  // namespace
}  // namespace genu::api
