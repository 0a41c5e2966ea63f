// blankevoort: F = K e^2 / (2 e_t) for 0 < e <= e_t, then K (e - e_t / 2); e = (L - L0) / L0
// (Blankevoort et al., J. Biomech. 24 (1991) 1019-1031).
#include <cmath>

#include "genu/law/laws.h"

namespace genu {
namespace {

class Blankevoort final : public ForceLaw {
 public:
  Blankevoort(const LawValues& values, double slack_length)
      : K_(values.numbers[0]), e_t_(values.numbers[1]), L0_(slack_length) {}

  LawValue evaluate(double length) const override {
    const double e = (length - L0_) / L0_;
    if (e <= e_t_) return {K_ * e * e / (2 * e_t_), K_ * e / (e_t_ * L0_), L0_ * K_ * e * e * e / (6 * e_t_)};
    return {K_ * (e - e_t_ / 2), K_ / L0_, L0_ * K_ * (e_t_ * e_t_ / 6 + e * (e - e_t_) / 2)};
  }
  std::vector<LawBreak> breaks() const override {
    if (!(e_t_ > 0)) return {{L0_, {0, 0, true}, {0, K_ / L0_}}};
    const LawBreak::Side end{K_ * e_t_ / 2, K_ / L0_};
    return {{L0_, {0, 0, true}, {0, 0}}, {(1 + e_t_) * L0_, end, end}};
  }
  std::optional<double> slack_length() const override { return L0_; }
  LawRates rates(double length) const override {
    const LawValue value = evaluate(length);
    const bool toe = length - L0_ <= e_t_ * L0_;
    return rates_of_strain_law(value, length, L0_, {value.force / K_, toe ? -value.force / e_t_ : -K_ / 2});
  }

 private:
  double K_, e_t_, L0_;
};

}  // namespace

const LawKind& blankevoort_law() {
  static const LawKind kind{
      .name = "blankevoort",
      .what = "a blankevoort ligament",
      .numbers = {{"stiffness", Unit::force},
                  {"transition_strain", Unit::number, NumberRow::Range::above_zero_or_limit,
                   NumberRow::Change::absolute}},
      .make = [](const LawValues& values,
                 double slack_length) { return std::make_shared<Blankevoort>(values, slack_length); },
      .slack_length_for = [](const LawValues& values, double force, double length) -> std::optional<double> {
        if (force < 0) return std::nullopt;
        const double ratio = force / values.numbers[0], e_t = values.numbers[1];
        return slack_length_at(ratio <= e_t / 2 ? std::sqrt(2 * e_t * ratio) : ratio + e_t / 2, length);
      }};
  return kind;
}

}  // namespace genu
