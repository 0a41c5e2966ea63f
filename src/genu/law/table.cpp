// table: F through points (e, F), e = (L - L0) / L0, see MonotoneTable: straight beyond the points with the end slopes.
// A table without negative forces never pushes.
#include <algorithm>

#include "genu/law/laws.h"
#include "genu/law/monotone_table.h"

namespace genu {
namespace {

MonotoneTable curve_of(const LawValues& values) {
  std::string why;
  return *MonotoneTable::make(values.points, why);
}

class Table final : public ForceLaw {
 public:
  Table(const LawValues& values, double slack_length) : curve_(curve_of(values)), L0_(slack_length) {
    const std::optional<double> until = curve_.zero_until();
    slack_until_ = until ? (1 + *until) * L0_ : kNeverSlack;
    origin_ = curve_.evaluate(until.value_or(0)).integral;
  }

  LawValue evaluate(double length) const override {
    const MonotoneTable::Value v = curve_.evaluate((length - L0_) / L0_);
    return {v.y, v.slope / L0_, L0_ * (v.integral - origin_)};
  }
  std::vector<LawBreak> breaks() const override {
    const auto until = curve_.zero_until(), from = curve_.zero_from();
    if (until && from && *from <= *until) return {};  // never taut
    // Where the table is not 0: its slope at the point itself, or that of the straight line that leads there.
    const auto side = [&](double e) -> LawBreak::Side {
      return {0, curve_.evaluate(std::clamp(e, curve_.first_x(), curve_.last_x())).slope / L0_, false};
    };
    const LawBreak::Side slack{0, 0, true};
    std::vector<LawBreak> out;
    if (until && *until > -1) out.push_back({(1 + *until) * L0_, slack, side(*until)});
    if (from && *from > -1) out.push_back({(1 + *from) * L0_, side(*from), slack});
    return out;
  }
  std::optional<double> slack_length() const override { return L0_; }
  double slack_until() const override { return slack_until_; }
  LawRates rates(double length) const override { return rates_of_strain_law(evaluate(length), length, L0_, {}); }

 private:
  MonotoneTable curve_;
  double L0_, slack_until_;
  double origin_;  // the curve's integral where the energy is 0
};

}  // namespace

const LawKind& table_law() {
  static const LawKind kind{.name = "table",
                            .what = "a table ligament",
                            .numbers = {},
                            .points = true,
                            .make = [](const LawValues& values,
                                       double slack_length) { return std::make_shared<Table>(values, slack_length); },
                            .slack_length_for =
                                [](const LawValues& values, double force, double length) {
                                  return slack_length_at(curve_of(values).first_rise_through(force), length);
                                },
                            .fault_of_points =
                                [](const LawValues& values) {
                                  std::string why;
                                  static_cast<void>(MonotoneTable::make(values.points, why));
                                  return why;
                                }};
  return kind;
}

}  // namespace genu
