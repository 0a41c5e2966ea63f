// Path following along one step: from a solved pose to the next requested one, in as many continuation steps as needed.
#pragma once

#include <optional>
#include <utility>

#include "genu/path/event_newton.h"
#include "genu/path/law_events.h"
#include "genu/path/path_options.h"
#include "genu/path/path_prediction.h"
#include "genu/path/side_watch.h"

namespace genu {

class PathFollower {
 public:
  PathFollower(ActiveSetSolver& solver, const PathOptions& options, const std::function<void(PathEvent)>& event)
      : solver_(solver),
        options_(options),
        event_(event),
        prediction_(solver.model()),
        law_events_(solver.model(), options.locate_law_breaks),
        event_newton_(solver.model()),
        side_watch_(solver.model()) {}

  /// Starts a step at t = 0 with a pose solved there.
  void begin(const StepPlan& plan, int step, Balanced pose, const PoseReport& report);

  /// Follows the path to t. False where the path ends before; the pose is then the last valid one, at t().
  bool advance_to(double t);

  /// After advance_to() failed: tries to continue beyond a gap without solution, at most `window` of t long and not
  /// past t = 1. True if a pose is solved at some t() > the old one near the old pose. A pose far away lies on another
  /// branch, to which the joint would snap; it is rejected. If the gap contains `row`, the joint snaps to a pose of
  /// rest there where one is found.
  bool step_over(double window, double row = 1);

  /// After advance_to() failed: lets the joint snap, downhill in energy, to the pose where it comes to rest within
  /// `window` of t ahead, at any distance, and reports the events. Only with a driven coordinate: under too large a
  /// load no pose of rest may exist. Between rigid surfaces the bodies slide there in contact, and only a stable pose
  /// counts.
  bool snap_beyond(double window);
  /// Whether a prescribed coordinate varies over the step.
  bool drives() const;

  double t() const { return t_; }
  const Balanced& pose() const { return pose_; }
  const PoseReport& report() const { return report_; }
  const Stability& stability() const { return tangent_.stability; }
  /// Why advance_to() failed.
  const PoseReport& failure() const { return failure_; }
  /// Why the last snap_beyond() found no pose of rest.
  const PoseReport& no_rest() const { return no_rest_; }
  bool turning_back() const;
  /// Distance (m and rad of the body that moves most) to the equilibrium that the last step_over() found and rejected
  /// as too far; else 0, 0.
  std::pair<double, double> snap() const { return snap_; }
  /// Describes the jump of a ligament's force that ended the last advance_to(); empty for another cause.
  const std::string& law_jump() const { return law_jump_; }
  int substeps() const { return substeps_; }
  int iterations() const { return iterations_; }
  /// The sides of smooth law breaks that ligaments are on; other followers continue from there.
  LawEvents& law_events() { return law_events_; }

  /// After serialize(): the plan of the current step.
  void resume(const StepPlan& plan) {
    plan_ = plan;
    rate_ = plan.rate();
    driven_ = plan.only_driven();
  }

  /// Everything that continuation depends on except the plan of its step, between two calls of advance_to().
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(step_, t_, pose_, report_, failure_, tangent_.motion, tangent_.stability, prediction_, snap_.first,
            snap_.second, law_jump_, law_events_, side_watch_, inside_, stiffest_seen_, last_definite_, stepped_over_,
            crowd_, crowd_from_, substeps_, iterations_);
  }

 private:
  /// The tangent of the path at a pose, per unit of t, and the stability of the pose.
  struct Tangent {
    Correction motion;
    Stability stability;
  };
  struct Attempt {
    State predicted;
    Balanced pose;
    PoseReport report;
    Findings findings;
    bool valid() const { return report.status == PoseStatus::ok && findings.none(); }
  };

  /// An event between two poses of a smooth part of the path.
  struct Turn {
    double t;
    PathEvent::Kind kind;
    State state;
    std::string what;
  };

