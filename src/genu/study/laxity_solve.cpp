#include "genu/study/laxity_solve.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "genu/assemble/with_numbers.h"
#include "genu/core/units.h"
#include "genu/equilibrium/sensitivity.h"
#include "genu/study/solve_path.h"
#include "genu/study/tolerances.h"

namespace genu {

namespace {

/// A part of a path: the load of the test from one value to another.
struct Leg {
  double from, to;  ///< N or N m
  int increments;
};

class LaxityTester {
 public:
  LaxityTester(const LaxityJoint& knee, const LaxityChoice& choice) : knee_(knee), choice_(choice) {}

  LaxityAngle test(double flexion) const {
    LaxityAngle angle;
    angle.flexion = flexion;
    Prepared own = knee_.prepared;
    own.model.meter = std::make_shared<EffectMeter>();
    own.steps = {step(flexion, -1, {0, 0, 1})};
    ContactField field = contact_field(own);
    const Solved solved = solve(own, field);
    note_neutral(solved, angle);
    if (!angle.solved) return angle;
    angle.steps = own.steps;
    angle.neutral = row_of(own, solved.records.back(), -1, 0);
    const State& state = solved.records.back().point.pose.state;
    for (std::size_t j = 0; j < own.model.joints.size(); ++j) own.model.joints[j].start = state.coordinates[j];
    for (const LaxityTest& test : choice_.tests) angle.curves.push_back(curve(own, test, angle));
    return angle;
  }

  /// The load is put on at the smallest angle and held while the knee bends to the largest.
  EnvelopePath envelope(const LaxityTest* test, bool positive, const std::vector<double>& flexions) const {
    EnvelopePath made;
    made.held = test == nullptr ? 0 : positive ? test->load : -test->load;
    if (test != nullptr) made.test = *test;
    const int load = test == nullptr ? -1 : knee_.loads[static_cast<std::size_t>(test->kind)];
    const int ramp = test == nullptr ? 1 : choice_.increments;
    Prepared own = knee_.prepared;
    own.model.meter = std::make_shared<EffectMeter>();
    own.steps = {step(flexions.front(), load, {0, made.held, ramp})};
    for (std::size_t k = 1; k < flexions.size(); ++k) {
      const double bend = flexions[k] - flexions[k - 1];
      const int parts = static_cast<int>(std::ceil(bend / kEnvelopeStep - kSameLoad));
      own.steps.push_back(step(flexions[k - 1], load, {made.held, made.held, parts}));
      own.steps.back().prescribed.front().to = knee_.flexion_sign * flexions[k];
    }
    made.steps = own.steps;
    ContactField field = contact_field(own);
    const Solved solved = solve(own, field);
    const auto first = static_cast<std::size_t>(ramp);
    std::size_t k = 0;
    for (; k < solved.records.size(); ++k) {
      const PoseRecord& record = solved.records[k];
      if (!record.point.solved() || record.point.branch != solved.records.front().point.branch) break;
      if (k >= first) made.rows.push_back({flexion_of(record), row_of(own, record, load, 0)});
    }
    if (k == solved.records.size() && solved.path.complete) return made;
    const End end = end_of(solved, k);
    made.ended = made.rows.empty()
                     ? fmt::format("the load is not reached at {:.4g} deg: {}", to::kDegree * flexions.front(), end.why)
                     : fmt::format("ends after {:.4g} deg: {}", to::kDegree * made.rows.back().flexion, end.why);
    return made;
  }

 private:
  double flexion_of(const PoseRecord& record) const {
    for (const auto& p : record.point.target.prescribed)
      if (p.coordinate == QuantityRef(knee_.joint, 0)) return knee_.flexion_sign * p.value;
    return 0;
  }

  StepPlan step(double flexion, int load, const Leg& leg) const {
    return laxity_step(knee_, choice_.compression, flexion, load, leg.from, leg.to, leg.increments);
  }

