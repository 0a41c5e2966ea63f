#include "genu/calibrate/calibration_search.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "genu/calibrate/tolerances.h"

namespace genu {

CalibrationProblem::CalibrationProblem(const std::vector<CalibrationUnknown>& unknowns,
                                       const std::vector<std::unique_ptr<CalibrationExperiment>>& experiments,
                                       double difference)
    : unknowns_(unknowns), experiments_(experiments), difference_(difference) {}

Eigen::Index CalibrationProblem::target_rows() const {
  std::size_t count = 0;
  for (const auto& e : experiments_)
    if (!e->held_out) count += e->values().size();
  return static_cast<Eigen::Index>(count);
}

CalibrationProblem::At CalibrationProblem::at(const VecX& u, bool derivatives) const {
  At out;
  out.u = u;
  out.predictions.resize(experiments_.size());
  tbb::parallel_for(std::size_t{0}, experiments_.size(), [&](std::size_t e) {
    if (experiments_[e]->held_out) return;
    out.predictions[e] = experiments_[e]->predict(u, derivatives);
    ++runs_;
  });
  Eigen::Index priors = 0;
  for (const CalibrationUnknown& unknown : unknowns_) priors += unknown.prior ? 1 : 0;
  const Eigen::Index rows = target_rows() + priors;
  VecX residuals(rows);
  MatX J = MatX::Zero(rows, u.size());
  bool exact = derivatives;
  Eigen::Index first = 0;
  for (std::size_t e = 0; e < experiments_.size(); ++e) {
    if (experiments_[e]->held_out) continue;
    const CalibrationPrediction& p = out.predictions[e];
    if (p.values.size() == 0) {
      out.failed = p.failed;
      return out;
    }
    const VecX scales = experiments_[e]->scales();
    residuals.segment(first, scales.size()) = (p.values - experiments_[e]->wanted()).cwiseQuotient(scales);
    exact = exact && p.derivatives.size() > 0;
    if (exact) J.middleRows(first, scales.size()) = scales.cwiseInverse().asDiagonal() * p.derivatives;
    first += scales.size();
  }
  for (std::size_t k = 0; k < unknowns_.size(); ++k) {
    const CalibrationUnknown& unknown = unknowns_[k];
    if (!unknown.prior) continue;
    const auto column = static_cast<Eigen::Index>(k);
    residuals[first] = (unknown.shown(u[column]) - unknown.prior->mean) / unknown.prior->deviation;
    J(first++, column) = unknown.shown_slope(u[column]) / unknown.prior->deviation;
  }
  out.residuals = residuals;
  if (exact) out.derivatives = J;
  return out;
}

std::optional<MatX> CalibrationProblem::jacobian(const At& here) const {
  if (here.derivatives.size() > 0) return here.derivatives;
  const auto n = static_cast<std::size_t>(here.u.size());
  std::vector<VecX> beside(2 * n);
  tbb::parallel_for(std::size_t{0}, 2 * n, [&](std::size_t k) {
    VecX u = here.u;
    u[static_cast<Eigen::Index>(k / 2)] += k % 2 == 0 ? difference_ : -difference_;
    beside[k] = at(u, false).residuals;
  });
  MatX J(here.residuals.size(), here.u.size());
  for (std::size_t k = 0; k < n; ++k) {
    if (beside[2 * k].size() == 0 || beside[2 * k + 1].size() == 0) return std::nullopt;
    J.col(static_cast<Eigen::Index>(k)) = (beside[2 * k] - beside[2 * k + 1]) / (2 * difference_);
  }
  return J;
}

double derivative_noise(bool exact) { return exact ? kExactDerivativeNoise : kDerivativeNoise; }

std::optional<double> taut_start(const CalibrationUnknown& unknown, double u,
                                 const std::vector<CalibrationPrediction::Stretch>& stretch, double strain) {
  std::size_t nearest = 0;
  for (std::size_t m = 1; m < stretch.size(); ++m)
    if (stretch[m].longest > stretch[nearest].longest) nearest = m;
  if (!(stretch[nearest].longest > 0)) return std::nullopt;
  const auto& member = unknown.members[nearest];
  const double now = unknown.value(member, u), ratio = stretch[nearest].longest / (1 + strain);  // of slack lengths
  double value = 0;
  switch (member.parameter.kind) {
    case Parameter::Kind::slack_length:
      value = now * ratio;
      break;
    case Parameter::Kind::reference_strain:
      value = (1 + now) / ratio - 1;
      break;
    default:
      return std::nullopt;
  }
  const double taut = unknown.u_of(member, value);
  if (!std::isfinite(taut) || taut < unknown.lower || taut > unknown.upper) return std::nullopt;
  return taut;
}

namespace {

/// Point `index` of a sequence that fills the cube [-1, 1]^n evenly (M. Roberts 2018: multiples of powers of the root
/// of x^(n+1) = x + 1).
VecX spread_point(int index, Eigen::Index n) {
  double root = 2;
  for (int k = 0; k < 60; ++k) root = std::pow(1 + root, 1 / static_cast<double>(n + 1));
  VecX out(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double x = 0.5 + index * std::pow(root, -static_cast<double>(k + 1));
    out[k] = 2 * (x - std::floor(x)) - 1;
  }
  return out;
}

class StartSearcher {
 public:
  StartSearcher(const CalibrationProblem& problem, const CalibrationSearchOptions& options,
                const CalibrationProblem::At& start)
      : problem_(problem), options_(options), first_(start) {
    const auto n = static_cast<Eigen::Index>(problem.unknowns().size());
    how_.lower.resize(n);
    how_.upper.resize(n);
    how_.most_steps.resize(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const CalibrationUnknown& u = problem.unknowns()[static_cast<std::size_t>(k)];
      how_.lower[k] = u.lower;
      how_.upper[k] = u.upper;
      how_.most_steps[k] = u.most_step();
      bounded_ = bounded_ || std::isfinite(u.lower) || std::isfinite(u.upper);
    }
    how_.most_iterations = options.most_iterations;
  }

