#include "genu/motion/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <fmt/format.h>
#include <Eigen/LU>

#include "genu/model/ligament_pieces.h"
#include "genu/model/twist.h"
#include "genu/motion/layer_onset.h"
#include "genu/motion/motion_contacts.h"
#include "genu/motion/motion_switches.h"
#include "genu/motion/tolerances.h"
#include "genu/motion/touch_times.h"

namespace genu {
namespace {

constexpr double kJustAfterZero = std::numeric_limits<double>::min();  // s: time 0, past a nonsmooth point there

/// The twists for rates of all coordinates. Each moving body is the child of one joint, so the numbers agree.
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
  for (const auto& drive : model.drives)
    if (drive.quantity.combination < 0)
      rates[6 * drive.quantity.first.joint + drive.quantity.first.index] = drive.course.evaluate(kJustAfterZero).slope;
  for (const auto& [c, rate] : plan.start_rates) rates[6 * c.joint + c.index] = rate;
  return gradients.fullPivLu().solve(rates);
}

/// The joints' start, with values prescribed at time 0.
State start_of(const JointModel& model) {
  State state = start_state(model);
  std::vector<JointValues> values = state.coordinates;
  for (const auto& drive : model.drives)
    if (const CoordinateRef& c = drive.quantity.first; drive.quantity.combination < 0)
      values[at(c.joint)][at(c.index)] = drive.course.evaluate(kJustAfterZero).factor;
  state.poses = poses_from_coordinates(model, values);
  state.coordinates = values;
  settle_wraps(model, state);
  for (WrapTouch& touch : state.wraps) touch.by_length = true;  // a motion follows them
  state.multipliers.assign(model.drives.size() + model.held.size(), 0.0);
  return state;
}

/// All functions of time.
std::vector<const LoadScale*> courses_of(const JointModel& model) {
  std::vector<const LoadScale*> courses;
  for (const Load& load : model.loads)
    if (load.scale) courses.push_back(&*load.scale);
  for (const auto& drive : model.drives) courses.push_back(&drive.course);
  return courses;
}

/// Nonsmooth points in time between 0 and the end, then the end.
std::vector<double> stops_of(const JointModel& model, double duration) {
  std::vector<double> stops;
  for (const LoadScale* course : courses_of(model))
    for (const double t : course->nonsmooth_points_in_time())
      if (t > 0 && t < duration) stops.push_back(t);
  stops.push_back(duration);
  std::sort(stops.begin(), stops.end());
  stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
  return stops;
}

/// The integrator must not step over a sine that starts from rest.
double largest_step(const JointModel& model, double duration) {
  double step = duration;
  for (const LoadScale* course : courses_of(model))
    if (course->period() > 0) step = std::min(step, course->period() / 8);
  return step;
}

class Motion {
 public:
  Motion(const JointModel& model, const MotionPlan& plan, const MotionObserver& observer)
      : model_(model),
        plan_(plan),
        observer_(observer),
        switches_(model),
        equations_(model, step_tolerance(plan)),
        onset_(model),
        contacts_(model.pairs.empty() && model.layers.empty() && !plan.from_equilibrium
                      ? nullptr
                      : std::make_unique<MotionContacts>(model, equations_, step_tolerance(plan), observer.cancelled)),
        integrator_(system()),
        outputs_(output_times(plan)),
        stops_(stops_of(model, plan.duration)),
        largest_step_(largest_step(model, plan.duration)),
        has_drives_(!model.drives.empty()) {
    equations_.stop_when(observer.cancelled);
    now_.state = start_of(model);
    equations_.set_span(0, stops_.front());
    result_.why = no_start();
  }

  MotionResult run() {
    if (result_.why.empty() && begin_at(0, equations_.pack(now_))) go_on();
    result_.counts = integrator_.counts();
    if (!result_.complete && asked_to_stop(observer_.cancelled)) result_.why = "interrupted";
    return result_;
  }

 private:
  static double step_tolerance(const MotionPlan& plan) {
    return std::max(kStepShare * plan.tolerance, kMinStepTolerance);
  }

  /// Poses, speeds and contacts at time 0. Returns the reason for a failure; else empty.
  std::string no_start() {
    std::string why;
    if (plan_.from_equilibrium && !contacts_->balance(now_, why)) return why;
    now_.twist = start_twist(model_, now_.state, plan_);
    now_.acceleration.setZero(now_.twist.size());
    switches_.settle(now_, equations_.pieces(), equations_.modes());
    now_.state.pieces = equations_.pieces().pieces;
    if (equations_.massless(now_)) return "the bodies have no mass or no inertia against a motion that is free";
    if (!contacts_) return {};
    do {
      if (!contacts_->begin(now_, why)) return why;
    } while (equations_.raise_layers(now_));
    equations_.continue_from(now_);
    return {};
  }

