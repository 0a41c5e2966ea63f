// linear: F = K e for e = (L - L0) / L0 > 0.
#include "genu/law/laws.h"

namespace genu {
namespace {

class Linear final : public ForceLaw {
 public:
  Linear(const LawValues& values, double slack_length) : K_(values.numbers[0]), L0_(slack_length) {}

  LawValue evaluate(double length) const override {
    const double stretch = length - L0_;
    return {K_ * stretch / L0_, K_ / L0_, K_ * stretch / L0_ * stretch / 2};
  }
  std::vector<LawBreak> breaks() const override { return {{L0_, {0, 0, true}, {0, K_ / L0_}}}; }
  std::optional<double> slack_length() const override { return L0_; }
  LawRates rates(double length) const override {
    const LawValue value = evaluate(length);
    return rates_of_strain_law(value, length, L0_, {value.force / K_});
  }

 private:
  double K_, L0_;
};

}  // namespace

const LawKind& linear_law() {
  static const LawKind kind{
      .name = "linear",
      .what = "a linear ligament",
      .numbers = {{"stiffness", Unit::force}},
      .make = [](const LawValues& values,
                 double slack_length) { return std::make_shared<Linear>(values, slack_length); },
      .slack_length_for = [](const LawValues& values, double force, double length) -> std::optional<double> {
        if (force < 0) return std::nullopt;
        return slack_length_at(force / values.numbers[0], length);
      }};
  return kind;
}

}  // namespace genu
