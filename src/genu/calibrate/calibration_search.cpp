#include "genu/calibrate/calibration_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "genu/calibrate/tolerances.h"

namespace genu {

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
  StartSearcher(const CalibrationProblem& problem, const CalibrationSearchOptions& options, const SolvableStart& start)
      : problem_(problem), options_(options), first_(start) {
    const auto n = static_cast<Eigen::Index>(problem.unknowns().size());
    how_.lower.resize(n);
    how_.upper.resize(n);
    how_.most_steps.resize(n);
    slack_lengths_ = VecX::Zero(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const CalibrationUnknown& u = problem.unknowns()[static_cast<std::size_t>(k)];
      how_.lower[k] = u.lower;
      how_.upper[k] = u.upper;
      how_.most_steps[k] = u.most_step();
      bounded_ = bounded_ || std::isfinite(u.lower) || std::isfinite(u.upper);
      const auto& kind = u.members.front().parameter.kind;
      if (kind == Parameter::Kind::slack_length || kind == Parameter::Kind::reference_strain)
        slack_lengths_[k] = 1 / (kHeldChange * u.standard_change());
    }
    how_.most_iterations = options.most_iterations;
    how_.most_creeping = kMostCreeping;
  }

  struct Found {
    LeastSquaresResult fit;
    CalibrationProblem::At at_start, at_end;
    std::vector<CalibrationStart> starts;
    std::vector<std::size_t> slack;

    bool done() const { return converged(fit.stop) && slack.empty(); }
  };

