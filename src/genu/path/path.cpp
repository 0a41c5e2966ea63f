#include "genu/path/path.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "genu/contact/elastic_layer.h"
#include "genu/core/binary_archive.h"
#include "genu/equilibrium/settle_freed.h"
#include "genu/equilibrium/uniqueness.h"
#include "genu/model/ligament_pieces.h"
#include "genu/path/arc_length_follower.h"
#include "genu/path/change_drivers.h"
#include "genu/path/fields.h"
#include "genu/path/path_follower.h"
#include "genu/path/path_turn.h"
#include "genu/path/raised_loads.h"
#include "genu/path/tolerances.h"

namespace genu {
namespace {

constexpr int kApproach = 0;  // the step number of events on the way to the start of a step

PathOptions stoppable_path(PathOptions options, const Cancelled& cancelled) {
  options.newton.cancelled = cancelled;
  return options;
}

class PathRun {
 public:
  PathRun(const JointModel& model, ContactField& field, const std::vector<StepPlan>& steps, const PathOptions& options,
          const PathObserver& observer)
      : steps_(steps),
        options_(stoppable_path(options, observer.cancelled)),
        observer_(observer),
        solver_(model, field, options_.newton),
        follower_(solver_, options_, emit_) {
    pose_.state = start_state(model);
    pose_.last_number.assign(model.pairs.size(), 0);
  }

  /// Continues from where save() was called, in another run of the same program on the same input. Throws
  /// SavedElsewhere for another input.
  void restore(const std::string& saved) {
    try {
      BinaryReader archive(saved);
      remember(archive);
    } catch (const BrokenArchive&) {
      throw SavedElsewhere("the saved data are no state of a path");
    }
    const bool in_plan = step_ >= 0 && at(step_) <= steps_.size() && row_ >= 0 && rows_ >= 0;
    if (!in_plan || !fits(pose_)) throw SavedElsewhere("the saved data belong to another scene");
    forget();
  }

  PathResult run() {
    if (step_ == 0)
      result_.complete = true;
    else if (row_ > 0)
      continue_path(steps_[at(step_ - 1)]);
    for (std::size_t i = row_ > 0 ? at(step_) : at(std::max(step_ - 1, 0)); i < steps_.size() && !stopped_; ++i) {
      step_ = static_cast<int>(i) + 1;
      row_ = 0;
      if (rows_ > 0 && rows_ > rested_) rest();
      if (!reach_start(steps_[i])) break;
      steps_[i].arc_length ? follow_by_arc_length(steps_[i]) : follow(steps_[i]);
    }
    result_.substeps += follower_.substeps();
    result_.iterations += follower_.iterations();
    return result_;
  }

 private:
  bool fits(const Balanced& pose) const {
    const auto& pairs = solver_.model().pairs;
    return fits_model(solver_.model(), pose.state) && pose.last_number.size() == pairs.size() &&
           std::all_of(pose.open.begin(), pose.open.end(),
                       [&](const OpenContact& c) { return c.pair >= 0 && at(c.pair) < pairs.size(); });
  }

  /// Balances the joint at its current pose, then follows the path to the first values of the step.
  bool reach_start(const StepPlan& step) {
    if (step_ == 1) factors_ = step.target(0).load_factors;
    change_drivers(solver_.model(), step_ > 1 ? &steps_[at(step_ - 2)] : nullptr, step, pose_.state, factors_);
    const StepPlan plan = approach_to(step, solver_.model(), pose_.state, factors_);
    factors_ = step.target(1).load_factors;
    approaching_ = true;
    report_ = step_ == 1 ? solver_.settle_cold(pose_, plan.target(0)) : settle_freed(solver_, pose_, plan.target(0));
    result_.iterations += report_.iterations;
    if (step_ == 1 && report_.status != PoseStatus::ok && begin_lighter(plan, step)) return true;
    if (report_.status != PoseStatus::ok) {
      if (settle_past_flaw(step, report_)) return true;
      fail(step, 0, 0, report_, "no balanced pose was found to start from");
      return false;
    }
    if (plan.varies_nothing()) {
      approaching_ = false;
      return true;
    }
    follower_.begin(plan, kApproach, pose_, report_);
    while (!follower_.advance_to(1)) {
      if (follower_.law_jump().empty() && follower_.step_over(window(plan))) continue;
      if (follower_.law_jump().empty() && follower_.snap_beyond(window(plan))) continue;
      pose_ = follower_.pose();
      if (settle_past_flaw(step, follower_.failure())) return true;
      fail(step, 0, 0, follower_.failure(), "the start of the step cannot be reached from the reference pose");
      return false;
    }
    pose_ = follower_.pose();
    report_ = follower_.report();
    approaching_ = false;
    return true;
  }

