// Pieces between the breaks of a law, their continuation beyond the breaks, and custom laws.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/model/ligament_law.h"
#include "genu/model/tolerances.h"

namespace genu {
namespace {

/// What is wrong with the breaks a law states; empty if nothing is.
std::string fault(const ForceLaw& law, const std::vector<LawBreak>& breaks) {
  double last = 0;
  for (const LawBreak& b : breaks) {
    if (!(b.length > last) || !std::isfinite(b.length)) return "breaks must be finite, > 0 and increase";
    last = b.length;
    // One rounding error beside the break, the law must agree with the stated break to first order.
    const double after = std::nextafter(b.length, std::numeric_limits<double>::infinity());
    for (const bool above : {false, true}) {
      const LawBreak::Side& side = above ? b.above : b.below;
      const double force = law.evaluate(above ? after : b.length).force;
      const double slope = std::abs(side.stiffness) * b.length * std::numeric_limits<double>::epsilon();
      if (!(std::abs(force - side.force) <= kStatedForceTolerance * (1 + std::abs(side.force)) + 4 * slope))
        return fmt::format("the force {} the break at {} m is {} N, the break says {} N", above ? "above" : "at",
                           b.length, force, side.force);
      if (!std::isfinite(side.stiffness)) return "the stiffness beside a break must be finite";
    }
  }
  return {};
}

}  // namespace

std::optional<LigamentLaw> LigamentLaw::custom(std::shared_ptr<const ForceLaw> law, std::string& why) {
  why = law ? fault(*law, law->breaks()) : std::string("there is no law");
  if (!why.empty()) return std::nullopt;
  const auto slack_length = law->slack_length();
  if (slack_length && !(*slack_length > 0 && std::isfinite(*slack_length))) why = "slack_length must be > 0";
  if (!why.empty()) return std::nullopt;
  return LigamentLaw(std::move(law));
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

}  // namespace genu
