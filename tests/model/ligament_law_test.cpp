// Every law against its formula, its own energy and stiffness by finite differences, and the three ways to give its
// rest.
#include "genu/model/ligament_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/law_def.h"

namespace genu {
namespace {

using Rest = LigamentDef::Rest;

constexpr double kSlack = 0.03;  // m

LigamentDef definition(const std::string& law, double stiffness) {
  LigamentDef def =
      test::law_def(law, {{"stiffness", stiffness}, {"toe_stiffness", 2.2e7}, {"transition_strain", 0.06}});
  def.rest_value = kSlack;
  def.points = {{-0.02, 0}, {0, 0}, {0.02, 10}, {0.05, 80}, {0.1, 240}};
  return def;
}

/// One of each law, with values like a knee ligament's.
std::vector<LigamentDef> all_laws() {
  return {definition("quadratic", 15000), definition("linear", 2000),        definition("blankevoort", 4000),
          definition("spring", 25000),    definition("abdel-rahman", 80000), definition("table", 0)};
}

LigamentLaw build(const LigamentDef& def, double reference_length = kSlack) {
  std::string why;
  auto law = make_law(def, reference_length, why);
  EXPECT_TRUE(law) << why;
  return *law;
}

bool tension_only(const LigamentDef& def) { return def.law != "spring"; }

TEST(LigamentLaw, FormulasAtFourPercent) {
  const double length = kSlack * 1.04;
  EXPECT_NEAR(build(definition("quadratic", 15000)).evaluate(length).force, 15000 * 0.0016, 1e-11);
  EXPECT_NEAR(build(definition("linear", 2000)).evaluate(length).force, 80, 1e-11);
  EXPECT_NEAR(build(definition("blankevoort", 4000)).evaluate(length).force, 4000 * 0.0016 / 0.12, 1e-11);
  EXPECT_NEAR(build(definition("spring", 25000)).evaluate(length).force, 30, 1e-11);
  EXPECT_NEAR(build(definition("abdel-rahman", 80000)).evaluate(length).force, 2.2e7 * 0.0012 * 0.0012, 1e-10);
  EXPECT_NEAR(build(definition("table", 0)).evaluate(kSlack * 1.05).force, 80, 1e-10);
}

TEST(LigamentLaw, FormulasBeyondTheToe) {
  const double length = kSlack * 1.1;
  EXPECT_NEAR(build(definition("blankevoort", 4000)).evaluate(length).force, 4000 * (0.1 - 0.03), 1e-11);
  EXPECT_NEAR(build(definition("abdel-rahman", 80000)).evaluate(length).force, 80000 * (length - 1.03 * kSlack), 1e-10);
}

TEST(LigamentLaw, StiffnessesAreTheFormulasDerivatives) {
  const double toe = kSlack * 1.04, line = kSlack * 1.1;
  EXPECT_NEAR(build(definition("quadratic", 15000)).evaluate(toe).stiffness, 2 * 15000 * 0.04 / kSlack, 1e-8);
  EXPECT_NEAR(build(definition("linear", 2000)).evaluate(toe).stiffness, 2000 / kSlack, 1e-8);
  EXPECT_NEAR(build(definition("blankevoort", 4000)).evaluate(toe).stiffness, 4000 * 0.04 / 0.06 / kSlack, 1e-8);
  EXPECT_NEAR(build(definition("blankevoort", 4000)).evaluate(line).stiffness, 4000 / kSlack, 1e-8);
  EXPECT_EQ(build(definition("spring", 25000)).evaluate(toe).stiffness, 25000);
  EXPECT_NEAR(build(definition("abdel-rahman", 80000)).evaluate(toe).stiffness, 2 * 2.2e7 * 0.0012, 1e-8);
  EXPECT_EQ(build(definition("abdel-rahman", 80000)).evaluate(line).stiffness, 80000);
}

TEST(LigamentLaw, ATableOfTwoIntervalsIsTheCubicsOfItsFormula) {
  // Secants 200 and 400 on equal intervals of 0.1: slopes 100, 266.67 and 500 (three-point ends, harmonic mean within).
  LigamentDef def = definition("table", 0);
  def.points = {{0, 0}, {0.1, 20}, {0.2, 60}};
  const LigamentLaw law = build(def);
  const double middle = 2 * 200.0 * 400 / 600;
  const auto half_way = [](double y0, double m0, double y1, double m1) {
    return LawValue{(y0 + y1) / 2 + 0.1 * (m0 - m1) / 8, (1.5 * (y1 - y0) / 0.1 - (m0 + m1) / 4) / kSlack, 0};
  };
  const LawValue first = law.evaluate(kSlack * 1.05), second = law.evaluate(kSlack * 1.15);
  const LawValue first_exact = half_way(0, 100, 20, middle), second_exact = half_way(20, middle, 60, 500);
  EXPECT_NEAR(first.force, first_exact.force, 1e-11);
  EXPECT_NEAR(first.stiffness, first_exact.stiffness, 1e-8);
  EXPECT_NEAR(second.force, second_exact.force, 1e-11);
  EXPECT_NEAR(second.stiffness, second_exact.stiffness, 1e-8);
  const LawValue beyond = law.evaluate(kSlack * 1.3);
  EXPECT_NEAR(beyond.force, 60 + 500 * 0.1, 1e-10);
  EXPECT_NEAR(beyond.stiffness, 500 / kSlack, 1e-8);
}

TEST(LigamentLaw, BlankevoortIsOnceDifferentiableAtTheToesEnd) {
  const LigamentLaw law = build(definition("blankevoort", 4000));
  const double length = kSlack * 1.06, h = 1e-12;
  const LawValue below = law.evaluate(length - h), above = law.evaluate(length + h);
  EXPECT_NEAR(below.force, above.force, 1e-6);
  EXPECT_NEAR(below.stiffness, above.stiffness, 1e-4);
  EXPECT_NEAR(below.energy, above.energy, 1e-9);
}

TEST(LigamentLaw, AbdelRahmanJumpsAtTheToesEndButItsEnergyDoesNot) {
  const LigamentLaw law = build(definition("abdel-rahman", 80000));
  const double length = kSlack * 1.06, h = 1e-9;
  const LawValue below = law.evaluate(length - h), above = law.evaluate(length + h);
  EXPECT_NEAR(above.force - below.force, 80000 * 0.0009 - 2.2e7 * 0.0018 * 0.0018, 1e-3);
  EXPECT_NEAR(above.energy, below.energy, 1e-6);
}

TEST(LigamentLaw, ForceIsTheEnergysDerivativeAndStiffnessTheForces) {
  for (const LigamentDef& def : all_laws()) {
    const LigamentLaw law = build(def);
    double worst_force = 0, worst_stiffness = 0;
    for (double e = -0.0505; e < 0.2; e += 0.00321) {
      const double length = kSlack * (1 + e), h = 1e-8;
      const bool near_break =
          std::min({std::abs(e), std::abs(e - 0.02), std::abs(e - 0.05), std::abs(e - 0.06)}) < 1e-5;
      if (near_break) continue;
      const LawValue v = law.evaluate(length), up = law.evaluate(length + h), down = law.evaluate(length - h);
      worst_force = std::max(worst_force, std::abs((up.energy - down.energy) / (2 * h) - v.force));
      worst_stiffness = std::max(worst_stiffness, std::abs((up.force - down.force) / (2 * h) - v.stiffness) / 1e5);
    }
    EXPECT_LT(worst_force, 1e-6) << "law " << def.law;
    EXPECT_LT(worst_stiffness, 1e-5) << "law " << def.law;
  }
}

TEST(LigamentLaw, TensionOnlyLawsAreExactlyZeroWhenSlack) {
  for (const LigamentDef& def : all_laws()) {
    if (!tension_only(def)) continue;
    const LigamentLaw law = build(def);
    EXPECT_NEAR(law.slack_until(), kSlack, 1e-17);
    for (double length : {0.0, 0.5 * kSlack, kSlack}) {
      const LawValue v = law.evaluate(length);
      EXPECT_TRUE(v.force == 0 && v.stiffness == 0 && v.energy == 0) << "law " << def.law;
    }
    EXPECT_GT(law.evaluate(kSlack * (1 + 1e-9)).force, 0) << "law " << def.law;
  }
}

TEST(LigamentLaw, SpringPushesAndMayHaveNoSlackLength) {
  const LigamentLaw spring = build(definition("spring", 25000));
  EXPECT_NEAR(spring.evaluate(0.02).force, -250, 1e-12);
  EXPECT_LT(spring.slack_until(), 0);
  LigamentDef def = definition("spring", 25000);
  def.rest_value = 0;
  const LigamentLaw zero = build(def);
  EXPECT_EQ(zero.evaluate(0.01).force, 250);
  EXPECT_EQ(zero.evaluate(0).force, 0);
  EXPECT_EQ(zero.evaluate(0).stiffness, 25000);
  EXPECT_TRUE(std::isnan(zero.strain(0.01)));
}

TEST(LigamentLaw, TableWithNegativeForcesPushes) {
  LigamentDef def = definition("table", 0);
  def.points = {{-0.1, -20}, {0, 0}, {0.1, 50}};
  const LigamentLaw law = build(def);
  EXPECT_NEAR(law.evaluate(kSlack * 0.9).force, -20, 1e-12);
  EXPECT_LT(law.evaluate(kSlack * 0.8).force, -20);
  EXPECT_EQ(law.evaluate(kSlack).energy, 0);
  EXPECT_GT(law.evaluate(kSlack * 0.9).energy, 0);
}

TEST(LigamentLaw, StrainKeepsItsDigitsNearTheSlackLength) {
  const LigamentLaw law = build(definition("linear", 2000));
  const double length = kSlack * (1 + 0x1p-40);
  const long double exact = (static_cast<long double>(length) - kSlack) / kSlack;
  EXPECT_EQ(law.strain(length), static_cast<double>(exact));
}

TEST(LigamentLaw, ReferenceStrainIsTheStrainAtTheReferenceLength) {
  for (LigamentDef def : all_laws())
    for (double strain : {-0.12, 0.0, 0.03, 0.2}) {
      def.rest = Rest::reference_strain;
      def.rest_value = strain;
      const LigamentLaw law = build(def, 0.041);
      EXPECT_NEAR(law.strain(0.041), strain, 4e-16);
      EXPECT_NEAR(law.slack_length(), 0.041 / (1 + strain), 1e-17);
    }
}

TEST(LigamentLaw, ReferenceForceIsTheForceAtTheReferenceLength) {
  for (LigamentDef def : all_laws()) {
    def.rest = Rest::reference_force;
    if (def.law == "abdel-rahman") def.numbers[1].value = 2e8;  // jumps down: every force is had, some twice
    double worst = 0;
    for (double force : {1e-6, 0.1, 5.0, 40.0, 95.0, 300.0}) {
      def.rest_value = force;
      worst = std::max(worst, std::abs(build(def, 0.041).evaluate(0.041).force - force) / (1 + force));
    }
    EXPECT_LT(worst, 1e-12) << "law " << def.law;
  }
}

TEST(LigamentLaw, ReferenceForceZeroIsAboutToBecomeTaut) {
  for (LigamentDef def : all_laws()) {
    def.rest = Rest::reference_force;
    def.rest_value = 0;
    EXPECT_NEAR(build(def, 0.041).slack_length(), 0.041, 1e-17) << "law " << def.law;
  }
}

TEST(LigamentLaw, ReferenceForceOfASpringCanMeanSlackLengthZeroOrCompression) {
  LigamentDef def = definition("spring", 25000);
  def.rest = Rest::reference_force;
  def.rest_value = 25000 * 0.041;
  EXPECT_EQ(build(def, 0.041).slack_length(), 0);
  def.rest_value = -25;
  EXPECT_NEAR(build(def, 0.041).slack_length(), 0.042, 1e-16);
}

TEST(LigamentLaw, RefusesWhatIsImpossible) {
  std::string why;
  const auto refused = [&](LigamentDef def, Rest rest, double value, double reference_length) {
    def.rest = rest;
    def.rest_value = value;
    return !make_law(def, reference_length, why) && !why.empty();
  };
  for (const LigamentDef& def : all_laws()) {
    const std::string& law = def.law;
    EXPECT_TRUE(refused(def, Rest::slack_length, -0.01, 0.04)) << law;
    EXPECT_EQ(refused(def, Rest::slack_length, 0, 0.04), def.law != "spring") << law;
    EXPECT_TRUE(refused(def, Rest::reference_strain, -1, 0.04)) << law;
    EXPECT_TRUE(refused(def, Rest::reference_strain, 0.02, 0)) << law;
    EXPECT_TRUE(refused(def, Rest::reference_force, std::numeric_limits<double>::quiet_NaN(), 0.04)) << law;
    EXPECT_EQ(refused(def, Rest::reference_force, -5, 0.04), tension_only(def)) << law;
  }
  EXPECT_TRUE(refused(definition("spring", 25000), Rest::reference_force, 1001, 0.04)) << "slack length < 0";
  EXPECT_TRUE(refused(definition("quadratic", 0), Rest::slack_length, 0.04, 0.04)) << "no stiffness";
  // At this length the toe gives at most 71 N, the line at least 720 N.
  LigamentDef jump = definition("abdel-rahman", 800000);
  EXPECT_TRUE(refused(jump, Rest::reference_force, 300, kSlack * 1.06)) << "inside the jump";
  EXPECT_NE(why.find("no slack length"), std::string::npos) << why;
}

}  // namespace
}  // namespace genu