  Solved solve(const Prepared& own, ContactField& field) const {
    RunOptions options;
    options.cancelled = choice_.cancelled;
    options.path.locate_law_breaks = false;  // no table of the test has them
    return solve_path(own, field, options);
  }

  static void note_neutral(const Solved& solved, LaxityAngle& angle) {
    angle.solved = !solved.records.empty() && solved.records.back().point.solved();
    if (!angle.solved && !solved.records.empty()) {
      const PoseReport& report = solved.records.back().point.report;
      angle.notes.push_back(
          fmt::format("no neutral pose: {}{}{}", to_string(report.status), report.why.empty() ? "" : ": ", report.why));
    } else if (!angle.solved) {
      angle.notes.emplace_back("no neutral pose: interrupted");
    }
    for (const PathEvent& event : solved.events)
      if (event.begins_branch()) angle.notes.push_back("the joint snapped on its way to this angle: " + event.what);
    if (!angle.solved) return;
    const Stability& stability = solved.records.back().point.stability;
    if (stability.verdict == Stability::Verdict::unstable)
      angle.notes.emplace_back("the neutral pose is unstable");
    else if (stability.complex_pair)
      angle.notes.emplace_back("the neutral pose may begin to oscillate (flutter)");
  }

  /// `steps`: of the angle, before those of `own`.
  LaxityRow row_of(const Prepared& own, const PoseRecord& record, int load, std::size_t steps) const {
    LaxityRow row;
    row.record = record;
    row.record.point.step += static_cast<int>(steps);
    const GroodSuntayDef& axes = *own.scene.joints[genu::at(knee_.joint)].grood_suntay;
    const auto& poses = record.point.pose.state.poses;
    if (const auto motion = grood_suntay(axes, poses[genu::at(axes.femur.body)], poses[genu::at(axes.tibia.body)]))
      row.motion = *motion;
    if (load >= 0) row.load = record.point.target.load_factors[genu::at(load)];
    return row;
  }

  /// Poses of the legs in order, up to the first that is not solved or on another branch. `ended`: why there.
  std::vector<LaxityRow> rows_of(Prepared& own, const LaxityTest& test, LaxityAngle& angle,
                                 const std::vector<Leg>& legs, std::string& ended) const {
    const int load = knee_.loads[static_cast<std::size_t>(test.kind)];
    own.steps.clear();
    for (const Leg& leg : legs) own.steps.push_back(step(angle.flexion, load, leg));
    const std::size_t before = angle.steps.size();
    angle.steps.insert(angle.steps.end(), own.steps.begin(), own.steps.end());
    own.model.meter = std::make_shared<EffectMeter>();
    ContactField field = contact_field(own);
    const Solved solved = solve(own, field);
    Sensitivity sensitivity(own.scene, own.model);
    Parameter factor;
    factor.kind = Parameter::Kind::factor;
    factor.object = load;
    std::vector<LaxityRow> rows;
    for (const PoseRecord& record : solved.records) {
      if (!record.point.solved() || record.point.branch != solved.records.front().point.branch) break;
      rows.push_back(row_of(own, record, load, before));
      if (!sensitivity.factor(rows.back().record.point)) continue;
      sensitivity.differentiate(factor);
      if (const auto rate = sensitivity.clinical(knee_.joint)) rows.back().compliance = test.displacement(*rate);
    }
    if (rows.size() < solved.records.size() || !solved.path.complete) ended = end_words(solved, test, load, rows);
    return rows;
  }