  struct Found {
    LeastSquaresResult fit;
    CalibrationProblem::At at_start, at_end;
    std::vector<CalibrationStart> starts;
    std::vector<std::size_t> slack;
  };

  /// From one start, and again with what is slack in every pose made taut, as long as that is better.
  Found from(int number) const {
    Found best = fit(std::to_string(number + 1), start(number));
    for (int round = 0; round < kTautRounds && !best.slack.empty(); ++round) {
      VecX u = best.fit.x;
      std::string names;
      for (const std::size_t k : best.slack) {
        const auto stretch = longest(best.at_end, k);
        const auto column = static_cast<Eigen::Index>(k);
        const auto taut = taut_start(problem_.unknowns()[k], u[column], stretch, kTautStrain);
        if (!taut) continue;
        u[column] = *taut;
        names += (names.empty() ? "" : ", ") + problem_.unknowns()[k].name;
      }
      if (names.empty()) break;
      Found taut = fit(fmt::format("{}, {} made taut", number + 1, names), u);
      std::vector<CalibrationStart> starts = best.starts;
      starts.insert(starts.end(), taut.starts.begin(), taut.starts.end());
      const bool better = cost(taut) < (1 - kWorthATautStart) * cost(best) && leaves_something(best.fit.residuals);
      if (better) {
        taut.at_start = best.at_start;
        best = std::move(taut);
      }
      best.starts = std::move(starts);
      if (!better) break;
    }
    return best;
  }

  /// Whether residuals are more than round-off, which another start may have less of.
  static bool leaves_something(const VecX& residuals) {
    return residuals.size() == 0 || residuals.squaredNorm() > kNoResidual * kNoResidual * residuals.size();
  }

  static double cost(const Found& f) {
    return f.fit.residuals.size() > 0 ? f.fit.residuals.squaredNorm() : std::numeric_limits<double>::infinity();
  }

 private:
  VecX start(int number) const {
    const auto n = static_cast<Eigen::Index>(problem_.unknowns().size());
    VecX u = VecX::Zero(n);
    if (number == 0) return u;
    u = spread_point(number, n);
    for (Eigen::Index k = 0; k < n; ++k)
      u[k] = std::clamp(u[k] * options_.spread * problem_.unknowns()[static_cast<std::size_t>(k)].standard_change(),
                        how_.lower[k], how_.upper[k]);
    return u;
  }

