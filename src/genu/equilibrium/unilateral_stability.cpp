#include "genu/equilibrium/unilateral_stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "genu/contact/elastic_layer.h"
#include "genu/core/decompositions.h"
#include "genu/equilibrium/feasible_direction.h"
#include "genu/equilibrium/release.h"
#include "genu/equilibrium/tolerances.h"
#include "genu/equilibrium/unilateral_stiffness.h"

namespace genu {
namespace {

using Verdict = Stability::Verdict;
using Kind = ReleasedPlane::Kind;

constexpr const char* kPressesAtOnce = "the surfaces of an unloaded layer conform: any motion loads it";

/// Minimum cost among the motions of `basis` (6B x d, in the metric of stability).
struct Among {
  MatX basis;
  UnilateralStiffness at;
  bool drops = false;   ///< some motion goes beyond a drop
  bool closed = false;  ///< there are closed planes
  LeastCost least;

  VecX motion(const VecX& x) const { return (basis * x).normalized(); }
};

Among among(const FreeStiffness& free, MatX basis, const std::vector<ReleasedPlane>& planes) {
  Among out{std::move(basis), {}, false, false, {}};
  out.at.stiffness = out.basis.transpose() * free.stiffness * out.basis;
  out.at.known_to = free.known_to;
  const VecX unit = stability_metric(out.basis.rows());
  for (const ReleasedPlane& plane : planes) {
    const VecX gradient = unit.cwiseProduct(plane.gradient), row = out.basis.transpose() * gradient;
    if (!(row.norm() > kDependentRow * gradient.norm())) continue;  // no motion crosses it
    out.drops = out.drops || plane.kind == Kind::drop;
    out.closed = out.closed || plane.kind == Kind::closed;
    if (plane.kind == Kind::drop) continue;
    Side side{row.normalized(), VecX::Zero(row.size()), VecX::Zero(row.size()), plane.kind == Kind::closed};
    if (!side.closed) {
      const VecX push = -row.norm() * (out.basis.transpose() * unit.cwiseProduct(plane.wrench));
      side.below = plane.below * push;
      side.above = plane.above * push;
    }
    out.at.sides.push_back(std::move(side));
  }
  return out;
}

Among searched(const FreeStiffness& free, const MatX& basis, const std::vector<ReleasedPlane>& planes) {
  Among out = among(free, basis, planes);
  if (basis.cols() > 0) out.least = least_cost(out.at);
  return out;
}

Verdict verdict_of(const LeastCost& least) {
  if (least.any && least.cost < 0) return Verdict::unstable;
  return least.free.cols() > 0 || (least.any && least.cost == 0) ? Verdict::neutral : Verdict::stable;
}

/// The same motions, orthonormal with lengths measured about the bodies' own origins.
MatX in_own_metric(const Linearization& at, const MatX& basis) {
  const MatX motions = about_own_origins(at, basis);
  const MatX lengths = motions.transpose() * motions;
  const auto eigen = symmetric_eigen(lengths);
  return basis * (eigen.vectors *
                  eigen.values.cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse().asDiagonal());
}

/// The smallest eigenvalue in the metric about the bodies' own origins; NaN where rounding hides it.
double smallest(const Released& released, const FreeStiffness& free, const Among& found) {
  if (!found.least.any) return std::numeric_limits<double>::infinity();
  if (released.at.own_origins.size() == 0) return found.least.cost;
  Among own = among(free, in_own_metric(released.at, found.basis), released.planes);
  own.at.known_to = 0;
  own.at.nothing = 1e-15;
  own.least = least_cost(own.at);
  const bool told = own.least.told && own.least.any && (own.least.cost < 0) == (found.least.cost < 0);
  return told ? own.least.cost : std::numeric_limits<double>::quiet_NaN();
}

/// Layers without load, and whether a motion would meet a force of theirs at once.
class IdleLayers {
 public:
  IdleLayers(const JointModel& model, const State& state, std::vector<int> layers)
      : model_(model), state_(state), layers_(std::move(layers)) {}

  /// Whether the load of some layer grows in proportion to the distance along `motion` (in the metric). Conforming
  /// surfaces do this; others begin quadratically.
  bool bar(const VecX& motion) {
    const double length = kLayerProbe * model_.scales.length / kMetricLength;
    for (const int k : layers_) {
      const double near = load_after(k, length * motion);
      if (!(near > 0)) continue;
      if (load_after(k, kLayerProbeRatio * length * motion) < kLinearGrowth * kLayerProbeRatio * near) return true;
    }
    return false;
  }

 private:
  double load_after(int k, const VecX& motion) {
    Correction by;
    by.resize(model_.moving_count, 0, 0);
    by.twist = stability_metric(motion.size()).cwiseProduct(motion);
    State state, moved;
    state.poses = state_.poses;
    state.coordinates = state_.coordinates;
    if (!retract(model_, state, by, 1, moved)) return 0;
    const auto& layer = model_.layers[at(k)];
    ElasticLayer::Memory memory;
    LayerWrench pressed;
    layer.layer->evaluate(moved.poses[at(layer.body_a)], moved.poses[at(layer.body_b)], memory, pressed,
                          state_.layer_level(at(k)), nullptr);
    return pressed.load;
  }

