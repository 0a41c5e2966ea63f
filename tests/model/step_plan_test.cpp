#include "genu/model/step_plan.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

StepPlan some_plan() {
  StepPlan plan;
  plan.prescribed = {{{0, 1}, 0.1, 0.7}, {{0, 2}, 0.3, -0.9}, {{0, 4}, 0.02, 5}};
  plan.factors = {{1, 1}, {0, 0.3}};
  plan.start_time = 0.1;
  plan.end_time = 0.7;
  return plan;
}

TEST(StepPlan, IsExactAtItsEndsAndLinearBetween) {
  const StepPlan plan = some_plan();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(plan.target(0).prescribed[i].value, plan.prescribed[i].from);
    EXPECT_EQ(plan.target(1).prescribed[i].value, plan.prescribed[i].to);
    EXPECT_EQ(plan.target(0.5).prescribed[i].coordinate, plan.prescribed[i].coordinate);
    EXPECT_NEAR(plan.target(0.25).prescribed[i].value, 0.75 * plan.prescribed[i].from + 0.25 * plan.prescribed[i].to,
                1e-16);
  }
  EXPECT_EQ(plan.target(0).time, 0.1);
  EXPECT_EQ(plan.target(1).time, 0.7);
  EXPECT_NEAR(plan.target(0.5).time, 0.4, 1e-16);
  EXPECT_EQ(plan.target(1).load_factors[1], 0.3);
  EXPECT_EQ(plan.target(0.123).load_factors[0], 1);
}

TEST(StepPlan, RateIsItsDerivative) {
  const StepPlan plan = some_plan();
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(plan.rate().prescribed[i].value,
                (plan.target(0.6).prescribed[i].value - plan.target(0.4).prescribed[i].value) / 0.2, 1e-13);
  EXPECT_NEAR(plan.rate().time, 0.6, 1e-15);
  EXPECT_EQ(plan.rate().load_factors[0], 0);
  EXPECT_EQ(plan.rate().load_factors[1], 0.3);
}

TEST(StepPlan, AngleRangeLeavesTranslationsOut) {
  EXPECT_NEAR(some_plan().angle_range(), 1.2, 1e-15);
  StepPlan translation;
  translation.prescribed = {{{0, 3}, 0, 5}};
  EXPECT_EQ(translation.angle_range(), 0);
}

TEST(StepPlan, VariesNothingWhereOnlyTimePasses) {
  StepPlan plan = some_plan();
  EXPECT_FALSE(plan.varies_nothing());
  for (auto& p : plan.prescribed) p.to = p.from;
  EXPECT_FALSE(plan.varies_nothing());  // a load does
  for (auto& f : plan.factors) f.to = f.from;
  EXPECT_TRUE(plan.varies_nothing());
}

TEST(PlanSteps, LoadsThatAreNotNamedKeepTheFactorOne) {
  PlacedScene scene;
  scene.loads.resize(3);
  scene.steps.resize(2);
  scene.steps[0].factors = {{1, 0, 0.5}};
  scene.steps[0].increments = 7;
  scene.steps[1].prescribe = {{{0, 4}, 1e-3, 2e-3}};
  const std::vector<StepPlan> plans = plan_steps(scene);
  ASSERT_EQ(plans.size(), 2u);
  EXPECT_EQ(plans[0].increments, 7);
  EXPECT_EQ(plans[1].increments, 1);
  EXPECT_EQ(plans[0].target(1).load_factors, (std::vector<double>{1, 0.5, 1}));
  EXPECT_EQ(plans[1].target(0).load_factors, (std::vector<double>{1, 1, 1}));
  ASSERT_EQ(plans[1].prescribed.size(), 1u);
  EXPECT_EQ(plans[1].prescribed[0].to, 2e-3);
}

TEST(PlanSteps, TimeGoesOnFromStepToStep) {
  PlacedScene scene;
  scene.steps.resize(3);
  scene.steps[0].duration = 0.25;
  scene.steps[2].duration = 4;
  const std::vector<StepPlan> plans = plan_steps(scene);
  EXPECT_EQ(plans[0].target(0).time, 0);
  EXPECT_EQ(plans[0].target(1).time, 0.25);
  EXPECT_EQ(plans[1].target(1).time, 1.25);
  EXPECT_EQ(plans[2].target(0).time, 1.25);
  EXPECT_EQ(plans[2].target(0.5).time, 3.25);
}

TEST(ReactionWords, AreOfMoreThanWhatSolvingAndSummingLeave) {
  StepPlan plan;
  plan.prescribed.push_back({{CoordinateRef{0, 0}}, 0, 1});
  plan.prescribed.push_back({{CoordinateRef{0, 3}}, 0, 1e-3});
  JointModel rigid;
  rigid.scales.force = 200;
  rigid.scales.length = 0.05;
  JointModel layered = rigid;
  layered.layers.push_back({"soft", 0, 1, nullptr, nullptr, nullptr});
  layered.layers[0].tolerance = 1e-3;
  State state;
  const auto words = [&](const JointModel& model, int driven, double reaction, double rate = -1) {
    state.multipliers = {reaction, reaction};
    return reaction_words(model, plan, driven, rate, state);
  };
  EXPECT_EQ(words(rigid, 0, 0.57), "largest 0.57 Nm");
  EXPECT_EQ(words(rigid, 1, -3, 1), "smallest -3 N");
  // 1e-8 of 200 N, of 10 N m; a thousandth of them where that is how well the layer is summed.
  EXPECT_EQ(words(rigid, 1, 1.9e-6), "");
  EXPECT_NE(words(rigid, 1, 2.1e-6), "");
  EXPECT_EQ(words(rigid, 0, -0.9e-7), "");
  EXPECT_NE(words(rigid, 0, -1.1e-7), "");
  EXPECT_EQ(words(layered, 1, -0.19), "");
  EXPECT_NE(words(layered, 1, -0.21), "");
  EXPECT_EQ(words(layered, 0, 0.009), "");
  EXPECT_NE(words(layered, 0, 0.011), "");
  layered.layers[0].tolerance = 0;  // between triangles
  EXPECT_EQ(words(layered, 0, -1e-5), "");
  EXPECT_NE(words(layered, 0, -1e-2), "");
}

}  // namespace
}  // namespace genu
