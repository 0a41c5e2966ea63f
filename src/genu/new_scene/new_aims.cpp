#include "genu/new_scene/new_aims.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "genu/assemble/with_numbers.h"
#include "genu/core/least_squares.h"
#include "genu/core/units.h"
#include "genu/new_scene/tolerances.h"

namespace genu {
namespace {

Eigen::Index count() { return static_cast<Eigen::Index>(new_knee_aims().size()); }

/// The numbers of a scene that an aim changes.
struct Member {
  Parameter parameter;
  std::string fibre;
  double start = 0;  ///< SI, without aims
};

class AimedNumbers {
 public:
  explicit AimedNumbers(const Prepared& prepared) : prepared_(prepared), members_(new_knee_aims().size()) {
    const Scene& scene = prepared.source;
    for (const Parameter& p : parameters_of(scene)) {
      const bool slack = p.kind == Parameter::Kind::slack_length;
      if (!slack && (p.kind != Parameter::Kind::law_number || !p.name.ends_with(".stiffness"))) continue;
      const LigamentDef& ligament = scene.ligaments[static_cast<std::size_t>(p.object)];
      for (std::size_t k = 0; k < members_.size(); ++k) {
        const NewKneeAim& aim = new_knee_aims()[k];
        const auto begins = [&](const std::string& name) { return ligament.name.starts_with(name); };
        if (aim.stiffness == slack || std::none_of(aim.fibres.begin(), aim.fibres.end(), begins)) continue;
        members_[k].push_back({p, ligament.name, slack ? ligament.rest_value : ligament.number("stiffness")});
      }
    }
  }

  NewKneeLaxity tested(const Aims& aims, const Cancelled& cancelled) const {
    std::vector<NewNumber> numbers;
    std::vector<NumberRates> rates(members_.size());
    for (std::size_t k = 0; k < members_.size(); ++k)
      for (const Member& m : members_[k]) {
        numbers.emplace_back(m.parameter, value(k, m, aims));
        rates[k].emplace_back(m.parameter, rate(k, m, aims));
      }
    Diagnostics ignored;
    const auto changed = with_numbers(prepared_, numbers, ignored);
    return changed ? laxity_of_new(*changed, rates, cancelled) : NewKneeLaxity{};
  }

  AimedKnee knee(const Aims& aims, NewKneeLaxity laxity, std::string before) const {
    AimedKnee out{aims, std::move(laxity), std::move(before), {}, {}};
    for (std::size_t k = 0; k < members_.size(); ++k)
      for (const Member& m : members_[k])
        (new_knee_aims()[k].stiffness ? out.stiffness : out.slack)[m.fibre] = value(k, m, aims);
    return out;
  }

 private:
  static double value(std::size_t k, const Member& m, const Aims& aims) {
    const double aim = aims[static_cast<Eigen::Index>(k)];
    return new_knee_aims()[k].stiffness ? m.start * std::exp(aim) : m.start / (1 + aim);
  }
  static double rate(std::size_t k, const Member& m, const Aims& aims) {
    const double aim = aims[static_cast<Eigen::Index>(k)];
    return new_knee_aims()[k].stiffness ? value(k, m, aims) : -value(k, m, aims) / (1 + aim);
  }

  const Prepared& prepared_;
  std::vector<std::vector<Member>> members_;  ///< of each aim
};

/// By how many margins a value misses what is aimed at; with its sign.
double miss(const NewKneeLaxity::Value& v, double value) {
  return (std::min(0.0, value - v.aimed_least()) + std::max(0.0, value - v.aimed_most())) / v.margin;
}

/// Sum of squares of what is missed.
double missed(const NewKneeLaxity& found) {
  double sum = found.values.empty() ? std::numeric_limits<double>::infinity() : 0;
  for (const auto& v : found.values) {
    const double by = std::isfinite(v.value) ? miss(v, v.value) : kMissingCurve;
    sum += by * by;
  }
  return sum + found.missing_curves() * kMissingCurve * kMissingCurve;
}

/// The linear model of `found`: residuals are misses, then aims by their usual change.
class NextAims {
 public:
  NextAims(const NewKneeLaxity& found, const Aims& aims) : found_(found), start_(aims.cwiseQuotient(usual())) {
    for (const auto& v : found.values)
      if (std::isfinite(v.value)) values_.push_back(&v);
    wanted_ = VecX::Zero(count());
    weights_ = VecX::Constant(count(), std::sqrt(kAimWeight));
    // Where curves end, what holds the knee is tightened.
    if (!found.all_complete())
      for (Eigen::Index k = 0; k < count(); ++k)
        if (holds(static_cast<std::size_t>(k))) wanted_[k] = start_[k] + kTightenStep, weights_[k] = 1;
  }

  static VecX usual() {
    VecX out(count());
    for (Eigen::Index k = 0; k < count(); ++k) out[k] = new_knee_aims()[static_cast<std::size_t>(k)].usual();
    return out;
  }

  VecX residuals(const VecX& z) const {
    VecX out(rows());
    const VecX moved = (z - start_).cwiseProduct(usual());
    for (std::size_t i = 0; i < values_.size(); ++i)
      out[static_cast<Eigen::Index>(i)] = miss(*values_[i], values_[i]->value + values_[i]->rates.dot(moved));
    out.tail(count()) = weights_.cwiseProduct(z - wanted_);
    return out;
  }