  const JointModel& model_;
  const State& state_;
  std::vector<int> layers_;
};

/// x . K(x) x on the sides that x takes; infinite beyond a closed plane.
double cost_of(const UnilateralStiffness& at, const VecX& x) {
  double out = x.dot(at.stiffness * x);
  for (const Side& s : at.sides) {
    const double past = s.row.dot(x);
    if (s.closed && past > 1e-9) return std::numeric_limits<double>::infinity();
    if (!s.closed) out += past * x.dot(past > 0 ? s.above : s.below);
  }
  return out;
}

/// Whether idle layers block a motion, and also its reverse where that costs the same.
bool barred(IdleLayers& layers, const Among& found, const VecX& x) {
  if (!layers.bar(found.motion(x))) return false;
  const double forth = cost_of(found.at, x), back = cost_of(found.at, -x);
  return std::abs(back - forth) > 1e-6 * std::abs(forth) + found.at.known_to || layers.bar(-found.motion(x));
}

bool barred(IdleLayers& layers, const Among& found) {
  if (found.least.any && barred(layers, found, found.least.motion)) return true;
  for (Eigen::Index k = 0; k < found.least.free.cols(); ++k)
    if (barred(layers, found, found.least.free.col(k))) return true;
  return false;
}

/// Whether the extent of idle contacts along lines and areas matters: does the result change if they block everything
/// they might block?
bool depends_on_extent(const Released& released, const FreeStiffness& free, const Among& found) {
  if (released.conforming.rows() == 0) return false;
  const VecX unit = stability_metric(free.basis.rows());
  const MatX left = null_space((released.conforming * unit.asDiagonal()) * free.basis, kDependentRow);
  const LeastCost held = searched(free, free.basis * left, released.planes).least;
  if (!held.told || verdict_of(held) != verdict_of(found.least)) return true;
  return held.any && std::abs(held.cost - found.least.cost) > 1e-9 * std::abs(held.cost) + free.known_to;
}

void take(const JointModel& model, const State& state, const Released& released, const FreeStiffness& free,
          const Among& found, Stability& out) {
  const LeastCost& least = found.least;
  IdleLayers layers(model, state, released.idle_layers);
  out.unilateral = true;
  out.neutral = found.basis * least.free;
  out.complex_pair = least.complex_pair;
  out.verdict = verdict_of(least);
  out.flutter = least.oscillates && (out.verdict == Verdict::unstable || out.neutral.cols() == 0);
  const bool falls = out.verdict == Verdict::unstable;
  out.smallest = out.verdict == Verdict::neutral ? 0 : smallest(released, free, found);
  if (!least.told)
    out.unknown_why = "too many ligaments, contacts and stops are about to change at once";
  else if (found.drops && found.closed)
    out.unknown_why = "the force of a ligament drops where a contact holds no force";
  else if (depends_on_extent(released, free, found))
    out.unknown_why = "surfaces touch without force along a line or an area of unknown size";
  else if (barred(layers, found))
    out.unknown_why = kPressesAtOnce;
  else if (std::isnan(out.smallest))
    out.unknown_why = "the origins of the bodies are too far from the joint";
  out.mode = VecX::Zero(free.basis.rows());
  if (out.neutral.cols() > 0 && !falls)
    out.mode = out.neutral.col(0);
  else if (least.any)
    out.mode = found.motion(least.motion);
  if (found.drops) {  // stiffness is minus infinity: the force drops
    out.verdict = Verdict::unstable;
    out.smallest = -std::numeric_limits<double>::infinity();
  }
  if (out.unknown_why.empty()) return;
  out.verdict = Verdict::neutral;
  out.smallest = 0;
}

/// Where nothing else is unilateral: layers that touch, whose tangent stiffness is zero there.
void look_at_layers(const JointModel& model, const State& state, const std::vector<int>& idle, Stability& stability) {
  if (idle.empty() || stability.free_motions == 0) return;
  IdleLayers layers(model, state, idle);
  const auto bars = [&](const VecX& motion) { return layers.bar(motion) && layers.bar(-motion); };
  bool some = stability.mode.norm() > 0 && bars(stability.mode);
  for (Eigen::Index k = 0; k < stability.neutral.cols(); ++k) some = some || bars(stability.neutral.col(k));
  if (!some) return;
  stability.unknown_why = kPressesAtOnce;
  stability.unilateral = true;
  stability.verdict = Verdict::neutral;
  stability.smallest = 0;
}

}  // namespace

void assess_unilateral_stability(const JointModel& model, const State& state,
                                 const std::vector<ActiveContact>& touching, const Target& target,
                                 const std::vector<double>& layer_loads, double residual, Stability& stability) {
  if (touching.empty() && !may_release(model, state, target, layer_loads, residual)) return;
  Released released;
  release(model, state, touching, target, released);
  if (!released.any) return look_at_layers(model, state, released.idle_layers, stability);
  const FreeStiffness free = free_stiffness(released.at, model.scales.length, released.cancelled);
  take(model, state, released, free, searched(free, free.basis, released.planes), stability);
}

}  // namespace genu
