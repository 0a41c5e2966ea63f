#include "genu/solver/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/LU>

#include "genu/model/twist.h"
#include "genu/solver/motion_switches.h"

namespace genu {
namespace {

constexpr int kMostSwitches = 1000;  // without time going on by more than kStill of the duration
constexpr double kStill = 1e-9;
constexpr long kLookAtStiffness = 500;   // steps: 2 evaluations each, and one look costs some 30
constexpr double kStabilityBound = 0.6;  // step times decay: Adams of orders 4 to 8 are stable to 0.5 ... 1
constexpr double kRounding = 1e-12;      // of the output interval: a row this near the end is the end
constexpr double kLargestDrift = 1e-6;   // from the constraints: beyond, the integration begins anew on them

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The twists for rates of all coordinates: each moving body is the child of one joint, so there are as many.
VecX start_twist(const JointModel& model, const State& state, const MotionPlan& plan) {
  const auto n = static_cast<Eigen::Index>(6 * model.joints.size());
  MatX gradients = MatX::Zero(n, 6 * model.moving_count);
  VecX rates = VecX::Zero(n);
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j) {
    const JointPoint point = joint_point(model, state, j);
    const int parent = model.bodies[at(model.joints[at(j)].parent)].moving;
    const int child = model.bodies[at(model.joints[at(j)].child)].moving;
    for (int i = 0; i < 6; ++i) {
      const JointPoint::Gradient g = point.gradient(i);
      if (parent >= 0) gradients.block<1, 6>(6 * j + i, 6 * parent) = g.head<6>();
      if (child >= 0) gradients.block<1, 6>(6 * j + i, 6 * child) = g.tail<6>();
    }
  }
  for (const auto& [c, rate] : plan.start_rates) rates[6 * c.joint + c.index] = rate;
  return gradients.fullPivLu().solve(rates);
}

/// Where a load in time has a kink, between 0 and the end; then the end.
std::vector<double> stops_of(const JointModel& model, double duration) {
  std::vector<double> stops;
  for (const Load& load : model.loads)
    if (load.scale)
      for (const double t : load.scale->kinks_in_time())
        if (t > 0 && t < duration) stops.push_back(t);
  stops.push_back(duration);
  std::sort(stops.begin(), stops.end());
  stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
  return stops;
}

/// A sine that starts from rest must not be stepped over.
double largest_step(const JointModel& model, double duration) {
  double step = duration;
  for (const Load& load : model.loads)
    if (load.scale && load.scale->period() > 0) step = std::min(step, load.scale->period() / 8);
  return step;
}

class Motion {
 public:
  Motion(const JointModel& model, const MotionPlan& plan, const MotionObserver& observer)
      : plan_(plan),
        observer_(observer),
        switches_(model),
        equations_(model, std::max(MotionPlan::kStepShare * plan.tolerance, MotionPlan::kLeastStepTolerance)),
        integrator_(system()),
        outputs_(output_times(plan)),
        stops_(stops_of(model, plan.duration)),
        largest_step_(largest_step(model, plan.duration)) {
    now_.state = start_state(model);
    now_.state.multipliers.assign(model.held.size(), 0.0);
    now_.twist = start_twist(model, now_.state, plan);
    switches_.settle(now_, equations_.pieces(), equations_.modes());
  }

  MotionResult run() {
    if (equations_.massless(now_))
      result_.why = "the bodies have no mass or no inertia against a motion that is free";
    else if (begin_at(0, equations_.pack(now_)))
      go_on();
    result_.counts = integrator_.counts();
    return result_;
  }

 private:
  OdeSystem system() {
    OdeSystem s;
    s.size = equations_.size();
    s.roots = switches_.count();
    s.rate = [this](double t, OdeSystem::Values y, Eigen::Ref<VecX> out) { return equations_.rate(t, y, out); };
    s.weights = [this](OdeSystem::Values y, Eigen::Ref<VecX> out) { equations_.weights(y, out); };
    s.root_values = [this](double t, OdeSystem::Values y, double* out) {
      if (!equations_.read(t, y, watched_)) return false;
      switches_.values(watched_, equations_.modes(), out);
      return true;
    };
    return s;
  }

  /// Starts the integration at a point that is on the constraints.
  bool begin_at(double t, const VecX& y) {
    if (!equations_.read(t, y, now_) || !integrator_.start(t, equations_.pack(now_), largest_step_, method_)) {
      result_.why = fmt::format("the equations of motion cannot be evaluated at {:.9g} s", t);
      return false;
    }
    equations_.continue_from(now_);
    return write_rows();
  }