  /// Where no pose is found at the start under all loads: finds one at the step's first values, with a part of the
  /// loads first.
  bool begin_lighter(const StepPlan& approach, const StepPlan& step) {
    if (report_.status == PoseStatus::flawed_mesh) return false;
    RaisedLoads raised = raise_loads(solver_, options_, approach, step, pose_);
    result_.substeps += raised.substeps;
    result_.iterations += raised.iterations;
    if (raised.borne == 0) return false;
    pose_ = std::move(raised.pose);
    report_ = raised.report;
    approaching_ = !raised.all;
    for (const PathEvent& event : raised.events) emit(event);
    if (raised.turn) emit(*raised.turn);
    if (!raised.all) result_.borne_loads = raised.borne;
    return raised.all;
  }

  /// Where contact touches a mesh flaw on the way to the step's start, at a pose that nobody requested: tries the start
  /// itself, from the pose nearest to it.
  bool settle_past_flaw(const StepPlan& step, const PoseReport& failure) {
    if (failure.status != PoseStatus::flawed_mesh) return false;
    Balanced trial = pose_;
    trial.state.contacts.clear();
    for (const auto& p : step.target(0).prescribed)
      if (const CoordinateRef& c = p.coordinate.first; p.coordinate.combination < 0)
        trial.state.coordinates[static_cast<std::size_t>(c.joint)][static_cast<std::size_t>(c.index)] = p.value;
    trial.state.poses = poses_from_coordinates(solver_.model(), trial.state.coordinates);
    settle_wraps(solver_.model(), trial.state);
    const PoseReport report = solver_.settle_cold(trial, step.target(0));
    result_.iterations += report.iterations;
    if (report.status != PoseStatus::ok) return false;
    pose_ = std::move(trial);
    report_ = report;
    approaching_ = false;
    return true;
  }

  void follow(const StepPlan& step) {
    follower_.begin(step, step_, pose_, report_);
    if (step_ == 1) hand_over(step, 0);
    continue_path(step);
  }

  /// Follows the rest of a step, after its row `row_`.
  void continue_path(const StepPlan& step) {
    follower_.resume(step);
    while (row_ < step.increments && !stopped_) {
      if (asked_to_stop(observer_.cancelled)) return stop();
      advance_to(step, ++row_);
      if (row_ < step.increments && rows_ - rested_ >= kRestRows && !stopped_) rest();
    }
    pose_ = follower_.pose();
    report_ = follower_.report();
  }

  /// The same by arc length. Rows lie where t passes k / increments, upward or downward, until t = 1.
  void follow_by_arc_length(const StepPlan& step) {
    if (step_ == 1) {
      follower_.begin(step, step_, pose_, report_);
      hand_over(step, 0);
    }
    int handed_over = 0;
    ArcLengthFollower follower(solver_, options_, follower_.law_events(),
                               {[&](int k, const ArcLengthFollower::Point& p) {
                                  PosePoint point;
                                  point.increment = k;
                                  point.t = p.at.t;
                                  point.pose = p.at.pose;
                                  point.report = p.report;
                                  point.report.iterations = follower.iterations() - handed_over;
                                  handed_over = follower.iterations();
                                  point.stability = p.stability;
                                  hand_over(step, std::move(point));
                                },
                                [&](PathEvent::Kind kind, const ArcLengthFollower::Point& p, const std::string& what) {
                                  emit({kind, step_, p.at.t, step.target(p.at.t), what, p.at.pose.state.coordinates});
                                },
                                observer_.cancelled});
    const ArcLengthFollower::End end = follower.follow(step, pose_, report_);
    result_.substeps += follower.substeps();
    result_.iterations += follower.iterations();
    pose_ = follower.here().at.pose;
    report_ = follower.here().report;
    if (end == ArcLengthFollower::End::cancelled) return stop();
    if (end != ArcLengthFollower::End::reached) explain_arc_end(step, end, follower);
  }

