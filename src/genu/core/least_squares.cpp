#include "genu/core/least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/core/decompositions.h"
#include "genu/core/tolerances.h"

namespace genu {
namespace {

using Stop = LeastSquaresStop;

class LeastSquaresSearcher {
 public:
  LeastSquaresSearcher(const LeastSquaresProblem& problem, const LeastSquaresOptions& options)
      : problem_(problem), options_(options), damping_(options.first_damping) {}

  LeastSquaresResult run(const VecX& start) {
    result_.x = start;
    const auto first = problem_.residuals(start);
    ++result_.trials;
    if (!first) return result_;
    result_.residuals = *first;
    if (leaves()) return result_;
    while (!step()) ++result_.iterations;
    return std::move(result_);
  }

 private:
  bool stop(Stop why) {
    result_.stop = why;
    return true;
  }

  bool cancelled() const { return problem_.cancelled && problem_.cancelled(); }
  bool leaves() { return problem_.leave && problem_.leave(result_.x) && stop(Stop::left); }

  /// One linearisation and the steps tried on it; true when there is nothing more to do.
  bool step() {
    if (cancelled()) return stop(Stop::cancelled);
    if (result_.iterations >= options_.most_iterations) return stop(Stop::most_iterations);
    const auto J = problem_.jacobian(result_.x);
    if (!J) return stop(cancelled() ? Stop::cancelled : Stop::no_derivatives);
    result_.jacobian = *J;
    scale_ = scale_.size() == 0 ? VecX(J->colwise().norm()) : VecX(scale_.cwiseMax(J->colwise().norm().transpose()));
    const double largest = scale_.maxCoeff();
    if (!(largest > 0)) return stop(Stop::flat);
    const VecX measure = scale_.unaryExpr([&](double s) { return s > options_.noise * largest ? s : largest; });
    MatX scaled = *J * measure.cwiseInverse().asDiagonal();
    for (Eigen::Index k = 0; k < scale_.size(); ++k)
      if (!(scale_[k] > options_.noise * largest)) scaled.col(k).setZero();
    return try_steps(scaled, measure);
  }

  /// The largest part of a step, at most 1, that no unknown's longest step is shorter than.
  double within_most_step(const VecX& dx) const {
    const VecX over = options_.most_steps.size() > 0 ? VecX(dx.cwiseAbs().cwiseQuotient(options_.most_steps))
                                                     : VecX(dx.cwiseAbs() / options_.most_step);
    return 1 / std::max(1.0, over.maxCoeff());
  }

  bool has_bounds() const { return options_.lower.size() > 0; }

  /// Whether the step would leave the bounds at unknown k; `dx` is then cut to end there.
  bool cut_at_bound(Eigen::Index k, double& dx) const {
    const double x = result_.x[k], within = std::clamp(x + dx, options_.lower[k], options_.upper[k]) - x;
    if (within == dx) return false;
    dx = within;
    return true;
  }

  /// The damped step within the bounds: an unknown that would leave them stops there, and the others are chosen anew.
  VecX bounded_step(const MatX& scaled, const VecX& measure, double damping, bool& stops) const {
    MatX free = scaled;
    VecX residuals = result_.residuals, stopped = VecX::Zero(measure.size());
    std::vector<bool> held(static_cast<std::size_t>(measure.size()), false);
    for (Eigen::Index pass = 0; pass <= measure.size(); ++pass) {
      const VecX gradient = free.transpose() * residuals;
      VecX z = damped_step(symmetric_eigen(MatX(free.transpose() * free)), gradient, damping);
      z *= within_most_step(z.cwiseQuotient(measure));
      bool again = false;
      for (Eigen::Index k = 0; k < z.size(); ++k) {
        double dx = z[k] / measure[k];
        if (held[static_cast<std::size_t>(k)] || !cut_at_bound(k, dx)) continue;
        held[static_cast<std::size_t>(k)] = again = stops = true;
        stopped[k] = dx * measure[k];
        residuals += scaled.col(k) * stopped[k];
        free.col(k).setZero();
      }
      if (!again) return z + stopped;
    }
    return stopped;
  }

  /// Unknown by unknown to the least of the linearised problem within the bounds: one that was stopped at its bound may
  /// leave it again.
  void release(const MatX& scaled, const VecX& measure, double damping, VecX& z) const {
    const MatX normal = scaled.transpose() * scaled;
    VecX gradient = scaled.transpose() * result_.residuals + normal * z + damping * z;
    for (int sweep = 0; sweep < kReleaseSweeps; ++sweep)
      for (Eigen::Index k = 0; k < z.size(); ++k) {
        const double curvature = normal(k, k) + damping;
        if (!(curvature > 0)) continue;
        double dx = (z[k] - gradient[k] / curvature) / measure[k];
        cut_at_bound(k, dx);
        const double change = dx * measure[k] - z[k];
        z[k] += change;
        gradient += change * normal.col(k);
        gradient[k] += change * damping;
      }
  }

  /// The damped step of the linearised problem, without the directions in which it is noise.
  VecX damped_step(const SymmetricEigen<Eigen::Dynamic>& normal, const VecX& gradient, double damping) const {
    const double least = std::max(options_.noise * options_.noise, 1e-30) * normal.values.maxCoeff();
    VecX z = VecX::Zero(gradient.size());
    for (Eigen::Index k = 0; k < z.size(); ++k) {
      const double square = normal.values[k];
      const auto v = normal.vectors.col(k);
      if (square > least) z -= v.dot(gradient) / (square + damping) * v;
    }
    return z;
  }

