// abdel-rahman: F = K2 (L - L0)^2 for 0 < e <= e_t, then K1 (L - (1 + e_t / 2) L0); e = (L - L0) / L0. May jump at e_t,
// where the toe's value holds (Abdel-Rahman and Hefzy, Med. Eng. Phys. 20 (1998) 276-290).
#include <cmath>

#include "genu/law/laws.h"

namespace genu {
namespace {

class AbdelRahman final : public ForceLaw {
 public:
  AbdelRahman(const LawValues& values, double slack_length)
      : K1_(values.numbers[0]),
        K2_(values.numbers[1]),
        e_t_(values.numbers[2]),
        L0_(slack_length),
        transition_((1 + e_t_) * L0_) {}

  LawValue evaluate(double length) const override {
    const double d = length - L0_, d_t = e_t_ * L0_;
    // The same comparison that parts the pieces: rounding of d must not put a length on the other side of the jump.
    if (length <= transition_) return {K2_ * d * d, 2 * K2_ * d, K2_ * d * d * d / 3};
    return {K1_ * (d - d_t / 2), K1_, K2_ * d_t * d_t * d_t / 3 + K1_ * d * (d - d_t) / 2};
  }
  std::vector<LawBreak> breaks() const override {
    if (!(e_t_ > 0)) return {{L0_, {0, 0, true}, {0, K1_}}};
    const double d_t = e_t_ * L0_;
    return {{L0_, {0, 0, true}, {0, 0}}, {transition_, {K2_ * d_t * d_t, 2 * K2_ * d_t}, {K1_ * d_t / 2, K1_}}};
  }
  std::optional<double> slack_length() const override { return L0_; }
  LawRates rates(double length) const override {
    const LawValue value = evaluate(length);
    // At constant force the stretch is constant in the toe, L - (1 + e_t / 2) L0 beyond it.
    if (length - L0_ <= e_t_ * L0_) return {{0, value.force / K2_, 0}, -value.stiffness, 1};
    return {{value.force / K1_, 0, -K1_ * L0_ / 2}, -value.stiffness * (1 + e_t_ / 2), 1 / (1 + e_t_ / 2)};
  }

 private:
  double K1_, K2_, e_t_, L0_;
  double transition_;  // m: the toe's end
};

std::optional<double> slack_length_for(const LawValues& values, double force, double length) {
  if (force < 0) return std::nullopt;
  const double K1 = values.numbers[0], K2 = values.numbers[1], e_t = values.numbers[2];
  const double toe = length - std::sqrt(force / K2);
  if (length - toe <= e_t * toe) return toe;
  return (length - force / K1) / (1 + e_t / 2);
}

}  // namespace

const LawKind& abdel_rahman_law() {
  static const LawKind kind{
      .name = "abdel-rahman",
      .what = "an abdel-rahman ligament",
      .numbers = {{"stiffness", Unit::force_per_length},
                  {"toe_stiffness", Unit::force_per_area},
                  {"transition_strain", Unit::number, NumberRow::Range::above_zero_or_limit,
                   NumberRow::Change::absolute}},
      .make = [](const LawValues& values,
                 double slack_length) { return std::make_shared<AbdelRahman>(values, slack_length); },
      .slack_length_for = slack_length_for};
  return kind;
}

}  // namespace genu