  MatX jacobian(const VecX& z) const {
    MatX out = MatX::Zero(rows(), count());
    const VecX r = residuals(z);
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (const auto row = static_cast<Eigen::Index>(i); r[row] != 0)
        out.row(row) = values_[i]->rates.cwiseProduct(usual()).transpose() / values_[i]->margin;
    out.bottomRows(count()) = weights_.asDiagonal();
    return out;
  }

 private:
  static bool holds(std::size_t k) {
    const NewKneeAim& aim = new_knee_aims()[k];
    return std::any_of(aim.fibres.begin(), aim.fibres.end(),
                       [](const std::string& f) { return f == "MCLs" || f == "LCL" || f == "PCL" || f == "meniscus"; });
  }
  Eigen::Index rows() const { return static_cast<Eigen::Index>(values_.size()) + count(); }

  const NewKneeLaxity& found_;
  VecX start_, wanted_, weights_;
  std::vector<const NewKneeLaxity::Value*> values_;
};

}  // namespace

double NewKneeAim::usual() const { return stiffness ? kUsualStiffness : kUsualStrain; }

const std::vector<NewKneeAim>& new_knee_aims() {
  const double soft = std::log(kSoftestLigaments), stiff = std::log(kStiffestLigaments);
  static const std::vector<NewKneeAim> aims = {
      {"strain of the ACL", {"ACL"}, false, -kMostSlackened, kMostTightened},
      {"strain of the PCL", {"PCL"}, false, -kMostSlackened, kMostTightened},
      {"strain of the MCL", {"MCLs", "MCLd"}, false, -kMostSlackened, kMostTightened},
      {"strain of the LCL", {"LCL"}, false, -kMostSlackened, kMostTightened},
      {"strain of the posteromedial capsule", {"MCLp"}, false, -kMostCornerSlackened, kMostTightened},
      {"strain of the popliteofibular ligament", {"PFL"}, false, -kMostCornerSlackened, kMostTightened},
      {"strain of the posterior capsule", {"pCAP"}, false, -kMostCornerSlackened, kMostTightened},
      {"stiffness of the PCL", {"PCL"}, true, soft, stiff},
      {"stiffness of the collaterals", {"MCLs", "MCLd", "LCL"}, true, soft, stiff},
      {"stiffness of the menisci", {"meniscus"}, true, std::log(kSoftestMenisci), std::log(kStiffestMenisci)}};
  return aims;
}

std::string text_of(const Aims& aims) {
  std::string out;
  for (Eigen::Index k = 0; k < aims.size(); ++k) {
    const NewKneeAim& aim = new_knee_aims()[static_cast<std::size_t>(k)];
    const std::string by =
        aim.stiffness ? fmt::format("times {:.2f}", std::exp(aims[k])) : fmt::format("{:+.1f} %", 100 * aims[k]);
    if (by != "times 1.00" && by != "+0.0 %" && by != "-0.0 %")
      out += fmt::format("{}{} {}", out.empty() ? "" : ", ", aim.words, by);
  }
  return out;
}

Aims next_aims(const NewKneeLaxity& found, const Aims& aims, double reach) {
  const NextAims model(found, aims);
  LeastSquaresProblem problem;
  problem.residuals = [&](const VecX& z) { return std::optional(model.residuals(z)); };
  problem.jacobian = [&](const VecX& z) { return std::optional(model.jacobian(z)); };
  const VecX usual = NextAims::usual(), start = aims.cwiseQuotient(usual);
  LeastSquaresOptions options;
  options.most_iterations = kAimIterations;
  options.lower = start.array() - reach;
  options.upper = start.array() + reach;
  for (Eigen::Index k = 0; k < count(); ++k) {
    const NewKneeAim& aim = new_knee_aims()[static_cast<std::size_t>(k)];
    options.lower[k] = std::max(options.lower[k], aim.least / usual[k]);
    options.upper[k] = std::min(options.upper[k], aim.most / usual[k]);
  }
  return least_squares(problem, start, options).x.cwiseProduct(usual);
}

AimedKnee aim_at_ranges(const Prepared& prepared, const Cancelled& cancelled) {
  Prepared shared = prepared;
  share_search(shared);
  const AimedNumbers numbers(shared);
  Aims best = VecX::Zero(count());
  NewKneeLaxity found = numbers.tested(best, cancelled);
  const std::string before = found.text();
  double reach = kAimReach;
  for (int round = 0;
       round < kAimRounds && reach > kLeastReach && !found.usual(kAimedEnough) && !asked_to_stop(cancelled); ++round) {
    const Aims aims = next_aims(found, best, reach);
    if ((aims - best).cwiseQuotient(NextAims::usual()).cwiseAbs().maxCoeff() < kLeastReach) break;
    NewKneeLaxity other = numbers.tested(aims, cancelled);
    if (missed(other) < missed(found))
      best = aims, found = std::move(other);
    else
      reach *= kShorterReach;
  }
  return numbers.knee(best, std::move(found), before);
}

}  // namespace genu