  void explain_arc_end(const StepPlan& step, ArcLengthFollower::End end, const ArcLengthFollower& follower) {
    const ArcLengthFollower::Point& last = follower.here();
    PoseReport report = follower.failure();
    report.status = report.status == PoseStatus::ok ? PoseStatus::no_equilibrium : report.status;
    if (end == ArcLengthFollower::End::closed) {
      emit({PathEvent::Kind::closed, step_, last.at.t, step.target(last.at.t), "", last.at.pose.state.coordinates});
      report.why = "the path is closed and does not reach the end of the step";
    }
    if (end == ArcLengthFollower::End::ran_away) report.why = "the path runs away from the end of the step";
    where_ = last.at.t;
    fail(step, step.increments, 1, report, "");
  }

  void advance_to(const StepPlan& step, int k) {
    const double t = static_cast<double>(k) / step.increments;
    if (follower_.t() > t) {
      // This row lies in the gap that was stepped over.
      fail(step, k, t, follower_.failure(), "", false);
      return;
    }
    while (!follower_.advance_to(t)) {
      const PoseStatus status = follower_.failure().status;
      const bool edge = status == PoseStatus::over_edge || status == PoseStatus::flawed_mesh;
      if (!edge && follower_.law_jump().empty() && follower_.step_over(window(step), t)) {
        if (follower_.t() <= t) continue;
        fail(step, k, t, follower_.failure(), "", false);
        return;
      }
      if (!edge && follower_.law_jump().empty() && follower_.snap_beyond(t - follower_.t())) continue;
      if (!edge && may_skip(step, k)) return fail(step, k, t, follower_.failure(), "", false);
      explain_end(step, k, t);
      return;
    }
    skipped_ = 0;
    hand_over(step, k);
  }

  /// With layers, a pose without equilibrium (forces jump where a ray leaves an edge) says little about the next one:
  /// the joint may settle there from here.
  bool may_skip(const StepPlan& step, int k) {
    return !solver_.model().layers.empty() && follower_.drives() && k < step.increments &&
           ++skipped_ <= kMaxSkippedRows;
  }

  /// Longest gap without solution that may be stepped over.
  double window(const StepPlan& step) const { return step.part_within(options_.largest_window); }

  void explain_end(const StepPlan& step, int k, double t) {
    PoseReport report = follower_.failure();
    pose_ = follower_.pose();
    const PathTurn turn = find_turn(solver_, options_, follower_, step, step_);
    result_.iterations += turn.iterations;
    if (turn.event) {
      emit(*turn.event);
      report.status = PoseStatus::no_equilibrium;  // what the last trial met lies beyond the end
    }
    if (!turn.why.empty()) report.why = turn.why;
    if (follower_.no_rest().status == PoseStatus::over_edge && !report.why.empty())
      report.why += "; " + follower_.no_rest().why;
    const auto [distance, angle] = follower_.snap();
    if (distance > 0 || angle > 0) {
      emit({PathEvent::Kind::snaps, step_, follower_.t(), step.target(follower_.t()),
            fmt::format("to an equilibrium {:.1f} mm and {:.1f} deg away", 1e3 * distance, angle * 180 / M_PI),
            pose_.state.coordinates});
      report.status = PoseStatus::no_equilibrium;
      report.why = "the equilibrium path ends before this pose; the next equilibrium is a jump away";
      if (!follower_.law_jump().empty()) report.why += ", as the force drops of ligament " + follower_.law_jump();
    }
    fail(step, k, t, report, "");
  }