  OdeSystem system() {
    OdeSystem s;
    s.size = equations_.size();
    s.roots = switches_.count();
    s.rate = [this](double t, OdeSystem::Values y, Eigen::Ref<VecX> out) { return equations_.rate(t, y, out); };
    s.weights = [this](OdeSystem::Values y, Eigen::Ref<VecX> out) { equations_.weights(y, out); };
    s.root_values = [this](double t, OdeSystem::Values y, double* out) {
      if (!equations_.see(t, y, watched_)) return false;
      switches_.values(watched_, equations_.modes(), out);
      return true;
    };
    return s;
  }

  /// Starts the integration at a point on the constraints.
  bool begin_at(double t, const VecX& y) {
    if (!equations_.read(t, y, now_) || !integrator_.start(t, equations_.pack(now_), largest_step_, method_)) {
      result_.why = fmt::format("the equations of motion cannot be evaluated at {:.9g} s", t);
      return false;
    }
    equations_.continue_from(now_);
    return write_rows();
  }

  void go_on() {
    double from = 0;
    for (const double stop : stops_) {
      equations_.set_span(from, stop);
      if (from > 0 && !pass_stop()) return;
      from = stop;
      bool reached = false;
      while (!reached) {
        if (!step(stop, reached)) return;
      }
    }
    result_.complete = true;
  }

  /// Loads and drives may jump here, and velocities and contacts with them.
  bool pass_stop() {
    VecX impulses;
    if (contacts_) {
      std::vector<PathEvent> events;
      if (!contacts_->settle(now_, events, result_.why)) return false;
      tell(events);
    } else if (has_drives_ && !equations_.strike(now_, impulses)) {
      result_.why = fmt::format("the prescribed coordinates cannot be followed at {:.9g} s", now_.time);
      return false;
    }
    settle_pieces();
    return begin_at(now_.time, equations_.pack(now_));
  }

  /// Ligaments and dampers after a jump of velocities.
  void settle_pieces() {
    switches_.settle(now_, equations_.pieces(), equations_.modes());
    now_.state.pieces = equations_.pieces().pieces;
    equations_.continue_from(now_);
  }

  void tell(const std::vector<PathEvent>& events) {
    for (const PathEvent& event : events)
      if (observer_.event) observer_.event(event);
  }

  bool point_at(double t, MotionPoint& out) {
    integrator_.interpolate(t, between_);
    return equations_.see(t, between_, out);
  }

  /// Handles a change of contacts in the last step. True: the motion has restarted there, or ends (`why`).
  bool contacts_change(const MotionPoint& before) {
    const auto at_time = [this](double t, MotionPoint& out) { return point_at(t, out); };
    const MotionContacts::Change change = contacts_->first_change(before, now_, at_time);
    if (change.kind == MotionContacts::Change::Kind::none) return false;
    now_ = change.point;
    if (!write_rows()) return true;
    if (change.kind == MotionContacts::Change::Kind::ends) {
      result_.why = change.why;
      return true;
    }
    std::vector<PathEvent> events;
    if (!contacts_->apply(change, now_, events, result_.why)) return true;
    tell(events);
    if (still_switching("contacts open and close")) return true;
    settle_pieces();
    begin_at(now_.time, equations_.pack(now_));
    return true;
  }

  /// Whether an elastic layer begins to carry load in the last step; the motion has then restarted there.
  bool layer_met(const MotionPoint& before) {
    const auto at_time = [this](double t, MotionPoint& out) { return point_at(t, out); };
    const auto met = onset_.first(before, now_, at_time);
    if (!met) return false;
    now_ = *met;
    if (!write_rows()) return true;
    equations_.continue_from(now_);
    begin_at(now_.time, equations_.pack(now_));
    return true;
  }

  /// Counts events at one moment. True where they do not end, which then stops the motion.
  bool still_switching(const char* what) {
    if (now_.time > last_switch_ + kStillTime * plan_.duration) {
      last_switch_ = now_.time;
      switched_ = 0;
    }
    if (++switched_ <= kMaxSwitches) return false;
    result_.why = fmt::format("{} without end at {:.9g} s", what, now_.time);
    return true;
  }

  /// Whether steps are too short to reach the end.
  bool creeps() {
    if (++taken_ % kHeadwayLooks != 0) return false;
    const double headway = now_.time - looked_at_;
    looked_at_ = now_.time;
    if (headway > kMinHeadway * plan_.duration) return false;
    result_.why = fmt::format(
        "the integration makes no headway at {:.9g} s: {} steps took it {:.2g} s on of {:g} s. Look for a course, "
        "spring, damper or mass that changes or swings far faster than that",
        now_.time, kHeadwayLooks, headway, plan_.duration);
    return true;
  }

