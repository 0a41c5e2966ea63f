// Every law that a scene can name, by its table: its derivatives against differences, its rest length for a force, its
// breaks, and what its table says of its numbers.
#include "genu/law/laws.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace genu {
namespace {

constexpr double kSlack = 0.03;  // m

/// Like a knee ligament's.
LawValues some_values(const LawKind& kind) {
  LawValues values;
  for (const NumberRow& number : kind.numbers) {
    const bool strain = number.unit == Unit::number && number.change == NumberRow::Change::absolute;
    values.numbers.push_back(number.unit == Unit::force              ? 2000
                             : number.unit == Unit::force_per_length ? 80e3
                             : number.unit == Unit::force_per_area   ? 2.2e7
                             : strain                                ? 0.06
                                                                     : 8);
  }
  if (kind.points) values.points = {{-0.02, 0}, {0, 0}, {0.02, 10}, {0.05, 80}, {0.1, 240}};
  return values;
}

double difference(const std::function<double(double)>& f, double x, double h) {
  return (f(x + h) - f(x - h)) / (2 * h);
}

/// Strains to look at: on both sides of every break, none within reach of a difference.
constexpr double kStrains[] = {-0.03, 0.0123, 0.031, 0.047, 0.071, 0.13, 0.25};

void expect_close(double value, double truth, double scale, const std::string& what) {
  EXPECT_LT(std::abs(value - truth), 5e-7 * (std::abs(truth) + scale)) << what << ": " << value << " and " << truth;
}

bool slack(const ForceLaw& law, double length) { return length <= law.slack_until(); }

TEST(Laws, AreFoundByTheirNames) {
  std::set<std::string> names;
  for (const auto& law : kLaws) {
    const LawKind& kind = law();
    EXPECT_EQ(find_law(kind.name), &kind);
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_EQ(kind.points, static_cast<bool>(kind.fault_of_points)) << kind.name;
    std::set<std::string> keys;
    for (const NumberRow& number : kind.numbers) EXPECT_TRUE(keys.insert(number.key).second) << number.key;
  }
  EXPECT_EQ(find_law("rubber"), nullptr);
}

TEST(Laws, HaveTheStiffnessAndForceOfDifferences) {
  for (const auto& of : kLaws) {
    const auto law = of().make(some_values(of()), kSlack);
    for (const double e : kStrains) {
      const double length = kSlack * (1 + e), h = 1e-5 * kSlack;
      if (slack(*law, length)) continue;
      const LawValue value = law->evaluate(length);
      const auto force = [&](double at) { return law->evaluate(at).force; };
      const auto energy = [&](double at) { return law->evaluate(at).energy; };
      expect_close(value.stiffness, difference(force, length, h), 1, of().name + " stiffness");
      expect_close(value.force, difference(energy, length, h), 1e-3, of().name + " force");
    }
  }
}

TEST(Laws, HaveTheRatesOfDifferences) {
  int compared = 0;
  for (const auto& of : kLaws) {
    const LawKind& kind = of();
    const LawValues values = some_values(kind);
    const auto law = kind.make(values, kSlack);
    for (const double e : kStrains) {
      const double length = kSlack * (1 + e);
      if (slack(*law, length)) continue;
      const LawRates rates = law->rates(length);
      ASSERT_EQ(rates.force_by_number.size(), kind.numbers.size()) << kind.name;
      for (std::size_t k = 0; k < kind.numbers.size(); ++k) {
        const auto force = [&](double number) {
          LawValues changed = values;
          changed.numbers[k] = number;
          return kind.make(changed, kSlack)->evaluate(length).force;
        };
        const double h = 1e-5 * values.numbers[k];
        expect_close(rates.force_by_number[k] * h, difference(force, values.numbers[k], h) * h, 1e-3,
                     kind.name + " " + kind.numbers[k].key);
        ++compared;
      }
      const auto by_slack = [&](double at) { return kind.make(values, at)->evaluate(length).force; };
      expect_close(rates.force_by_slack_length, difference(by_slack, kSlack, 1e-5 * kSlack), 1, kind.name + " L0");
      expect_close(-law->evaluate(length).stiffness, rates.force_by_slack_length * rates.slack_length_by_length, 1,
                   kind.name + " at constant force");
    }
  }
  EXPECT_GT(compared, 40);
}

TEST(Laws, HaveTheForceAtTheRestLengthForIt) {
  for (const auto& of : kLaws) {
    const LawKind& kind = of();
    const LawValues values = some_values(kind);
    for (const double force : {1e-3, 1.0, 30.0, 200.0}) {
      const auto rest = kind.slack_length_for(values, force, 0.041);
      ASSERT_TRUE(rest) << kind.name;
      EXPECT_NEAR(kind.make(values, *rest)->evaluate(0.041).force, force, 1e-9 * (1 + force)) << kind.name;
    }
    EXPECT_EQ(kind.slack_length_for(values, -1, 0.041).has_value(), kind.both_ways) << kind.name;
  }
}

TEST(Laws, AreSlackUpToTheirFirstBreakUnlessTheyPush) {
  for (const auto& of : kLaws) {
    const auto law = of().make(some_values(of()), kSlack);
    EXPECT_EQ(law->slack_until() < 0, of().both_ways) << of().name;
    EXPECT_EQ(law->slack_length(), kSlack) << of().name;
    const auto breaks = law->breaks();
    EXPECT_EQ(breaks.empty(), of().both_ways) << of().name;
    if (breaks.empty()) continue;
    EXPECT_EQ(law->slack_until(), breaks[0].length) << of().name;
    EXPECT_EQ(law->evaluate(breaks[0].length).force, 0) << of().name;
  }
}

}  // namespace
}  // namespace genu