  void hand_over(const StepPlan& step, int k) {
    PosePoint point;
    point.increment = k;
    point.t = follower_.t();
    point.pose = follower_.pose();
    point.report = follower_.report();
    point.report.iterations = follower_.iterations() - handed_over_;
    handed_over_ = follower_.iterations();
    point.stability = follower_.stability();
    hand_over(step, std::move(point));
  }

  void hand_over(const StepPlan& step, PosePoint point) {
    if (asked_to_stop(observer_.cancelled)) return stop();
    point.step = step_;
    point.branch = branch_;
    point.target = step.target(point.t);
    result_.complete = judge_uniqueness(solver_, point) && result_.complete;
    result_.worst_residual = std::max(result_.worst_residual, point.report.certificate.residual);
    ++rows_;
    observer_.pose(point, solver_.newton().layers().get());
  }

  void fail(const StepPlan& step, int k, double t, const PoseReport& report, const std::string& what,
            bool last = true) {
    if (asked_to_stop(observer_.cancelled)) return stop();
    PosePoint point;
    point.step = step_;
    point.branch = branch_;
    point.increment = k;
    point.t = t;
    point.target = step.target(t);
    point.report = report;
    if (point.report.status == PoseStatus::ok) point.report.status = PoseStatus::no_equilibrium;
    if (last) {
      const double where = approaching_ ? 0 : step.arc_length ? where_ : follower_.t();
      emit({PathEvent::Kind::stopped, approaching_ ? kApproach : step_, where, step.target(where),
            what.empty() ? report.why : what + ": " + report.why, pose_.state.coordinates});
      stop();
    }
    ++rows_;
    observer_.pose(point, solver_.newton().layers().get());
    result_.complete = false;
  }

  void stop() {
    result_.complete = false;
    stopped_ = true;
  }

  /// Between two rows: discards what can be computed again, so that the data in save() decide what follows, to the last
  /// bit. Triggered by the number of rows, never by time.
  void rest() {
    rested_ = rows_;
    forget();
    if (!observer_.rest || asked_to_stop(observer_.cancelled)) return;
    observer_.rest([this] {
      BinaryWriter archive;
      remember(archive);
      return archive.take();
    });
  }

  void forget() {
    solver_.field().forget();
    if (LayerMemories* layers = solver_.newton().linearization().layers.get(); layers != nullptr)
      layers->each.clear(), layers->buried.clear();
  }

  template <typename Archive>
  void remember(Archive& archive) {
    archive(pose_, report_, result_.complete, result_.substeps, result_.iterations, result_.worst_residual, step_, row_,
            factors_, approaching_, handed_over_, rows_, rested_, where_, skipped_, branch_, follower_);
  }

  void emit(PathEvent event) {
    if (asked_to_stop(observer_.cancelled)) return;  // a search cancelled here proves nothing
    event.rows_before = rows_;
    if (event.begins_branch()) ++branch_;
    if (observer_.event) observer_.event(event);
  }

  const std::vector<StepPlan>& steps_;
  const PathOptions options_;
  const PathObserver& observer_;
  const std::function<void(PathEvent)> emit_ = [this](const PathEvent& event) { emit(event); };
  ActiveSetSolver solver_;
  PathFollower follower_;
  Balanced pose_;
  PoseReport report_;
  PathResult result_;
  int step_ = 0;
  std::vector<double> factors_;  // of the loads, at the current pose
  bool approaching_ = false;
  int handed_over_ = 0, rows_ = 0;
  double where_ = 0;  // t at which a step by arc length ended early
  int skipped_ = 0;   // rows without a pose since the last row with one
  int row_ = 0;       // last row requested of a step; 0 before the first
  int rested_ = 0;    // number of rows at the last rest()
  int branch_ = 1;    // PosePoint::branch of the next row
  bool stopped_ = false;
};

}  // namespace

PathResult follow_path(const JointModel& model, ContactField& field, const std::vector<StepPlan>& steps,
                       const PathOptions& options, const PathObserver& observer, const std::string& from) {
  PathRun run(model, field, steps, options, observer);
  if (!from.empty()) run.restore(from);
  return run.run();
}

}  // namespace genu