  /// False where the motion ends.
  bool step(double stop, bool& reached) {
    if (now_.time >= stop) {  // an event happened at that very time
      reached = true;
      return true;
    }
    if (creeps()) return false;
    before_ = now_;
    const OdeIntegrator::Step taken = integrator_.step(stop);
    if (asked_to_stop(observer_.cancelled)) {
      result_.why = "interrupted";
      return false;
    }
    if (taken == OdeIntegrator::Step::failed || !equations_.see(integrator_.time(), integrator_.y(), now_)) {
      result_.why = fmt::format("the integration stops at {:.9g} s: {}", before_.time,
                                integrator_.failure().empty() ? "no state near" : integrator_.failure());
      return false;
    }
    result_.worst_drift = std::max(result_.worst_drift, now_.drift);
    const bool finer = equations_.raise_layers(now_);
    if (taken != OdeIntegrator::Step::root && !tried_ &&
        switches_.astray(now_, equations_.pieces(), equations_.modes())) {
      tried_ = true;  // it began at a break and moved to the other side: restart from there
      const MotionPoint beyond = now_;
      switches_.settle(beyond, equations_.pieces(), equations_.modes());
      now_ = before_;
      now_.state.pieces = equations_.pieces().pieces;
      return begin_at(before_.time, equations_.pack(now_));
    }
    tried_ = false;
    if (!model_.layers.empty() && layer_met(before_)) return result_.why.empty();
    if (contacts_ && contacts_change(before_)) return result_.why.empty();
    tell(touches_between(model_, before_, now_, [this](double t, MotionPoint& out) { return point_at(t, out); }));
    if (!write_rows()) return false;
    equations_.continue_from(now_);
    if (taken == OdeIntegrator::Step::root) return switch_over();
    reached = taken == OdeIntegrator::Step::stopped || now_.time >= stop;
    if (finer || now_.drift > kMaxDrift || found_stiff()) return begin_at(now_.time, equations_.pack(now_));
    return true;
  }

  /// Whether Adams' steps are limited by stability; then BDF takes over.
  bool found_stiff() {
    if (method_ == OdeMethod::bdf || ++steps_ % kStiffnessLooks != 0) return false;
    if (integrator_.last_step() * integrator_.fastest_decay() < kStabilityBound) return false;
    method_ = OdeMethod::bdf;
    result_.stiff_from = now_.time;
    return true;
  }

  bool switch_over() {
    tell(switches_.switch_over(integrator_.roots(), now_, equations_.pieces(), equations_.modes()));
    if (still_switching("ligaments become slack and taut")) return false;
    return begin_at(now_.time, equations_.pack(now_));
  }

  /// Writes all rows up to the present.
  bool write_rows() {
    for (; written_ < outputs_.size() && outputs_[written_] <= now_.time; ++written_) {
      const double t = outputs_[written_];
      MotionPoint point = now_;
      if ((t == now_.time || point_at(t, point)) && equations_.finish(point)) {
        hand_over(point);
        continue;
      }
      result_.why = fmt::format("no state on the constraints near that of {:.9g} s", t);
      return false;
    }
    return true;
  }

  void hand_over(MotionPoint& point) {
    result_.worst_residual = std::max(result_.worst_residual, point.residual);
    if (contacts_) point.pair_gap = contacts_->gaps(point);
    observer_.point(point);
  }

  const JointModel& model_;
  const MotionPlan& plan_;
  const MotionObserver& observer_;
  MotionSwitches switches_;
  EquationsOfMotion equations_;
  LayerOnset onset_;
  std::unique_ptr<MotionContacts> contacts_;  ///< null where the scene has no surfaces
  OdeIntegrator integrator_;
  std::vector<double> outputs_, stops_;
  double largest_step_;
  bool has_drives_;
  MotionPoint now_, before_, watched_;
  VecX between_;
  std::size_t written_ = 0;
  bool tried_ = false;
  OdeMethod method_ = OdeMethod::adams;
  long steps_ = 0, taken_ = 0;
  double looked_at_ = 0;
  double last_switch_ = -std::numeric_limits<double>::infinity();
  int switched_ = 0;
  MotionResult result_;
};

}  // namespace

std::vector<double> output_times(const MotionPlan& plan) {
  std::vector<double> times;
  for (long k = 0;; ++k) {
    const double t = static_cast<double>(k) * plan.output_interval;
    if (t >= plan.duration - kTimeRounding * plan.output_interval - kTimeRounding * plan.duration) break;
    times.push_back(t);
  }
  times.push_back(plan.duration);
  return times;
}

MotionResult follow_motion(const JointModel& model, const MotionPlan& plan, const MotionObserver& observer) {
  return Motion(model, plan, observer).run();
}

}  // namespace genu