  Found fit(const std::string& name, const VecX& u) const {
    Found out;
    CalibrationProblem::At last;
    bool exact = true;
    const auto residuals = [&](const VecX& x) -> std::optional<VecX> {
      if (last.residuals.size() > 0 && last.u == x) return last.residuals;
      CalibrationProblem::At here = problem_.at(x, exact);
      exact = here.derivatives.size() > 0 || here.residuals.size() == 0;
      if (here.residuals.size() == 0) return std::nullopt;
      last = std::move(here);
      return last.residuals;
    };
    // The last residuals asked for may be those of a step that was not taken.
    const auto jacobian = [&](const VecX& x) -> std::optional<MatX> {
      if (last.u != x) last = problem_.at(x, exact);
      return problem_.jacobian(last);
    };
    LeastSquaresOptions how = how_;
    if (!bounded_) how.lower = how.upper = VecX();
    how.noise = derivative_noise(true);
    LeastSquaresProblem problem{residuals, jacobian, options_.cancelled};
    // Central differences are worse: where they are needed is known after the first residuals.
    last = u == first_.u ? first_ : problem_.at(u, true);
    if (last.residuals.size() > 0 && last.derivatives.size() == 0) how.noise = derivative_noise(false), exact = false;
    out.at_start = last;
    out.fit = least_squares(problem, u, how);
    if (out.fit.residuals.size() > 0) out.at_end = last.u == out.fit.x ? last : problem_.at(out.fit.x, exact);
    CalibrationStart row{name, u, out.fit.x, out.fit.stop, out.fit.iterations, 0};
    row.rms = out.fit.residuals.size() > 0
                  ? std::sqrt(out.fit.residuals.squaredNorm() / static_cast<double>(out.fit.residuals.size()))
                  : std::nan("");
    out.starts.push_back(row);
    if (out.fit.residuals.size() > 0) out.slack = slack_in(out.at_end);
    return out;
  }

  /// Of an unknown's members, over all experiments.
  static std::vector<CalibrationPrediction::Stretch> longest(const CalibrationProblem::At& at, std::size_t k) {
    std::vector<CalibrationPrediction::Stretch> out;
    for (const CalibrationPrediction& p : at.predictions) {
      if (p.stretch.empty()) continue;
      out.resize(p.stretch[k].size());
      for (std::size_t m = 0; m < out.size(); ++m) {
        out[m].longest = std::max(out[m].longest, p.stretch[k][m].longest);
        out[m].slack = out[m].slack && p.stretch[k][m].slack;
      }
    }
    return out;
  }

  /// Unknowns of slack lengths that pull nowhere.
  std::vector<std::size_t> slack_in(const CalibrationProblem::At& at) const {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < problem_.unknowns().size(); ++k) {
      const auto members = longest(at, k);
      if (!members.empty() &&
          std::all_of(members.begin(), members.end(), [](const auto& m) { return m.slack && m.longest > 0; }))
        out.push_back(k);
    }
    return out;
  }

  const CalibrationProblem& problem_;
  const CalibrationSearchOptions& options_;
  const CalibrationProblem::At& first_;
  LeastSquaresOptions how_;
  bool bounded_ = false;
};

}  // namespace

CalibrationSearch search(const CalibrationProblem& problem, const CalibrationSearchOptions& options,
                         const CalibrationProblem::At& start) {
  const StartSearcher searcher(problem, options, start);
  std::vector<StartSearcher::Found> found(static_cast<std::size_t>(std::max(1, options.starts)));
  tbb::parallel_for(std::size_t{0}, found.size(),
                    [&](std::size_t k) { found[k] = searcher.from(static_cast<int>(k)); });
  const auto best = std::min_element(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return StartSearcher::cost(a) < StartSearcher::cost(b);
  });
  CalibrationSearch out;
  for (const auto& f : found) out.starts.insert(out.starts.end(), f.starts.begin(), f.starts.end());
  out.at_start = found.front().at_start;
  out.fit = best->fit;
  out.at_end = best->at_end;
  out.slack = best->slack;
  out.exact = out.at_end.derivatives.size() > 0;
  out.jacobian = out.exact ? out.at_end.derivatives : out.fit.jacobian;
  return out;
}

}  // namespace genu
