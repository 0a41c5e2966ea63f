// quadratic: F = K e^2 for e = (L - L0) / L0 > 0.
#include <cmath>

#include "genu/law/laws.h"

namespace genu {
namespace {

class Quadratic final : public ForceLaw {
 public:
  Quadratic(const LawValues& values, double slack_length) : K_(values.numbers[0]), L0_(slack_length) {}

  LawValue evaluate(double length) const override {
    // Exact up to twice the slack length (Sterbenz): the strain loses nothing near 0.
    const double stretch = length - L0_, e = stretch / L0_;
    return {K_ * e * e, 2 * K_ * e / L0_, K_ * e * e * stretch / 3};
  }
  std::vector<LawBreak> breaks() const override { return {{L0_, {0, 0, true}, {0, 0}}}; }
  std::optional<double> slack_length() const override { return L0_; }
  LawRates rates(double length) const override {
    const LawValue value = evaluate(length);
    return rates_of_strain_law(value, length, L0_, {value.force / K_});
  }

 private:
  double K_, L0_;
};

}  // namespace

const LawKind& quadratic_law() {
  static const LawKind kind{
      .name = "quadratic",
      .what = "a quadratic ligament",
      .numbers = {{"stiffness", Unit::force}},
      .make = [](const LawValues& values,
                 double slack_length) { return std::make_shared<Quadratic>(values, slack_length); },
      .slack_length_for = [](const LawValues& values, double force, double length) -> std::optional<double> {
        if (force < 0) return std::nullopt;
        return slack_length_at(std::sqrt(force / values.numbers[0]), length);
      }};
  return kind;
}

}  // namespace genu