  void go_on() {
    for (const double stop : stops_) {
      bool reached = false;
      while (!reached) {
        if (!step(stop, reached)) return;
      }
      if (stop == plan_.duration) break;
      const VecX y = equations_.pack(now_);
      if (!begin_at(stop, y)) return;
    }
    result_.complete = true;
  }

  /// False where the motion ends.
  bool step(double stop, bool& reached) {
    if (observer_.cancelled && observer_.cancelled()) {
      result_.why = "interrupted";
      return false;
    }
    const MotionPoint before = now_;
    const OdeIntegrator::Step taken = integrator_.step(stop);
    if (taken == OdeIntegrator::Step::failed || !equations_.read(integrator_.time(), integrator_.y(), now_)) {
      result_.why = fmt::format("the integration stops at {:.9g} s: {}", before.time,
                                integrator_.failure().empty() ? "no state near" : integrator_.failure());
      return false;
    }
    result_.worst_drift = std::max(result_.worst_drift, now_.drift);
    if (taken != OdeIntegrator::Step::root && !tried_ &&
        switches_.astray(now_, equations_.pieces(), equations_.modes())) {
      tried_ = true;  // it began at a break and moved off to the other side: again from there
      const MotionPoint beyond = now_;
      switches_.settle(beyond, equations_.pieces(), equations_.modes());
      now_ = before;
      now_.state.pieces = equations_.pieces().pieces;
      return begin_at(before.time, equations_.pack(now_));
    }
    tried_ = false;
    if (!write_rows()) return false;
    equations_.continue_from(now_);
    if (taken == OdeIntegrator::Step::root) return switch_over();
    reached = taken == OdeIntegrator::Step::stopped || now_.time >= stop;
    if (now_.drift > kLargestDrift || found_stiff()) return begin_at(now_.time, equations_.pack(now_));
    return true;
  }

  /// Whether Adams' steps have become so short that only stability can ask for it; then BDF goes on.
  bool found_stiff() {
    if (method_ == OdeMethod::bdf || ++steps_ % kLookAtStiffness != 0) return false;
    if (integrator_.last_step() * integrator_.fastest_decay() < kStabilityBound) return false;
    method_ = OdeMethod::bdf;
    result_.stiff_from = now_.time;
    return true;
  }

  bool switch_over() {
    for (const PathEvent& event :
         switches_.switch_over(integrator_.roots(), now_, equations_.pieces(), equations_.modes())) {
      if (observer_.event) observer_.event(event);
    }
    if (now_.time > last_switch_ + kStill * plan_.duration) {
      last_switch_ = now_.time;
      switched_ = 0;
    }
    if (++switched_ > kMostSwitches) {
      result_.why = fmt::format("ligaments become slack and taut without end at {:.9g} s", now_.time);
      return false;
    }
    return begin_at(now_.time, equations_.pack(now_));
  }

  /// All rows up to the present.
  bool write_rows() {
    for (; written_ < outputs_.size() && outputs_[written_] <= now_.time; ++written_) {
      const double t = outputs_[written_];
      if (t == now_.time) {
        hand_over(now_);
        continue;
      }
      integrator_.interpolate(t, between_);
      MotionPoint point;
      if (!equations_.read(t, between_, point)) {
        result_.why = fmt::format("no state on the constraints near that of {:.9g} s", t);
        return false;
      }
      hand_over(point);
    }
    return true;
  }

  void hand_over(const MotionPoint& point) {
    result_.worst_residual = std::max(result_.worst_residual, point.residual);
    observer_.point(point);
  }

  const MotionPlan& plan_;
  const MotionObserver& observer_;
  MotionSwitches switches_;
  EquationsOfMotion equations_;
  OdeIntegrator integrator_;
  std::vector<double> outputs_, stops_;
  double largest_step_;
  MotionPoint now_, watched_;
  VecX between_;
  std::size_t written_ = 0;
  bool tried_ = false;
  OdeMethod method_ = OdeMethod::adams;
  long steps_ = 0;
  double last_switch_ = -std::numeric_limits<double>::infinity();
  int switched_ = 0;
  MotionResult result_;
};

}  // namespace

std::vector<double> output_times(const MotionPlan& plan) {
  std::vector<double> times;
  for (long k = 0;; ++k) {
    const double t = static_cast<double>(k) * plan.output_interval;
    if (t >= plan.duration - kRounding * plan.output_interval - kRounding * plan.duration) break;
    times.push_back(t);
  }
  times.push_back(plan.duration);
  return times;
}

MotionResult follow_motion(const JointModel& model, const MotionPlan& plan, const MotionObserver& observer) {
  return Motion(model, plan, observer).run();
}

}  // namespace genu