  Attempt attempt(double t, bool locating = false);
  void accept(double t, Balanced pose, const PoseReport& report, bool leaps = false);
  bool passes_a_fold(const Tangent& next, const State& there, double h) const;
  bool far_from_predicted(const Attempt& attempt) const;
  bool passes_through(const Attempt& trial);
  bool jumped(const State& state, double h) const;
  bool balance_at(double t, Balanced& next, PoseReport& report);
  /// The pose of rest at `t` to which the joint falls from here: on an elastic foundation (`seeded`), or in contact.
  PoseReport rest_at(double t, bool seeded, Balanced& next);
  bool snap_to(double t, bool seeded);
  bool pass_event(double t, Attempt violated);
  /// Where between here and a pose solved at `t` its only change happens: before it and beyond it, near enough where
  /// that is known; else NaN.
  std::pair<double, double> sides_of_change(double t, const Attempt& violated);
  /// Of a ligament or touch, by the cubic of the path; in the middle where that is not known.
  double place_of_change(double t, const Attempt& violated);
  /// Of a contact, by its force or gap at poses that are solved and not searched.
  std::pair<double, double> sides_of_contact(double t, const Attempt& violated);
  /// Whether events follow each other too closely to continue.
  /// Where a path over surfaces ends this one: names it. Always false.
  bool says_what_slips();
  bool events_without_end();
  /// The pose beyond a change of contacts or of a law's piece, near the pose before it.
  PoseReport settle_beyond(double t, Balanced& next);
  /// The pose where the joint comes to rest after the force of a ligament has dropped.
  PoseReport fall(double t, const std::string& drop, Balanced& next);
  void report_changes(const Balanced& before, const Balanced& after);
  void emit(PathEvent::Kind kind, const std::string& what);
  void emit_at(PathEvent::Kind kind, double t, const State& state, const std::string& what);
  /// Reports the events on the way to `trial` and goes there. False, without a report, if the step seems to leave the
  /// branch.
  bool pass(double t, Attempt trial);
  /// Goes to a trial at `t` that is valid and reached through no body. False where it is not, or where pass() is.
  bool goes_on_to(double t, const Attempt& trial);
  using Measure = std::function<double(const Tangent&)>;
  struct Found {
    double t;
    State state;
    double value;  ///< of the measure
    bool leaps;    ///< the poses on both sides do not meet: they lie on two branches, or no pose was found between
  };
  Found locate(const Measure& measure, double t_end, const State& end, double tolerance);
  Found locate(const Measure& measure, double t_end, const State& end) {
    return locate(measure, t_end, end, options_.event_tolerance);
  }
  bool find_turns(double t, const State& next, std::vector<Turn>& turns);
  bool find_stability_change(double t, const State& next, std::vector<Turn>& turns);
  double reaction_rate(const Tangent& tangent) const;
  std::string reaction_words(const Tangent& after, const State& state) const;
  /// Whether the driven coordinate's reaction has an extremum between here and the next pose, above noise.
  bool reaction_may_turn(double t, const State& next) const;
  /// `leaps`: no path connects the pose before with this one.
  std::vector<Turn> law_turns(double t, const State& state, bool leaps = false);
  /// Where another side of a surface becomes shorter for a path.
  void find_shorter_sides(double t, const State& next, std::vector<Turn>& turns);
  void compute_tangent(const State& state, double t, Tangent& out);
  /// `at`: the linearization of the pose; Newton's step has factored its Jacobian.
  void compute_tangent(const Linearization& at, const State& state, double t, Tangent& out);
  /// For the pose that Newton's method solved last, with the Jacobian it has factored where that is accurate enough.
  void compute_tangent_of_last(const State& state, double t, Tangent& out);
  void take(double t, Balanced pose, const PoseReport& report);

  ActiveSetSolver& solver_;
  const PathOptions& options_;
  const std::function<void(PathEvent)>& event_;
  StepPlan plan_;
  Target rate_;
  int step_ = 0;
  double t_ = 0;
  Balanced pose_;
  PoseReport report_, failure_, no_rest_;
  Tangent tangent_, next_, between_;
  PathPrediction prediction_;
  int driven_ = -1;  // the only prescribed coordinate that varies over the step
  Linearization here_;
  std::pair<double, double> snap_{0, 0};
  std::string law_jump_;
  LawEvents law_events_;
  EventNewton event_newton_;
  SideWatch side_watch_;
  double inside_ = 0;                 // Findings::worst of the pose; +infinity where it is unknown
  double stiffest_seen_ = 0;          // largest |smallest eigenvalue| of the step, N m
  double last_definite_ = 0;          // the last smallest eigenvalue above rounding, N m
  int stepped_over_ = 0, crowd_ = 0;  // events since crowd_from_
  double crowd_from_ = 0;
  int substeps_ = 0, iterations_ = 0;
};

}  // namespace genu
