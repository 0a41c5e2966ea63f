#include "scene/scene_text.h"

#include <numbers>

namespace genu::scene_test {
namespace {

std::string scaled(const std::string& scale) { return edited("frame = \"body\"", "scale = " + scale); }

ScaleDef scale_of(const std::string& scale) {
  const auto read = good(scaled(scale)).loads.at(0).scale;
  EXPECT_TRUE(read.has_value());
  return read.value_or(ScaleDef{});
}

void expect_scale_refused(const std::string& scale, const std::string& key, const std::string& found,
                          const std::string& rule) {
  SCOPED_TRACE(scale);
  expect_one_error(scaled(scale), "load.push.scale" + key, found, rule);
}

TEST(ReadScale, Values) {
  EXPECT_FALSE(good(kGoodScene).loads.at(0).scale.has_value());
  const ScaleDef angle = scale_of("{ over = \"knee.flexion\", table = [[-10, 0], [90, 2.5]] }");
  EXPECT_EQ(angle.kind, ScaleDef::Kind::over_coordinate);
  EXPECT_EQ(angle.coordinate, (CoordinateRef{0, 0}));
  ASSERT_EQ(angle.table.size(), 2u);
  EXPECT_DOUBLE_EQ(angle.table[1].first, std::numbers::pi / 2);
  EXPECT_EQ(angle.table[1].second, 2.5);
  EXPECT_DOUBLE_EQ(scale_of("{ over = \"knee.z\", table = [[0, 0], [5, 1]] }").table[1].first, 5e-3);
  const ScaleDef time = scale_of("{ over = \"time\", table = [[0, 0], [5, 1], [6, -1]] }");
  EXPECT_EQ(time.kind, ScaleDef::Kind::over_time);
  EXPECT_EQ(time.table[2].first, 6) << "s";
  const ScaleDef sine = scale_of("{ sine = { amplitude = 28.8, frequency = 0.125, start = 1 } }");
  EXPECT_EQ(sine.kind, ScaleDef::Kind::sine);
  EXPECT_EQ(sine.amplitude, 28.8);
  EXPECT_EQ(sine.frequency, 0.125);
  EXPECT_EQ(sine.start, 1);
  EXPECT_EQ(scale_of("{ sine = { amplitude = -1, frequency = 2 } }").start, 0);
}

TEST(ReadScale, Feedback) {
  const ScaleDef held = scale_of("{ feedback = { of = \"knee.flexion\", target = 30, gain = 2 } }");
  EXPECT_EQ(held.kind, ScaleDef::Kind::feedback);
  EXPECT_EQ(held.coordinate, (CoordinateRef{0, 0}));
  EXPECT_DOUBLE_EQ(held.gain, 2 * 180 / std::numbers::pi) << "per rad";
  EXPECT_DOUBLE_EQ(held.target->table[0].second, std::numbers::pi / 6);
  EXPECT_FALSE(held.in_time());
  const ScaleDef moved =
      scale_of("{ feedback = { of = \"knee.z\", target = { table = [[0, 1], [1, 5]] }, gain = 3 } }");
  EXPECT_DOUBLE_EQ(moved.gain, 3e3) << "per m";
  EXPECT_DOUBLE_EQ(moved.target->table[1].second, 5e-3);
  EXPECT_TRUE(moved.in_time());
}

TEST(ReadScale, FeedbackErrors) {
  expect_scale_refused("{ feedback = @3 }", ".feedback", "3", "must be a table");
  expect_scale_refused("{ feedback = { of = @\"knee.flexon\", target = 0, gain = 1 } }", ".feedback.of",
                       "\"knee.flexon\"", "did you mean \"knee.flexion\"?");
  expect_scale_refused("{ feedback = { of = \"knee.flexion\", target = 0, gain = @-1 } }", ".feedback.gain", "-1",
                       ">= 0");
  expect_scale_refused("{ feedback = { of = \"knee.flexion\", target = 0, gain = @0 } }", ".feedback.gain", "0",
                       "never acts");
  expect_scale_refused("{ feedback = { of = \"knee.flexion\", target = 0, gain = 1, rate_gain = @2 } }",
                       ".feedback.rate_gain", "2", "needs [dynamics]");
  expect_scale_refused("{ feedback = { of = \"knee.flexion\", target = @\"x\", gain = 1 } }", ".feedback.target",
                       "\"x\"", "must be a table");
  expect_one_error(edited("frame = \"body\"", "scale = { @feedback = { of = \"knee.flexion\", gain = 1 } }"),
                   "load.push.scale.feedback.target", "", "is missing");
}

TEST(ReadScale, EveryKindOfLoadMayHaveOne) {
  const std::string load = "force = [0, 100, 0]\npoint = [1, 0, 0]\nframe = \"body\"\n";
  const std::string scale = "scale = { over = \"time\", table = [[0, 0], [1, 1]] }\n";
  const std::string on = edited("body = \"femur\"\n" + load, "on = \"knee.x\"\n" + scale);
  EXPECT_TRUE(good(on).loads.at(0).scale.has_value());
  const std::string toward = "toward = { body = \"tibia\", point = [0, 0, 0] }\nmagnitude = 3\n";
  EXPECT_TRUE(good(edited(load, toward + scale)).loads.at(0).scale.has_value());
}

TEST(ReadScale, TableErrors) {
  expect_scale_refused("@3", "", "3", "must be a table");
  expect_one_error(edited("frame = \"body\"", "@scale = {}"), "load.push.scale", "",
                   "give `over` and `table`, or `sine`");
  expect_one_error(edited("frame = \"body\"", "@scale = { over = \"time\" }"), "load.push.scale.table", "",
                   "is missing");
  expect_one_error(edited("frame = \"body\"", "@scale = { table = [[0, 1], [1, 2]] }"), "load.push.scale.over", "",
                   "is missing");
  expect_scale_refused("{ over = @\"knee.flexon\", table = [[0, 1], [1, 2]] }", ".over", "\"knee.flexon\"",
                       "did you mean \"knee.flexion\"?");
  expect_scale_refused("{ over = \"time\", table = @[[0, 1]] }", ".table", "[[0, 1]]",
                       "at least two points [x, factor]");
  expect_scale_refused("{ over = \"time\", table = [[0, 1], @3] }", ".table[2]", "3", "a point [x, factor]");
  expect_scale_refused("{ over = \"knee.x\", table = [[0, 1], [@0, 2]] }", ".table[2][1]", "0", "must increase");
  expect_scale_refused("{ over = \"knee.x\", table = [[0, 1], [1, @nan]] }", ".table[2][2]", "nan", "finite");
  expect_scale_refused("{ over = \"knee.x\", table = [[@\"a\", 1], [1, 2], [2, 3]] }", ".table[1][1]", "\"a\"",
                       "in mm");
  expect_scale_refused("{ over = \"time\", table = [[0, 1], [1, 2]], @hold = true }", ".hold", "true",
                       "is no key of the scale");
}

TEST(ReadScale, SineErrors) {
  expect_one_error(edited("frame = \"body\"", "scale = { @sine = { amplitude = 1 } }"),
                   "load.push.scale.sine.frequency", "", "is missing");
  expect_one_error(edited("frame = \"body\"", "scale = { @sine = { frequency = 1 } }"),
                   "load.push.scale.sine.amplitude", "", "is missing");
  expect_scale_refused("{ sine = @1 }", ".sine", "1", "must be a table");
  expect_scale_refused("{ sine = { amplitude = 1, frequency = @0 } }", ".sine.frequency", "0", "must be > 0 Hz");
  expect_scale_refused("{ sine = { amplitude = 1, frequency = 1, start = @\"0\" } }", ".sine.start", "\"0\"", "in s");
  expect_scale_refused("{ sine = { amplitude = 1, frequency = 1, @phase = 0 } }", ".sine.phase", "0",
                       "is no key of a sine");
  expect_scale_refused("{ sine = { amplitude = 1, frequency = 1 }, @over = \"time\" }", ".over", "\"time\"",
                       "is no key of a scale with a sine");
}

}  // namespace
}  // namespace genu::scene_test
