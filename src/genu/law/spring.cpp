// spring: F = k (L - L0), in tension and compression; L0 = 0 is allowed.
#include <cmath>
#include <limits>

#include "genu/law/laws.h"

namespace genu {
namespace {

class Spring final : public ForceLaw {
 public:
  Spring(const LawValues& values, double slack_length) : k_(values.numbers[0]), L0_(slack_length) {}

  LawValue evaluate(double length) const override {
    const double stretch = length - L0_;
    return {k_ * stretch, k_, k_ * stretch * stretch / 2};
  }
  std::optional<double> slack_length() const override { return L0_; }
  LawRates rates(double length) const override {
    const LawValue value = evaluate(length);
    return {{value.force / k_}, -value.stiffness, 1};
  }

 private:
  double k_, L0_;
};

}  // namespace

const LawKind& spring_law() {
  static const LawKind kind{
      .name = "spring",
      .what = "a spring",
      .numbers = {{"stiffness", Unit::force_per_length}},
      .both_ways = true,
      .make = [](const LawValues& values,
                 double slack_length) { return std::make_shared<Spring>(values, slack_length); },
      .slack_length_for = [](const LawValues& values, double force, double length) -> std::optional<double> {
        const double slack = length - force / values.numbers[0];
        const double rounding = 4 * std::numeric_limits<double>::epsilon() * length;
        return std::abs(slack) <= rounding ? 0 : slack;  // meant as 0: round-off has no direction to push in
      }};
  return kind;
}

}  // namespace genu
