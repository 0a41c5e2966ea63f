// Where Hertz applies, and in which words he is refused.
#include "genu/appraise/hertz_check.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/knee_scene.h"
#include "support/scene_model.h"
#include "support/scenes.h"

namespace genu {
namespace {

/// A ball pressed into a plate by a soft layer; row k has the k-th depth (mm).
std::string ball(const std::string& shape, const std::string& layer, double from, double to) {
  return test::bone_on_ground("{ z = 20 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
         test::surface("floor", "ground", shape) +
         "[contact.foot]\nsurfaces = [\"ball\", \"floor\"]\nmodel = \"cartilage\"\nmodulus = 5\npoisson = 0.4\n" +
         layer + test::spring("cord", "[0, 0, 0]", "[0, 0, 20]", 1, 0) +
         "[[step]]\nprescribe = { \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0, \"j.y\" = 0, \"j.z\" = [" +
         std::to_string(20 - from) + ", " + std::to_string(20 - to) + "] }\nincrements = 8\n";
}

RunSummary summary_of(const std::string& text) {
  Diagnostics out;
  const auto scene = parse_scene(text, "scene.toml", out);
  EXPECT_TRUE(scene) << test::messages(out);
  return scene ? test::solved(*scene).summary : RunSummary();
}

TEST(HertzCheck, BallOnAThickLayer) {
  // 0.05 mm into 10 mm: half axis 1 mm.
  const RunSummary s = summary_of(ball("plane", "thickness = 10\n", 0.01, 0.05));
  ASSERT_EQ(s.hertz.size(), 1u);
  const HertzCheck& c = s.hertz[0];
  ASSERT_TRUE(c.applies()) << c.why;
  const double R = 0.02, d = 0.05e-3, E = 5e6 / (2 * (1 - 0.16));
  EXPECT_EQ(c.row, 9u);
  EXPECT_NEAR(c.approach / d, 1, 1e-9);
  EXPECT_NEAR(c.a / std::sqrt(R * d), 1, 1e-6);
  EXPECT_NEAR(c.b / c.a, 1, 1e-6);
  EXPECT_NEAR(c.force / (4.0 / 3 * E * std::sqrt(R) * std::pow(d, 1.5)), 1, 1e-6);
  EXPECT_NEAR(c.peak_pressure / (2 * E * std::sqrt(d / R) / M_PI), 1, 1e-6);
  EXPECT_NEAR(c.axis_over_thickness, 0.1, 1e-3);
  const double M = 5e6 * 0.6 / (1.4 * 0.2);
  EXPECT_NEAR(c.layer_force / (M_PI * M / 0.01 * d * d * R), 1, 0.02);
  const std::string said = s.verdict.back();
  EXPECT_NE(said.find("(Hertz): the layer carries"), std::string::npos) << said;
}

TEST(HertzCheck, OneHalfSpaceOnBareBone) {
  const std::string both = ball("plane", "thickness = 10\n", 0.01, 0.05);
  std::string one = test::replaced(both, "thickness = 10\n", "");
  one = test::replaced(one, "radius = 20\n", "radius = 20\nthickness = 10\n");
  one = test::replaced(one, "shape = \"plane\"\n", "shape = \"plane\"\nthickness = 0\n");
  const RunSummary a = summary_of(both), b = summary_of(one);
  ASSERT_TRUE(a.hertz.size() == 1 && b.hertz.size() == 1);
  EXPECT_NEAR(b.hertz[0].force / a.hertz[0].force, 2, 1e-9);
  EXPECT_NEAR(b.hertz[0].a / a.hertz[0].a, 1, 1e-9);
}

TEST(HertzCheck, OfTheLargestForceWhereItApplies) {
  // Half axis sqrt(R d) = 2 mm at 0.2 mm, where the layer is 2 mm thick: rows on from there are refused.
  const RunSummary s = summary_of(ball("plane", "thickness = 2\n", 0.1, 0.5));
  ASSERT_EQ(s.hertz.size(), 1u);
  EXPECT_TRUE(s.hertz[0].applies()) << s.hertz[0].why;
  EXPECT_NEAR(s.hertz[0].approach, 0.2e-3, 1e-6 + 0.05e-3);
  EXPECT_LE(s.hertz[0].axis_over_thickness, 1);
}

TEST(HertzCheck, RefusedInWords) {
  const auto why = [](const std::string& text) {
    const RunSummary s = summary_of(text);
    EXPECT_EQ(s.hertz.size(), 1u);
    if (s.hertz.empty()) return std::string();
    EXPECT_FALSE(s.hertz[0].applies());
    for (const std::string& sentence : s.verdict) EXPECT_EQ(sentence.find("Hertz"), std::string::npos) << sentence;
    return s.hertz[0].why;
  };
  EXPECT_NE(why(ball("plane", "thickness = 0.5\n", 0.1, 0.2)).find("layer is thin"), std::string::npos);
  EXPECT_NE(why(ball("plane", "thickness = 20\n", 2, 3)).find("not small against the surfaces"), std::string::npos);
  // In a bowl of nearly its own radius the contact is as wide as the bowl.
  const std::string flat = "[surface.floor]\nbody = \"ground\"\nshape = \"plane\"\n";
  const std::string bowl = test::replaced(ball("plane", "thickness = 6\n", 0.4, 0.5), flat,
                                          "[surface.floor]\nbody = \"ground\"\nshape = \"sphere\"\nradius = 20.5\n"
                                          "origin = [0, 0, 20.5]\ninside = true\n");
  const std::string said = why(bowl);
  EXPECT_TRUE(said.find("times the ellipse") != std::string::npos || said.find("not small") != std::string::npos)
      << said;
}

TEST(HertzCheck, NothingWithoutContact) {
  EXPECT_TRUE(summary_of(ball("plane", "thickness = 6\n", -2, -1)).hertz.empty());
}

}  // namespace
}  // namespace genu
