// The breaks each law states, against the law itself just beside them; laws continued straight; laws of one's own.
#include <cmath>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "genu/model/ligament_law.h"
#include "support/law_def.h"

namespace genu {
namespace {

LigamentLaw build(const std::string& kind, std::vector<std::pair<double, double>> table = {{0, 0}, {0.5, 20}, {2, 200}},
                  double transition = 0.5) {
  LigamentDef def = test::law_def(kind, {{"stiffness", kind == "abdel-rahman" ? 500. : 100.},
                                         {"toe_stiffness", 30000},
                                         {"transition_strain", transition}});
  def.points = std::move(table);
  def.rest_value = 0.02;
  std::string why;
  const auto law = make_law(def, 1, why);
  EXPECT_TRUE(law) << why;
  return *law;
}

void expect_breaks_as_evaluated(const LigamentLaw& law, std::size_t count, const std::string& name) {
  ASSERT_EQ(law.breaks().size(), count) << name;
  for (std::size_t k = 0; k < count; ++k) {
    const LawBreak& b = law.breaks()[k];
    const double h = 1e-9 * b.length;
    const LawValue below = law.evaluate(b.length - h), at = law.evaluate(b.length), above = law.evaluate(b.length + h);
    EXPECT_NEAR(at.force, b.below.force, 1e-12 * (1 + at.force)) << name;
    EXPECT_NEAR(above.force, b.above.force + h * b.above.stiffness, 1e-12 * (1 + above.force)) << name;
    EXPECT_NEAR(below.stiffness, b.below.stiffness, 1e-5 * (2 + std::abs(b.below.stiffness))) << name;
    EXPECT_NEAR(above.stiffness, b.above.stiffness, 1e-5 * (2 + std::abs(b.above.stiffness))) << name;
    EXPECT_EQ(law.piece_at(b.length + h) - law.piece_at(b.length), b.sharp() ? 1 : 0) << name;
    EXPECT_EQ(b.below.slack, law.evaluate(b.length * 0.999).force == 0) << name;
  }
}

TEST(LawBreaks, AreWhereEveryLawBreaks) {
  expect_breaks_as_evaluated(build("quadratic"), 1, "quadratic");
  expect_breaks_as_evaluated(build("linear"), 1, "linear");
  expect_breaks_as_evaluated(build("blankevoort"), 2, "blankevoort");
  expect_breaks_as_evaluated(build("blankevoort", {}, 0), 1, "blankevoort without a toe");
  expect_breaks_as_evaluated(build("abdel-rahman"), 2, "abdel-rahman");
  expect_breaks_as_evaluated(build("abdel-rahman", {}, 0), 1, "abdel-rahman without a toe");
  expect_breaks_as_evaluated(build("spring"), 0, "spring");
  expect_breaks_as_evaluated(build("table"), 1, "table");
  expect_breaks_as_evaluated(build("table", {{0.1, 50}, {0.2, 150}}), 1, "table that begins above 0");
  expect_breaks_as_evaluated(build("table", {{0, 0}, {0.2, 150}, {0.4, 50}}), 2, "table that falls to 0");
}

TEST(LawBreaks, TellAJumpFromAKink) {
  const LigamentLaw jump = build("abdel-rahman");
  EXPECT_FALSE(jump.breaks()[0].jumps());
  EXPECT_TRUE(jump.breaks()[1].jumps());
  EXPECT_NEAR(jump.breaks()[1].force_jump(), 500 * 0.005 - 30000 * 1e-4, 1e-14);
  EXPECT_FALSE(build("linear").breaks()[0].jumps());
  EXPECT_NEAR(build("linear").breaks()[0].stiffness_jump(), 5000, 1e-9);
}

TEST(LawBreaks, AreSharpWhereForceOrStiffnessJumps) {
  const auto sharp = [](const LigamentLaw& law) {
    std::string out;
    for (const LawBreak& b : law.breaks()) out += b.sharp() ? 's' : '-';
    return out;
  };
  EXPECT_EQ(sharp(build("quadratic")), "-");
  EXPECT_EQ(sharp(build("linear")), "s");
  EXPECT_EQ(sharp(build("blankevoort")), "--");
  EXPECT_EQ(sharp(build("blankevoort", {}, 0)), "s");
  EXPECT_EQ(sharp(build("abdel-rahman")), "-s");
  EXPECT_EQ(sharp(build("table")), "s") << "the first point's slope is not 0";
  EXPECT_EQ(sharp(build("table", {{0, 0}, {0.1, 0}, {0.5, 20}, {2, 200}})), "-") << "flat before it rises";
  EXPECT_EQ(sharp(build("table", {{0, 0}, {0.1, 0}, {0.5, 20}, {0.7, 0}, {0.8, 0}})), "--");
  EXPECT_EQ(sharp(build("table", {{0.1, 50}, {0.2, 150}})), "s") << "straight to 0, then nothing";
  // K1 = 2 K2 e_t L0 makes the stiffness continuous, but then the force is continuous as well: the blankevoort law.
  LigamentDef def = test::law_def(
      "abdel-rahman", {{"stiffness", 2 * 30000 * 0.3 * 0.021}, {"toe_stiffness", 30000}, {"transition_strain", 0.3}});
  def.rest_value = 0.021;
  std::string why;
  EXPECT_EQ(sharp(*make_law(def, 1, why)), "--");
}

TEST(LawBreaks, PiecesGoOnStraightAndAreTheLawInside) {
  for (const char* kind : {"quadratic", "linear", "blankevoort", "abdel-rahman", "table"}) {
    const LigamentLaw law = build(kind);
    for (double length = 0.005; length < 0.05; length += 0.00037) {
      const int here = law.piece_at(length);
      EXPECT_EQ(law.evaluate(length, here).force, law.evaluate(length).force);
      for (int piece = 0; piece <= static_cast<int>(law.sharp_breaks().size()); ++piece) {
        const auto k = static_cast<std::size_t>(piece);
        if (piece == here) continue;
        const LawBreak& b = law.sharp_breaks()[piece < here ? k : k - 1];
        const LawBreak::Side& side = piece < here ? b.below : b.above;
        EXPECT_NEAR(law.evaluate(length, piece).force, side.force + side.stiffness * (length - b.length), 1e-12);
        EXPECT_EQ(law.evaluate(length, piece).stiffness, side.stiffness);
      }
    }
  }
}

/// Rises from 10 to 20 mm, is slack to 30 mm, then a stiff line.
struct SlackBetween final : ForceLaw {
  LawValue evaluate(double length) const override {
    const double up = length - 0.03, down = 0.02 - length;
    return up > 0 ? LawValue{1e3 * up, 1e3, 0} : down > 0 ? LawValue{-1e4 * down * down, 2e4 * down, 0} : LawValue{};
  }
  std::vector<LawBreak> breaks() const override {
    return {{0.02, {0, 0}, {0, 0, true}}, {0.03, {0, 0, true}, {0, 1e3}}};
  }
};

TEST(LawBreaks, APieceIsSlackOnlyWhereAllOfItIs) {
  std::string why;
  const auto law = LigamentLaw::custom(std::make_shared<SlackBetween>(), why);
  ASSERT_TRUE(law) << why;
  ASSERT_EQ(law->sharp_breaks().size(), 1u);
  EXPECT_FALSE(law->is_slack(0)) << "it pushes below 20 mm";
  EXPECT_FALSE(law->is_slack(1));
  EXPECT_TRUE(build("linear").is_slack(0));
  EXPECT_FALSE(build("linear").is_slack(1));
  EXPECT_FALSE(build("abdel-rahman").is_slack(0)) << "the toe is part of it";
}

TEST(LawBreaks, OfTheLawsOfScenesAreThoseThatALawOfOnesOwnMayState) {
  for (const auto& kind : kLaws) {
    LawValues values{{}, {{0, 0}, {0.5, 20}, {2, 200}}};
    for (std::size_t k = 0; k < kind().numbers.size(); ++k) values.numbers.push_back(0.5);
    std::string why;
    EXPECT_TRUE(LigamentLaw::custom(kind().make(values, 0.02), why)) << kind().name << ": " << why;
  }
}

struct Stated final : ForceLaw {
  explicit Stated(std::vector<LawBreak> b) : stated(std::move(b)) {}
  LawValue evaluate(double length) const override { return {length > 0.02 ? 7.0 : 3.0, 0, 0}; }
  std::vector<LawBreak> breaks() const override { return stated; }
  std::vector<LawBreak> stated;
};

TEST(LawBreaks, OfALawOfOnesOwnAreHeldToWhatItEvaluatesTo) {
  const auto fault = [](std::vector<LawBreak> breaks) {
    std::string why;
    const auto law = LigamentLaw::custom(std::make_shared<Stated>(std::move(breaks)), why);
    EXPECT_EQ(law.has_value(), why.empty());
    return why;
  };
  EXPECT_EQ(fault({{0.02, {3, 0}, {7, 0}}}), "");
  EXPECT_NE(fault({{0.02, {3, 0}, {8, 0}}}).find("above the break"), std::string::npos);
  EXPECT_NE(fault({{0.02, {2, 0}, {7, 0}}}).find("at the break"), std::string::npos);
  EXPECT_NE(fault({{0.03, {7, 0}, {7, 0}}, {0.02, {3, 0}, {7, 0}}}).find("increase"), std::string::npos);
  EXPECT_NE(fault({{std::numeric_limits<double>::quiet_NaN(), {}, {}}}).find("finite"), std::string::npos);
  std::string why;
  EXPECT_FALSE(LigamentLaw::custom(nullptr, why));
  EXPECT_FALSE(why.empty());
}

}  // namespace
}  // namespace genu
