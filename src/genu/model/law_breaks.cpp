// Where the pieces of each law meet, the laws continued beyond them, and laws of the caller's own.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/model/ligament_law.h"

namespace genu {
namespace {

using Law = LigamentDef::Law;

constexpr double kJumpTolerance = 1e-9;  // of the larger value: less is rounding of the law's parameters

bool differ(double a, double b) { return std::abs(a - b) > kJumpTolerance * std::max(std::abs(a), std::abs(b)); }

/// What is wrong with the breaks a law states; empty if nothing is.
std::string fault(const ForceLaw& law, const std::vector<LawBreak>& breaks) {
  double last = 0;
  for (const LawBreak& b : breaks) {
    if (!(b.length > last) || !std::isfinite(b.length)) return "breaks must be finite, > 0 and increase";
    last = b.length;
    // One rounding beside the break the law must be what the break says, to first order.
    const double after = std::nextafter(b.length, std::numeric_limits<double>::infinity());
    for (const bool above : {false, true}) {
      const LawBreak::Side& side = above ? b.above : b.below;
      const double force = law.evaluate(above ? after : b.length).force;
      const double slope = std::abs(side.stiffness) * b.length * std::numeric_limits<double>::epsilon();
      if (!(std::abs(force - side.force) <= kJumpTolerance * (1 + std::abs(side.force)) + 4 * slope))
        return fmt::format("the force {} the break at {} m is {} N, the break says {} N", above ? "above" : "at",
                           b.length, force, side.force);
      if (!std::isfinite(side.stiffness)) return "the stiffness beside a break must be finite";
    }
  }
  return {};
}

}  // namespace

bool LawBreak::jumps() const { return differ(below.force, above.force); }

bool LawBreak::sharp() const { return jumps() || differ(below.stiffness, above.stiffness); }

std::optional<LigamentLaw> LigamentLaw::custom(std::shared_ptr<const ForceLaw> law, std::string& why) {
  why = law ? std::string() : "there is no law";
  if (!why.empty()) return std::nullopt;
  LigamentLaw out;
  out.breaks_ = law->breaks();
  why = fault(*law, out.breaks_);
  const auto slack_length = law->slack_length();
  if (why.empty() && slack_length && !(*slack_length > 0 && std::isfinite(*slack_length)))
    why = "slack_length must be > 0";
  if (!why.empty()) return std::nullopt;
  out.slack_length_ = slack_length.value_or(std::numeric_limits<double>::quiet_NaN());
  out.slack_until_ = !out.breaks_.empty() && out.breaks_[0].below.slack ? out.breaks_[0].length : -1;
  out.custom_ = std::move(law);
  out.find_sharp_breaks();
  return out;
}

int LigamentLaw::piece_at(double length) const {
  int piece = 0;
  for (const LawBreak& b : sharp_breaks_) piece += b.length < length;
  return piece;
}

bool LigamentLaw::is_slack(int piece) const { return slack_pieces_[static_cast<std::size_t>(piece)]; }

void LigamentLaw::find_sharp_breaks() {
  sharp_breaks_.clear();
  slack_pieces_.assign(1, !breaks_.empty() && breaks_.front().below.slack);
  for (const LawBreak& b : breaks_) {
    if (b.sharp()) {
      sharp_breaks_.push_back(b);
      slack_pieces_.push_back(b.above.slack);
    } else {
      slack_pieces_.back() = slack_pieces_.back() && b.above.slack;
    }
  }
}

LawValue LigamentLaw::evaluate(double length, int piece) const {
  if (piece == kByLength) return evaluate(length);
  const auto k = static_cast<std::size_t>(piece);
  const auto straight = [&](const LawBreak& at, const LawBreak::Side& side) -> LawValue {
    const double d = length - at.length;
    return {side.force + side.stiffness * d, side.stiffness,
            evaluate(at.length).energy + d * (side.force + side.stiffness * d / 2)};
  };
  const auto& ends = sharp_breaks_;
  if (k > 0 && length <= ends[k - 1].length) return straight(ends[k - 1], ends[k - 1].above);
  if (k < ends.size() && length > ends[k].length) return straight(ends[k], ends[k].below);
  return evaluate(length);
}

void LigamentLaw::set_breaks() {
  breaks_.clear();
  const double L0 = slack_length_, k = stiffness_, e_t = transition_strain_;
  const auto add = [&](double length, LawBreak::Side below, LawBreak::Side above) {
    breaks_.push_back({length, below, above});
  };
  const LawBreak::Side slack{0, 0, true};
  const bool has_toe = e_t > 0 && (kind_ == Law::blankevoort || kind_ == Law::abdel_rahman);
  if (kind_ == Law::quadratic || has_toe) add(L0, slack, {0, 0});
  if (kind_ == Law::linear || (kind_ == Law::blankevoort && !has_toe)) add(L0, slack, {0, k / L0});
  if (kind_ == Law::abdel_rahman && !has_toe) add(L0, slack, {0, k});
  if (kind_ == Law::blankevoort && has_toe) add(transition_length_, {k * e_t / 2, k / L0}, {k * e_t / 2, k / L0});
  if (kind_ == Law::abdel_rahman && has_toe) {
    const double d_t = e_t * L0;
    add(transition_length_, {toe_stiffness_ * d_t * d_t, 2 * toe_stiffness_ * d_t}, {k * d_t / 2, k});
  }
  if (kind_ == Law::table) set_table_breaks();
  find_sharp_breaks();
}

void LigamentLaw::set_table_breaks() {
  const double L0 = slack_length_;
  const auto until = table_->zero_until(), from = table_->zero_from();
  if (until && from && *from <= *until) return;  // never taut
  // Where the table is not 0: its slope at the point itself, or that of the straight line that leads there.
  const auto side = [&](double e) -> LawBreak::Side {
    return {0, table_->evaluate(std::clamp(e, table_->first_x(), table_->last_x())).slope / L0, false};
  };
  const LawBreak::Side slack{0, 0, true};
  if (until && *until > -1) breaks_.push_back({(1 + *until) * L0, slack, side(*until)});
  if (from && *from > -1) breaks_.push_back({(1 + *from) * L0, side(*from), slack});
}

}  // namespace genu
