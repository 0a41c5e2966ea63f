// Pseudo-arclength continuation of a step: the step's parameter t is an unknown, so the path passes limit points.
#pragma once

#include <functional>
#include <optional>

#include "genu/path/arc_newton.h"
#include "genu/path/law_events.h"
#include "genu/path/path_options.h"

namespace genu {

class ArcLengthFollower {
 public:
  struct Point {
    ArcPoint at;
    PoseReport report;
    Findings findings;
    Stability stability;   ///< at prescribed t
    bool directed = true;  ///< false at a singular point, where the path branches
    bool valid() const { return report.status == PoseStatus::ok && findings.none(); }
  };
  struct Outputs {
    std::function<void(int, const Point&)> row;  ///< t crosses increment / increments, upward or downward
    std::function<void(PathEvent::Kind, const Point&, const std::string&)> event;
    Cancelled cancelled;
  };
  enum class End { reached, closed, ran_away, stuck, cancelled };

  /// `law_events` are shared by all followers of a path.
  ArcLengthFollower(ActiveSetSolver& solver, const PathOptions& options, LawEvents& law_events, Outputs outputs)
      : solver_(solver),
        options_(options),
        newton_(solver.model(), options.newton),
        law_events_(law_events),
        outputs_(std::move(outputs)) {}

  /// From a pose solved at `t` until t = 1. The path may leave the interval at 0 and return.
  End follow(const StepPlan& plan, const Balanced& pose, const PoseReport& report, double t = 0);

  /// The limit point at which t stops growing, if the path from a solved pose at `t` leads to one without a change of
  /// the active set. Follows at most `reach` of arc length.
  std::optional<Point> limit_ahead(const StepPlan& plan, const Balanced& pose, double t, double reach);

  /// The limit point at a change of the active set at this pose beyond which t decreases, as where a contact opens
  /// without which the joint is unstable: a nonsmooth fold. Reports no events.
  std::optional<Point> turn_at_a_change(const StepPlan& plan, const Balanced& pose, const PoseReport& report, double t);

  const Point& here() const { return here_; }
  const PoseReport& failure() const { return failure_; }
  int substeps() const { return substeps_; }
  int iterations() const { return iterations_; }

 private:
  /// A place within a continuation step.
  struct Feature {
    double arc;
    Point point;
    PathEvent::Kind kind;  ///< of an event
    int increment;         ///< of a row
    bool is_row;
    std::string what;  ///< of an event
  };
  using Measure = std::function<double(const Point&)>;
  struct Found {
    double arc;
    Point point;
    double value;  ///< of the measure
    bool leaps;    ///< the poses on both sides do not meet: they lie on two branches, or no pose was found between
  };

  bool begin(const StepPlan& plan, const Balanced& pose, double t);
  Point attempt(const Point& from, double arc);
  Point attempt(double arc) { return attempt(here_, arc); }
  /// As solve() with findings, for a place within a continuation step whose end is inspected: contacts are not checked.
  Point solve(const Point& from, double arc);
  Stability assess(const State& state) const;
  bool on_the_path(const Point& from, const Point& point, double arc) const;
  bool passes_through(const Point& from, const Point& to) const;
  bool substep(double arc);
  bool pass_change(double arc, Point violated);
  bool change(Point& point);
  bool leave(Point& changed);
  void depart(const Point& changed, double arc, Point next);

  /// Reports all rows and events on the way to `next` and goes there. False, without a report, if the step seems to
  /// leave the branch.
  bool pass(double arc, Point next);
  void accept(Point next);
  void hand_over(Feature& row);
  bool may_hide_turns(double arc, const Point& next) const;
  bool find_features(double arc, const Point& next, std::vector<Feature>& out);
  bool add_stability(double arc, const Point& next, double turned, std::vector<Feature>& out);
  void add_neutral(double arc, const Point& next, std::vector<Feature>& out);
  void add_rows(double low, const Point& from, double high, const Point& to, std::vector<Feature>& out);
  void add_rows_between(const Point& before, const Point& changed);
  std::vector<int> rows_between(double from, double to) const;
  Found locate(const Measure& measure, double low, const Point& from, double high, const Point& to, double tolerance);
  Found locate(const Measure& measure, double low, const Point& from, double high, const Point& to);
  void add_law_events(double arc, const Point& next, std::vector<Feature>& out);
  bool settle_on(double t, Point& point);
  bool closes(const Point& point) const;
  static bool same_set(const State& a, const State& b);
  static bool turns(const Point& from, const Point& to);
  void add_reaction_turn(double arc, const Point& next, std::vector<Feature>& out);
  void report_changes(const Balanced& before, const Point& after);

  ActiveSetSolver& solver_;
  const PathOptions& options_;
  ArcNewton newton_;
  LawEvents& law_events_;
  Outputs outputs_;
  StepPlan plan_;
  Point start_, here_;
  PoseReport failure_;
  std::optional<End> end_;
  double last_definite_ = 0;  // the last smallest stiffness above rounding
  int substeps_ = 0, iterations_ = 0;
};

}  // namespace genu