  bool try_steps(const MatX& scaled, const VecX& measure) {
    const VecX gradient = scaled.transpose() * result_.residuals;
    const auto normal = symmetric_eigen(MatX(scaled.transpose() * scaled));
    const double cost = result_.residuals.squaredNorm();
    const auto promise = [&](const VecX& z) { return -2 * z.dot(gradient) - (scaled * z).squaredNorm(); };
    const auto step_of = [&](double damping) {
      if (!has_bounds()) return damped_step(normal, gradient, damping);
      bool held = false;
      VecX z = bounded_step(scaled, measure, damping, held);
      if (!held) return z;
      VecX better = z;
      release(scaled, measure, damping, better);
      return promise(better) > kReleaseGain * promise(z) ? better : z;
    };
    // Where residuals stay large and curved, every good step is damped, and would never be short enough to tell.
    const double undamped = promise(step_of(0));
    if (undamped <= options_.reduction_tolerance * cost) return stop(Stop::flat);
    double faster = 2;
    while (damping_ < kMaxLeastSquaresDamping) {
      const VecX whole = step_of(damping_);
      const double longest = whole.cwiseQuotient(measure).lpNorm<Eigen::Infinity>();
      const VecX z = within_most_step(whole.cwiseQuotient(measure)) * whole;
      const double promised = promise(z);  // by the linearisation
      const VecX dx = z.cwiseQuotient(measure);
      const bool freely = damping_ < kFreeStepDamping;
      if (freely && longest < options_.step_tolerance) return stop(Stop::small_step);
      if (freely && promised <= options_.reduction_tolerance * cost) return stop(Stop::flat);
      const auto residuals = problem_.residuals(result_.x + dx);
      ++result_.trials;
      if (cancelled()) return stop(Stop::cancelled);
      const double gain = residuals ? (cost - residuals->squaredNorm()) / promised : -1;
      if (gain > 0) {
        result_.x += dx;
        result_.residuals = *residuals;
        damping_ *= std::max(0.1, 1 - std::pow(2 * gain - 1, 3));
        const double less = cost - residuals->squaredNorm();
        const bool promised_more = undamped > kCreepPromise * cost && less < kCreepShare * undamped;
        creeping_ = promised_more && less < kCreep * cost ? creeping_ + 1 : 0;
        const bool stuck = options_.most_creeping > 0 && creeping_ >= options_.most_creeping;
        const bool ends = leaves() || (stuck && stop(Stop::creeping));
        if (ends) ++result_.iterations;
        return ends;
      }
      damping_ *= faster;
      faster *= 2;
    }
    return stop(Stop::no_progress);
  }

  const LeastSquaresProblem& problem_;
  const LeastSquaresOptions& options_;
  double damping_;
  int creeping_ = 0;  ///< steps in a row
  VecX scale_;
  LeastSquaresResult result_;
};

}  // namespace

const char* to_string(LeastSquaresStop stop) {
  switch (stop) {
    case Stop::small_step:
      return "converged: the last step is below the tolerance";
    case Stop::flat:
      return "converged: no step would lower the sum of squares";
    case Stop::no_progress:
      return "stalled: however short the step, the sum of squares does not fall";
    case Stop::creeping:
      return "stalled: step after step the sum of squares hardly falls, far from what the derivatives promise";
    case Stop::most_iterations:
      return "stopped after the most iterations allowed";
    case Stop::left:
      return "left for another start";
    case Stop::cancelled:
      return "interrupted";
    case Stop::no_start:
      return "the start could not be computed";
    case Stop::no_derivatives:
      return "beside the last values the scene could not be computed, which the derivatives need";
  }
  return "";
}

LeastSquaresResult least_squares(const LeastSquaresProblem& problem, const VecX& start,
                                 const LeastSquaresOptions& options) {
  return LeastSquaresSearcher(problem, options).run(start);
}

LeastSquaresUncertainty least_squares_uncertainty(const MatX& jacobian, const VecX& residuals, double noise,
                                                  std::optional<double> variance) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Eigen::Index n = jacobian.cols(), m = jacobian.rows();
  LeastSquaresUncertainty out;
  out.deviation = VecX::Constant(n, infinity);
  out.correlation = MatX::Identity(n, n);
  const SingularValues svd = singular_values(jacobian, LeftVectors::thin);
  const auto singular = [&](Eigen::Index k) { return k < svd.values.size() ? svd.values[k] : 0; };
  const double least = noise * singular(0);
  MatX covariance = MatX::Zero(n, n);
  VecX lost = VecX::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    VecX v = svd.V.col(k);
    if (singular(k) > least) {
      covariance += v * v.transpose() / (singular(k) * singular(k));
      continue;
    }
    Eigen::Index most = 0;
    v.cwiseAbs().maxCoeff(&most);
    if (v[most] < 0) v = -v;
    out.undetermined.push_back(v);
    lost = lost.cwiseMax(v.cwiseAbs());
  }
  const Eigen::Index spare = m - n + static_cast<Eigen::Index>(out.undetermined.size());
  out.covariance = covariance;
  if (!variance && spare <= 0) return out;
  if (!variance) variance = residuals.squaredNorm() / static_cast<double>(spare);
  out.covariance *= *variance;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (lost[i] > kUndeterminedShare) continue;
    out.deviation[i] = std::sqrt(out.covariance(i, i));
    for (Eigen::Index j = 0; j < n; ++j)
      if (j != i && !(lost[j] > kUndeterminedShare))
        out.correlation(i, j) = covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
  }
  return out;
}

}  // namespace genu
