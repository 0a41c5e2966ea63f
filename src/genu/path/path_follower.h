// Walks along one step: from a solved pose to the next one asked for, however many substeps that takes.
#pragma once

#include <optional>
#include <utility>

#include "genu/path/event_newton.h"
#include "genu/path/law_events.h"
#include "genu/path/path_options.h"
#include "genu/path/path_prediction.h"

namespace genu {

class PathFollower {
 public:
  PathFollower(ActiveSetSolver& solver, const PathOptions& options, const std::function<void(PathEvent)>& event)
      : solver_(solver),
        options_(options),
        event_(event),
        prediction_(solver.model()),
        law_events_(solver.model()),
        event_newton_(solver.model()) {}

  /// Starts a step at t = 0 with a pose that is solved there.
  void begin(const StepPlan& plan, int step, Balanced pose, const PoseReport& report);

  /// Walks to t. False where the path ends before; the pose then stays the last good one, at t().
  bool advance_to(double t);

  /// After advance_to() failed: tries to go on beyond a short stretch without solution, at most `window` of t long, but
  /// not past t = 1. True with the pose solved again at some t() > the old one, near where it was: a pose far away lies
  /// on another path, to which the joint would snap, and is not taken.
  bool step_over(double window);

  /// After advance_to() failed: lets the joint move on by itself, downhill, to where it comes to rest with what is
  /// prescribed at most `window` of t beyond, however far that is, and tells that it snaps. Only with elastic layers
  /// and a coordinate that is driven: between rigid surfaces the way is not known well enough, and a load that is too
  /// large has no place of rest to lead to.
  bool snap_beyond(double window);
  bool can_snap() const;

  double t() const { return t_; }
  const Balanced& pose() const { return pose_; }
  const PoseReport& report() const { return report_; }
  const Stability& stability() const { return tangent_.stability; }
  /// Why advance_to() failed.
  const PoseReport& failure() const { return failure_; }
  bool turning_back() const;
  /// The last step_over() found an equilibrium, but far away (m and rad of the body that moves most); 0, 0 otherwise.
  std::pair<double, double> snap() const { return snap_; }
  /// The jump of a ligament's force at which the last advance_to() ended, in words; empty where another cause ended it.
  const std::string& law_jump() const { return law_jump_; }
  int substeps() const { return substeps_; }
  int iterations() const { return iterations_; }
  /// Where ligaments stand with regard to the smooth breaks of their laws; other followers go on from there.
  LawEvents& law_events() { return law_events_; }

  /// After serialize(): the step that it stands in.
  void resume(const StepPlan& plan) {
    plan_ = plan;
    rate_ = plan.rate();
    driven_ = plan.only_driven();
  }

  /// All that the walk depends on but the plan of its step, between two calls of advance_to().
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(step_, t_, pose_, report_, failure_, tangent_.motion, tangent_.stability, prediction_, snap_.first,
            snap_.second, law_jump_, law_events_, inside_, stiffest_seen_, last_definite_, stepped_over_, crowd_,
            crowd_from_, substeps_, iterations_);
  }

 private:
  /// Where the path leads from a pose, per unit of t, and whether the pose is stable.
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

  /// Something between two poses of a smooth piece of the path.
  struct Turn {
    double t;
    PathEvent::Kind kind;
    State state;
    std::string what;
  };

  Attempt attempt(double t);
  void accept(double t, Balanced pose, const PoseReport& report, bool leaps = false);
  bool passes_a_fold(const Tangent& next, double h) const;
  bool far_from_predicted(const Attempt& attempt) const;
  bool passes_through(const Attempt& trial);
  bool jumped(const State& state, double h) const;
  bool balance_at(double t, Balanced& next, PoseReport& report);
  bool pass_event(double t, Attempt violated);
  /// Whether this event is one of too many close together.
  bool events_without_end();
  /// The pose beyond a change of contacts or of a law's piece, near where the path was.
  PoseReport settle_beyond(double t, Balanced& next);
  /// The pose in which the joint comes to rest where the force of a ligament has dropped.
  PoseReport fall(double t, const std::string& drop, Balanced& next);
  void report_changes(const Balanced& before, const Balanced& after);
  void emit(PathEvent::Kind kind, const std::string& what);
  void emit_at(PathEvent::Kind kind, double t, const State& state, const std::string& what);
  /// Tells what happens on the way to `trial` and goes there. False if the way seems to leave the branch: nothing is
  /// told.
  bool pass(double t, Attempt trial);
  using Measure = std::function<double(const Tangent&)>;
  struct Found {
    double t;
    State state;
    double value;  ///< of the measure
    bool leaps;    ///< the poses on both sides do not meet: not one branch, or none was found between
  };
  Found locate(const Measure& measure, double t_end, const State& end);
  bool find_turns(double t, const State& next, std::vector<Turn>& turns);
  bool find_stability_change(double t, const State& next, std::vector<Turn>& turns);
  double reaction_rate(const Tangent& tangent) const;
  std::string reaction_words(const Tangent& after, const State& state) const;
  /// Whether the driven coordinate's reaction turns between here and the next pose, and is more than noise there.
  bool reaction_may_turn(double t, const State& next) const;
  /// `leaps`: no path leads from the pose before to this one.
  std::vector<Turn> law_turns(double t, const State& state, bool leaps = false);
  void compute_tangent(const State& state, double t, Tangent& out);
  /// Linearized `at` the pose, of which Newton's step has factored the Jacobian.
  void compute_tangent(const Linearization& at, const State& state, double t, Tangent& out);
  /// Of the pose that Newton has solved last, with the Jacobian it had at hand where that tells enough.
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
  PoseReport report_, failure_;
  Tangent tangent_, next_, between_;
  PathPrediction prediction_;
  int driven_ = -1;  // the prescribed coordinate that alone varies over the step
  Linearization here_;
  std::pair<double, double> snap_{0, 0};
  std::string law_jump_;
  LawEvents law_events_;
  EventNewton event_newton_;
  double inside_ = 0;                 // Findings::worst of the pose, +infinity where that is not known
  double stiffest_seen_ = 0;          // the largest |smallest eigenvalue| of the step, N m
  double last_definite_ = 0;          // the smallest eigenvalue where it was last more than rounding, N m
  int stepped_over_ = 0, crowd_ = 0;  // events since crowd_from_
  double crowd_from_ = 0;
  int substeps_ = 0, iterations_ = 0;
};

}  // namespace genu