  /// Where and why a path has no pose beyond its first `rows`.
  struct End {
    const PathEvent* event = nullptr;
    std::string why;
  };
  static End end_of(const Solved& solved, std::size_t rows) {
    End end;
    for (const PathEvent& e : solved.events) {
      const bool ends = e.begins_branch() || e.kind == PathEvent::Kind::turns_back ||
                        e.kind == PathEvent::Kind::snaps || e.kind == PathEvent::Kind::jump ||
                        e.kind == PathEvent::Kind::over_edge || e.kind == PathEvent::Kind::overlap ||
                        e.kind == PathEvent::Kind::flawed_mesh || e.kind == PathEvent::Kind::stopped;
      if (ends && end.event == nullptr && e.rows_before >= static_cast<int>(rows)) end.event = &e;
    }
    if (end.event != nullptr) end.why = to_string(end.event->kind);
    if (rows < solved.records.size() && !solved.records[rows].point.solved()) {
      const PoseReport& report = solved.records[rows].point.report;
      end.why = report.why.empty() ? std::string(to_string(report.status)) : report.why;
    } else if (end.event != nullptr && !end.event->what.empty()) {
      end.why += ": " + end.event->what;
    }
    if (rows >= solved.records.size() && end.event == nullptr) end.why = "interrupted";
    return end;
  }

  /// "anterior ends at 80.4 N, after 12.1 mm at 80 N: the equilibrium path turns back (limit point)"
  static std::string end_words(const Solved& solved, const LaxityTest& test, int load,
                               const std::vector<LaxityRow>& rows) {
    const End end = end_of(solved, rows.size());
    const double last = rows.empty() ? 0 : rows.back().load;
    const double at = end.event ? end.event->target.load_factors[genu::at(load)] : last;
    std::string pose;
    if (!rows.empty()) {
      const double shift = test.displacement(rows.back().motion) - test.displacement(rows.front().motion);
      pose = fmt::format(", after {:.4g} {} at {:.4g} {}", test.shown() * shift, test.unit(), last, test.load_unit());
    }
    return fmt::format("{} ends at {:.4g} {}{}: {}", test.direction(at >= 0), at, test.load_unit(), pose, end.why);
  }

  LaxityCurve curve(Prepared& own, const LaxityTest& test, LaxityAngle& angle) const {
    LaxityCurve made;
    made.test = test;
    const int n = choice_.increments;
    const double full = test.load;
    std::string ended;
    std::vector<Leg> legs = {{0, full, n}};
    if (choice_.back) legs.insert(legs.end(), {{full, -full, 2 * n}, {-full, 0, n}});
    made.rows = rows_of(own, test, angle, legs, ended);
    if (!ended.empty()) made.ended.push_back(ended);
    if (made.rows.empty()) return made;
    // A path that ended before it came back to zero has not seen the other direction.
    if (choice_.back && (ended.empty() || made.rows.size() > 2 * static_cast<std::size_t>(n))) return made;
    ended.clear();
    legs = {{0, -full, n}};
    if (choice_.back) legs.push_back({-full, 0, n});
    const auto other = rows_of(own, test, angle, legs, ended);
    if (!ended.empty()) made.ended.push_back(ended);
    made.rows.insert(made.rows.end(), other.begin() + (other.empty() ? 0 : 1), other.end());
    return made;
  }

  const LaxityJoint& knee_;
  const LaxityChoice& choice_;
};

}  // namespace

std::vector<LaxityAngle> solve_laxity(const LaxityJoint& knee, const LaxityChoice& choice) {
  std::vector<LaxityAngle> angles(choice.flexions.size());
  const LaxityTester tester(knee, choice);
  tbb::parallel_for(std::size_t{0}, angles.size(), [&](std::size_t k) { angles[k] = tester.test(choice.flexions[k]); });
  return angles;
}

std::vector<EnvelopePath> solve_envelope(const LaxityJoint& knee, const LaxityChoice& choice) {
  std::vector<double> flexions = choice.flexions;
  std::sort(flexions.begin(), flexions.end());
  flexions.erase(std::unique(flexions.begin(), flexions.end()), flexions.end());
  std::vector<EnvelopePath> paths(1 + 2 * choice.tests.size());
  const LaxityTester tester(knee, choice);
  tbb::parallel_for(std::size_t{0}, paths.size(), [&](std::size_t k) {
    paths[k] = tester.envelope(k == 0 ? nullptr : &choice.tests[(k - 1) / 2], k % 2 == 1, flexions);
  });
  return paths;
}

}  // namespace genu