  /// From one start, held near it at first; where that does not end well, again not held, then with every length so
  /// short that it is stretched there.
  Found from(int number) const {
    const SolvableStart start = number == 0 ? first_ : solvable_start(problem_, start_of(number));
    const std::string name = std::to_string(number + 1);
    Found best = made_taut(name, keeping_taut(start.how.empty() ? name : name + ", " + start.how, start.at, true));
    for (const double strain : kTautAgain) {
      if (best.done() || !leaves_something(best.fit.residuals) || asked_to_stop(options_.cancelled)) break;
      if (problem_.has_stated_errors() && best.fit.residuals.size() > 0 &&
          !problem_.misfit(best.fit.residuals, start.at.u.size()))
        break;  // as good as the errors allow
      if (slack_lengths_.isZero() || start.at.derivatives.size() == 0) break;
      const VecX u = stretched(start.at, strain);
      if (strain > 0 && u == start.at.u) continue;
      const std::string words = strain > 0 ? fmt::format("{}, all stretched by {:g} %", name, 100 * strain)
                                           : fmt::format("{}, not held", name);
      Found again = made_taut(name, keeping_taut(words, problem_.at(u, true), strain > 0));
      std::vector<CalibrationStart> starts = best.starts;
      starts.insert(starts.end(), again.starts.begin(), again.starts.end());
      if (cost(again) < (1 - kWorthATautStart) * cost(best)) {
        again.at_start = best.at_start;
        best = std::move(again);
      }
      best.starts = std::move(starts);
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
  VecX start_of(int number) const {
    const auto n = static_cast<Eigen::Index>(problem_.unknowns().size());
    VecX u = spread_point(number, n);
    for (Eigen::Index k = 0; k < n; ++k)
      u[k] = std::clamp(u[k] * options_.spread * problem_.unknowns()[static_cast<std::size_t>(k)].standard_change(),
                        how_.lower[k], how_.upper[k]);
    return u;
  }

  /// The fit again, with what is slack in every pose made taut, as long as that is better.
  Found made_taut(const std::string& number, Found best) const {
    for (int round = 0; round < kTautRounds && !best.slack.empty(); ++round) {
      const auto taut = taut_ones(best.at_end, best.slack);
      if (taut.names.empty()) break;
      Found again = fit(number + ", " + taut.names + " made taut", problem_.at(taut.u, true), {}, false);
      std::vector<CalibrationStart> starts = best.starts;
      starts.insert(starts.end(), again.starts.begin(), again.starts.end());
      const bool better = cost(again) < (1 - kWorthATautStart) * cost(best) && leaves_something(best.fit.residuals);
      if (better) {
        again.at_start = best.at_start;
        best = std::move(again);
      }
      best.starts = std::move(starts);
      if (!better) break;
    }
    return best;
  }

  /// The fit, which is left where an unknown is slack in every pose, and continued with it just taut: without a
  /// gradient of it the others would creep to a false minimum. What becomes slack again and again is left so.
  Found keeping_taut(std::string name, CalibrationProblem::At start, bool held) const {
    std::vector<int> often(problem_.unknowns().size(), 0);
    const std::string number = name.substr(0, name.find(','));
    std::vector<CalibrationStart> starts;
    CalibrationProblem::At first = start;
    for (;;) {
      const auto to_be_taut = [&](const CalibrationProblem::At& at) {
        std::vector<std::size_t> out;
        if (leaves_something(at.residuals))
          for (const std::size_t k : slack_in(at))
            if (often[k] < kTautOnTheWay) out.push_back(k);
        return out;
      };
      const auto leave = [&](const CalibrationProblem::At& at) { return !taut_ones(at, to_be_taut(at)).names.empty(); };
      Found found = fit(name, std::move(start), leave, held);
      starts.insert(starts.end(), found.starts.begin(), found.starts.end());
      if (found.fit.stop != LeastSquaresStop::left) {
        found.starts = std::move(starts);
        found.at_start = std::move(first);
        return found;
      }
      const std::vector<std::size_t> slack = to_be_taut(found.at_end);
      for (const std::size_t k : slack) ++often[k];
      const auto taut = taut_ones(found.at_end, slack);
      name = number + ", " + taut.names + " made taut";
      start = problem_.at(taut.u, true);
      if (start.residuals.size() == 0) start = std::move(found.at_end);
    }
  }

  /// u with these unknowns just taut where that is possible, and their names.
  struct TautOnes {
    VecX u;
    std::string names;
  };
  TautOnes taut_ones(const CalibrationProblem::At& at, const std::vector<std::size_t>& slack) const {
    TautOnes out{at.u, ""};
    for (const std::size_t k : slack) {
      const auto column = static_cast<Eigen::Index>(k);
      const auto taut = taut_start(problem_.unknowns()[k], at.u[column], longest(at, k), kTautStrain);
      if (!taut) continue;
      out.u[column] = *taut;
      out.names += (out.names.empty() ? "" : ", ") + problem_.unknowns()[k].name;
    }
    return out;
  }

  /// u with every slack length so short that it has at least this strain where it is longest.
  VecX stretched(const CalibrationProblem::At& at, double strain) const {
    VecX u = at.u;
    for (std::size_t k = 0; k < problem_.unknowns().size(); ++k) {
      const auto members = longest(at, k);
      const auto column = static_cast<Eigen::Index>(k);
      if (members.empty() ||
          std::any_of(members.begin(), members.end(), [&](const auto& m) { return m.longest >= 1 + strain; }))
        continue;
      if (const auto taut = taut_start(problem_.unknowns()[k], u[column], members, strain)) u[column] = *taut;
    }
    return u;
  }

  /// With `held` slack lengths are first held near their start, less and less:
  ///
  ///   |r(u)|^2 + h |r(u_0)|^2 / n sum_k ((u_k - u_0k) / s_k)^2,   h of kHeldShares
  ///
  /// with s = kHeldChange standard changes. Numbers that the target hardly determines then wait until the others are
  /// near, instead of running off to another minimum. `leave`: whether to stop there; may be empty.
  Found fit(const std::string& name, CalibrationProblem::At start,
            const std::function<bool(const CalibrationProblem::At&)>& leave, bool held) const {
    Found out;
    const VecX u = start.u;
    CalibrationProblem::At last = std::move(start);
    bool exact = true;
    VecX hold;                            // of each unknown, 1 / u; empty: free
    CalibrationProblem::At whole = last;  // the last point of the fit where all rows exist
    VecX known = last.residuals;  // at the last point of the fit; of rows that do not exist there as they last were
    // Rows that do not exist at a trial, as where a curve ends early, neither help nor hinder it: what it changes of
    // the others decides. Without them the fit would end at the edge of where all exist, which truth may lie behind.
    const auto with_known = [&](const CalibrationProblem::At& at) {
      VecX r = at.is_partial() ? at.some : at.residuals;
      for (Eigen::Index k = 0; at.is_partial() && k < r.size(); ++k)
        if (!at.there[static_cast<std::size_t>(k)]) r[k] = known[k];
      return r;
    };
    const auto enough_is_there = [&](const CalibrationProblem::At& at) {
      if (!at.is_partial() || known.size() == 0 || at.some_derivatives.size() == 0) return false;
      const auto missing = std::count(at.there.begin(), at.there.end(), false);
      return static_cast<double>(missing) <= kMostMissingRows * static_cast<double>(at.there.size());
    };
    const auto residuals = [&](const VecX& x) -> std::optional<VecX> {
      if (last.u != x || (last.residuals.size() == 0 && !last.is_partial())) {
        CalibrationProblem::At here = problem_.at(x, exact);
        exact = here.derivatives.size() > 0 || here.residuals.size() == 0;
        if (here.residuals.size() == 0 && !enough_is_there(here)) return std::nullopt;
        last = std::move(here);
      }
      const VecX own = with_known(last);
      VecX all(own.size() + hold.size());
      all << own, hold.cwiseProduct((x - u).head(hold.size()));
      return all;
    };
    // The last residuals asked for may be those of a step that was not taken.
    const auto jacobian = [&](const VecX& x) -> std::optional<MatX> {
      if (last.u != x) last = problem_.at(x, exact);
      known = with_known(last);
      if (!last.is_partial()) whole = last;
      const auto J = last.is_partial() ? std::optional(last.some_derivatives) : problem_.jacobian(last);
      if (!J || hold.size() == 0) return J;
      MatX all(J->rows() + hold.size(), J->cols());
      all << *J, MatX(hold.asDiagonal());
      return all;
    };
    LeastSquaresOptions how = how_;
    if (!bounded_) how.lower = how.upper = VecX();
    how.noise = derivative_noise(true);
    LeastSquaresProblem problem{residuals, jacobian, options_.cancelled};
    if (leave) problem.leave = [&](const VecX&) { return !last.is_partial() && leave(last); };
    // Central differences are worse: where they are needed is known after the first residuals.
    if (last.residuals.size() > 0 && last.derivatives.size() == 0) how.noise = derivative_noise(false), exact = false;
    out.at_start = last;
    VecX from = u;
    int iterations = 0;
    bool leaves = leave && leave(last);
    held = held && !slack_lengths_.isZero() && last.derivatives.size() > 0;
    for (const double share : kHeldShares) {
      if (!held || leaves || !leaves_something(out.at_start.residuals)) break;
      hold = std::sqrt(share * out.at_start.residuals.squaredNorm() / static_cast<double>(u.size())) * slack_lengths_;
      LeastSquaresOptions short_fit = how;
      short_fit.most_iterations = kHeldIterations;
      const LeastSquaresResult near = least_squares(problem, from, short_fit);
      from = near.x;
      iterations += near.iterations;
      leaves = near.stop == LeastSquaresStop::left || near.stop == LeastSquaresStop::cancelled;
      if (near.residuals.squaredNorm() < kHeldEnough * out.at_start.residuals.squaredNorm()) break;
    }
    hold.resize(0);
    out.fit = least_squares(problem, from, how);
    out.fit.iterations += iterations;
    if (out.fit.residuals.size() > 0) out.at_end = last.u == out.fit.x ? last : problem_.at(out.fit.x, exact);
    if (out.at_end.is_partial()) {  // the scene does not follow the target there
      out.at_end = whole;
      out.fit.x = whole.u;
      out.fit.residuals = whole.residuals;
      if (converged(out.fit.stop)) out.fit.stop = LeastSquaresStop::no_progress;
    }
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
  const SolvableStart& first_;
  LeastSquaresOptions how_;
  VecX slack_lengths_;  ///< 1 / (kHeldChange standard changes) of unknowns that are slack lengths; 0: of others
  bool bounded_ = false;
};

}  // namespace

CalibrationSearch search(const CalibrationProblem& problem, const CalibrationSearchOptions& options,
                         const SolvableStart& start) {
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
