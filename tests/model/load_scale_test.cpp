// Scales of loads: closed forms, slopes against finite differences, and what holds beyond the ends.
#include "genu/model/load_scale.h"

#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "support/finite_difference.h"

namespace genu {
namespace {

LoadScale made(const ScaleDef& def) {
  std::string why;
  auto scale = LoadScale::make(def, why);
  EXPECT_TRUE(scale.has_value()) << why;
  return *scale;
}

ScaleDef table_over(std::vector<std::pair<double, double>> points) {
  ScaleDef def;
  def.table = std::move(points);
  return def;
}

TEST(LoadScale, TwoPointsAreALineThatHoldsItsEnds) {
  const LoadScale scale = made(table_over({{0.2, -1}, {0.7, 4}}));
  EXPECT_FALSE(scale.coordinate().has_value());
  EXPECT_NEAR(scale.evaluate(0.3).factor, 0, 1e-15);
  EXPECT_NEAR(scale.evaluate(0.3).slope, 10, 1e-13);
  for (const double x : {-5.0, 0.1999, 0.2}) EXPECT_EQ(scale.evaluate(x).factor, -1) << x;
  for (const double x : {0.7, 0.7001, 1e3}) EXPECT_EQ(scale.evaluate(x).factor, 4) << x;
  for (const double x : {-5.0, 0.2, 0.7, 1e3}) EXPECT_EQ(scale.evaluate(x).slope, 0) << x;
  EXPECT_EQ(scale.largest(), 4);
}

TEST(LoadScale, ManyPointsAreMetAndNeverOvershot) {
  const std::vector<std::pair<double, double>> points = {{0, 0}, {1, 0}, {2, 3}, {2.5, 3}, {4, -7}};
  ScaleDef def = table_over(points);
  def.kind = ScaleDef::Kind::over_coordinate;
  def.coordinate = {2, 4};
  const LoadScale scale = made(def);
  EXPECT_EQ(scale.coordinate(), (CoordinateRef{2, 4}));
  EXPECT_EQ(scale.largest(), 7);
  for (const auto& [x, y] : points) EXPECT_NEAR(scale.evaluate(x).factor, y, 1e-14) << x;
  double worst = 0;
  for (double x = -0.45; x < 4.5; x += 0.1) {
    const LoadScale::Value v = scale.evaluate(x);
    EXPECT_TRUE(v.factor <= 3 && v.factor >= -7) << x;
    EXPECT_TRUE(x > 1 || v.factor == 0) << x;
    const double fd = test::derivative([&](double h) { return scale.evaluate(x + h).factor; }, 1e-3);
    worst = std::max(worst, std::abs(v.slope - fd));
  }
  EXPECT_LT(worst, 1e-9);
}

TEST(LoadScale, SineBeginsAtItsStart) {
  ScaleDef def;
  def.kind = ScaleDef::Kind::sine;
  def.amplitude = 28.8;
  def.frequency = 0.125;
  def.start = 1;
  const LoadScale scale = made(def);
  EXPECT_EQ(scale.largest(), 28.8);
  for (const double t : {-3.0, 0.0, 0.999}) EXPECT_TRUE(scale.evaluate(t).factor == 0 && scale.evaluate(t).slope == 0);
  EXPECT_EQ(scale.evaluate(1).factor, 0);
  EXPECT_NEAR(scale.evaluate(3).factor, 28.8, 1e-13);  // a quarter of 8 s later
  EXPECT_NEAR(scale.evaluate(7).factor, -28.8, 1e-13);
  EXPECT_NEAR(scale.evaluate(2).factor, 28.8 * std::numbers::sqrt2 / 2, 1e-13);
  for (const double t : {1.3, 4.0, 17.0}) {
    const double fd = test::derivative([&](double h) { return scale.evaluate(t + h).factor; }, 1e-2);
    EXPECT_NEAR(scale.evaluate(t).slope, fd, 1e-8);
  }
}

TEST(LoadScale, TellsItsKinksInTime) {
  ScaleDef sine;
  sine.kind = ScaleDef::Kind::sine;
  sine.amplitude = 2;
  sine.frequency = 0.125;
  sine.start = 1;
  EXPECT_EQ(made(sine).nonsmooth_points_in_time(), std::vector<double>{1});
  EXPECT_NEAR(made(sine).period(), 8, 1e-14);
  ScaleDef over = table_over({{0.5, 1}, {2, 3}, {3, 0}});
  over.kind = ScaleDef::Kind::over_time;
  EXPECT_EQ(made(over).nonsmooth_points_in_time(), (std::vector<double>{0.5, 2, 3}));
  EXPECT_EQ(made(over).period(), 0);
  over.kind = ScaleDef::Kind::over_coordinate;
  EXPECT_TRUE(made(over).nonsmooth_points_in_time().empty());
}

TEST(LoadScale, RefusesWhatIsNoTable) {
  std::string why;
  EXPECT_FALSE(LoadScale::make(table_over({{0, 1}}), why).has_value());
  EXPECT_NE(why.find("two points"), std::string::npos) << why;
  EXPECT_FALSE(LoadScale::make(table_over({{0, 1}, {0, 2}}), why).has_value());
  EXPECT_NE(why.find("increase"), std::string::npos) << why;
}

/// Slope and curvature against difference quotients, away from kinks.
void expect_derivatives(const LoadScale& scale, const std::vector<double>& places) {
  for (const double x : places) {
    const auto factor = [&](double d) { return scale.evaluate(x + d).factor; };
    EXPECT_NEAR(scale.evaluate(x).slope, test::derivative(factor, 1e-3), 1e-7) << x;
    EXPECT_NEAR(scale.evaluate(x).curvature, test::second_derivative(factor, 1e-3), 1e-4) << x;
  }
}

TEST(LoadScale, SlopesAndCurvatures) {
  ScaleDef sine;
  sine.kind = ScaleDef::Kind::sine;
  sine.amplitude = 2;
  sine.frequency = 0.7;
  sine.start = 1;
  sine.offset = 5;
  expect_derivatives(made(sine), {0.5, 1.2, 1.9, 3});
  EXPECT_EQ(made(sine).evaluate(0.5).factor, 5) << "before its start it is where it swings about";
  EXPECT_EQ(made(sine).largest(), 7);
  expect_derivatives(made(table_over({{0, 0}, {1, 0.3}, {2, 3}, {4, -7}})), {-1, 0.4, 1.5, 3, 5});
  ScaleDef step;
  step.kind = ScaleDef::Kind::step;
  step.from = -1;
  step.to = 3;
  step.start = 0.5;
  step.rise = 2;
  expect_derivatives(made(step), {0.2, 0.7, 1.5, 2.2, 2.7});
}

TEST(LoadScale, AStepIsSmoothAndEndsWhereItShould) {
  ScaleDef def;
  def.kind = ScaleDef::Kind::step;
  def.from = 1;
  def.to = 5;
  def.start = 2;
  def.rise = 0.5;
  const LoadScale step = made(def);
  EXPECT_EQ(step.evaluate(1.999).factor, 1);
  EXPECT_NEAR(step.evaluate(2.25).factor, 3, 1e-15) << "half way";
  EXPECT_EQ(step.evaluate(2.5).factor, 5);
  for (const double end : {2.0, 2.5})
    for (const double beside : {-1e-6, 1e-6}) {
      EXPECT_NEAR(step.evaluate(end + beside).slope, 0, 1e-8);
      EXPECT_NEAR(step.evaluate(end + beside).curvature, 0, 1e-2) << "of up to 92";
    }
  EXPECT_EQ(step.nonsmooth_points_in_time(), (std::vector<double>{2, 2.5}));
  def.rise = 0;
  EXPECT_EQ(made(def).evaluate(2 - 1e-12).factor, 1);
  EXPECT_EQ(made(def).evaluate(2).factor, 5);
}

TEST(LoadScale, FeedbackIsAFunctionOfItsCoordinateAndOfTime) {
  ScaleDef course;
  course.kind = ScaleDef::Kind::sine;
  course.amplitude = 0.3;
  course.frequency = 0.7;
  ScaleDef def;
  def.kind = ScaleDef::Kind::feedback;
  def.coordinate = {0, 1};
  def.gain = 5;
  def.rate_gain = 0.4;
  def.target = std::make_shared<const ScaleDef>(course);
  const LoadScale scale = made(def);
  EXPECT_TRUE(scale.is_feedback() && scale.has_rate());
  EXPECT_EQ(*scale.coordinate(), (CoordinateRef{0, 1}));
  const double time = 1.3, x = 0.2, h = 1e-4;
  const LoadScale::Value value = scale.evaluate(x, time);
  EXPECT_NEAR(value.factor, 5 * (0.3 * std::sin(2 * M_PI * 0.7 * time) - x), 1e-14);
  EXPECT_NEAR(value.slope, test::derivative([&](double d) { return scale.evaluate(x + d, time).factor; }, 1e-3), 1e-9);
  EXPECT_NEAR(scale.rate_in_time(time, value.slope),
              (scale.evaluate(x, time + h).factor - scale.evaluate(x, time - h).factor) / (2 * h), 1e-6);
  EXPECT_NEAR(scale.rate_term(time, 0.7), 0.4 * (0.3 * 2 * M_PI * 0.7 * std::cos(2 * M_PI * 0.7 * time) - 0.7), 1e-14);
  EXPECT_EQ(scale.nonsmooth_points_in_time(), std::vector<double>{0}) << "of its target";
  EXPECT_NEAR(scale.period(), 1 / 0.7, 1e-14);
  EXPECT_TRUE(scale.nonsmooth_points_over_coordinate().empty());
}

}  // namespace
}  // namespace genu
