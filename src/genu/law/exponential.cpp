// exponential: F = A (exp(B e) - 1) for e = (L - L0) / L0 > 0.
#include <cmath>

#include "genu/law/laws.h"

namespace genu {
namespace {

class Exponential final : public ForceLaw {
 public:
  Exponential(const LawValues& values, double slack_length)
      : A_(values.numbers[0]), B_(values.numbers[1]), L0_(slack_length) {}

  LawValue evaluate(double length) const override {
    const double e = (length - L0_) / L0_, grown = std::expm1(B_ * e);
    return {A_ * grown, A_ * B_ / L0_ * (grown + 1), L0_ * A_ * (grown / B_ - e)};
  }
  std::vector<LawBreak> breaks() const override { return {{L0_, {0, 0, true}, {0, A_ * B_ / L0_}}}; }
  std::optional<double> slack_length() const override { return L0_; }
  LawRates rates(double length) const override {
    const LawValue value = evaluate(length);
    const double e = (length - L0_) / L0_;
    return rates_of_strain_law(value, length, L0_, {value.force / A_, e * (value.force + A_)});
  }

 private:
  double A_, B_, L0_;
};

}  // namespace

const LawKind& exponential_law() {
  static const LawKind kind{
      .name = "exponential",
      .what = "an exponential ligament",
      .numbers = {{"force_scale", Unit::force}, {"exponent", Unit::number}},
      .make = [](const LawValues& values,
                 double slack_length) { return std::make_shared<Exponential>(values, slack_length); },
      .slack_length_for = [](const LawValues& values, double force, double length) -> std::optional<double> {
        if (force < 0) return std::nullopt;
        return slack_length_at(std::log1p(force / values.numbers[0]) / values.numbers[1], length);
      }};
  return kind;
}

}  // namespace genu
