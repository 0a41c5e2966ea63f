#include "genu/study/laxity.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "genu/assemble/changed_scene.h"
#include "genu/assemble/with_numbers.h"
#include "genu/core/atomic_output.h"
#include "genu/core/timer.h"
#include "genu/core/units.h"
#include "genu/equilibrium/sensitivity.h"
#include "genu/results/summary.h"
#include "genu/study/laxity_doubts.h"
#include "genu/study/laxity_table.h"
#include "genu/study/run_scene.h"
#include "genu/study/solve_path.h"
#include "genu/study/tolerances.h"

namespace genu {

namespace {

/// A part of a path: the load of the test from one value to another.
struct Leg {
  double from, to;  ///< N or N m
  int increments;
};

class Tester {
 public:
  Tester(const LaxityJoint& knee, const LaxityChoice& choice) : knee_(knee), choice_(choice) {}

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

 private:
  StepPlan step(double flexion, int load, const Leg& leg) const {
    return laxity_step(knee_, choice_.compression, flexion, load, leg.from, leg.to, leg.increments);
  }

  Solved solve(const Prepared& own, ContactField& field) const {
    RunOptions options;
    options.cancelled = choice_.cancelled;
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

  /// "anterior: ends at 80.4 N, 12.1 mm: the equilibrium path turns back (limit point)"
  static std::string end_words(const Solved& solved, const LaxityTest& test, int load,
                               const std::vector<LaxityRow>& rows) {
    const PathEvent* event = nullptr;
    for (const PathEvent& e : solved.events) {
      const bool ends = e.begins_branch() || e.kind == PathEvent::Kind::turns_back ||
                        e.kind == PathEvent::Kind::snaps || e.kind == PathEvent::Kind::jump ||
                        e.kind == PathEvent::Kind::over_edge || e.kind == PathEvent::Kind::overlap ||
                        e.kind == PathEvent::Kind::flawed_mesh || e.kind == PathEvent::Kind::stopped;
      if (ends && event == nullptr && e.rows_before >= static_cast<int>(rows.size())) event = &e;
    }
    const double last = rows.empty() ? 0 : rows.back().load;
    const double at = event ? event->target.load_factors[genu::at(load)] : last;
    const std::size_t k = rows.size();
    std::string why = event ? std::string(to_string(event->kind)) : "";
    if (k < solved.records.size() && !solved.records[k].point.solved()) {
      const PoseReport& report = solved.records[k].point.report;
      why = report.why.empty() ? std::string(to_string(report.status)) : report.why;
    } else if (event && !event->what.empty()) {
      why += ": " + event->what;
    }
    if (rows.size() >= solved.records.size() && !event) why = "interrupted";
    std::string pose;
    if (!rows.empty()) {
      const double shift = test.displacement(rows.back().motion) - test.displacement(rows.front().motion);
      pose = fmt::format(", after {:.4g} {} at {:.4g} {}", test.shown() * shift, test.unit(), last, test.load_unit());
    }
    return fmt::format("{} ends at {:.4g} {}{}: {}", test.direction(at >= 0), at, test.load_unit(), pose, why);
  }

  LaxityCurve curve(Prepared& own, const LaxityTest& test, LaxityAngle& angle) const {
    LaxityCurve made;
    made.test = test;
    const int n = choice_.increments;
    const double full = test.load;
    std::string ended;
    made.rows = rows_of(own, test, angle, {{0, full, n}, {full, -full, 2 * n}, {-full, 0, n}}, ended);
    if (!ended.empty()) made.ended.push_back(ended);
    // A path that ended before it came back to zero has not seen the other direction.
    if (ended.empty() || made.rows.empty() || made.rows.size() > 2 * static_cast<std::size_t>(n)) return made;
    ended.clear();
    const auto back = rows_of(own, test, angle, {{0, -full, n}, {-full, 0, n}}, ended);
    if (!ended.empty()) made.ended.push_back(ended);
    made.rows.insert(made.rows.end(), back.begin() + (back.empty() ? 0 : 1), back.end());
    return made;
  }

  const LaxityJoint& knee_;
  const LaxityChoice& choice_;
};

}  // namespace

std::vector<LaxityAngle> solve_laxity(const LaxityJoint& knee, const LaxityChoice& choice) {
  std::vector<LaxityAngle> angles(choice.flexions.size());
  const Tester tester(knee, choice);
  tbb::parallel_for(std::size_t{0}, angles.size(), [&](std::size_t k) { angles[k] = tester.test(choice.flexions[k]); });
  return angles;
}

namespace {

/// The steps that were solved take the place of the scene's own.
void take_steps(LaxityOfScene& tested) {
  std::vector<StepPlan> all;
  for (LaxityAngle& angle : tested.angles) {
    const int before = static_cast<int>(all.size());
    angle.neutral.record.point.step += before;
    for (LaxityCurve& curve : angle.curves)
      for (LaxityRow& row : curve.rows) row.record.point.step += before;
    all.insert(all.end(), angle.steps.begin(), angle.steps.end());
  }
  tested.knee.prepared.steps = std::move(all);
}

std::optional<LaxityOfScene> test_scene(const Prepared& prepared, const std::string& name, const LaxityChoice& choice,
                                        Diagnostics& out) {
  ContactField field(prepared.model);
  if (!check_start(prepared, field, out)) return std::nullopt;
  auto knee = with_laxity_loads(prepared, out);
  if (!knee) return std::nullopt;
  share_search(knee->prepared);
  LaxityOfScene tested{name, std::move(*knee), {}};
  tested.angles = solve_laxity(tested.knee, choice);
  take_steps(tested);
  return tested;
}

/// Sentences for everything that is missing or doubtful; the first says how much there is. `code`: kExitOk,
/// kExitDoubtful or kExitIncomplete.
std::vector<std::string> verdict_of(const std::vector<LaxityOfScene>& scenes, const std::vector<LaxityTest>& tests,
                                    int& code) {
  std::vector<std::string> sentences = {""};
  std::size_t asked = 0, whole = 0;
  for (const LaxityOfScene& s : scenes) {
    for (const LaxityAngle& angle : s.angles) {
      const std::string place = fmt::format("{}{:g} deg", scenes.size() > 1 ? s.name + ", " : "",
                                            std::round(1e9 * to::kDegree * angle.flexion) / 1e9);
      asked += tests.size();
      for (const std::string& note : angle.notes) sentences.push_back(place + ": " + note + ".");
      for (const LaxityCurve& curve : angle.curves) {
        whole += curve.ended.empty() ? 1 : 0;
        for (const std::string& ended : curve.ended) sentences.push_back(place + ", " + ended + ".");
      }
    }
    for (const std::string& doubt : laxity_doubts(s))
      sentences.push_back((scenes.size() > 1 ? s.name + ": " : "") + doubt + ".");
  }
  const bool doubtful = sentences.size() > 1;
  std::string freed;
  for (const std::string& name : scenes.front().knee.freed) freed += (freed.empty() ? "" : ", ") + name;
  if (!freed.empty()) sentences.push_back("Free in this test, prescribed in the scene's last step: " + freed + ".");
  const auto bends_sideways = [](const LaxityTest& test) { return test.kind == LaxityTest::Kind::varus; };
  if (!scenes.front().knee.floating && std::any_of(tests.begin(), tests.end(), bends_sideways))
    sentences.emplace_back(
        "The varus moment acts about the tibia's anterior axis, not the floating axis: the joint's rotations are not "
        "flexion, adduction and rotation about the tibia's long axis, in this order.");
  code = whole < asked ? kExitIncomplete : doubtful ? kExitDoubtful : kExitOk;
  sentences.front() = whole < asked
                          ? fmt::format("{} of {} curves are complete.", whole, asked)
                          : fmt::format("All {} curves are complete{}.", asked, doubtful ? ", with doubts" : "");
  return sentences;
}

RunSummary summary_of(const LaxityResult& result, const LaxityChoice& choice, double seconds, int exit_code) {
  const LaxityOfScene& last = result.scenes.back();
  RunSummary summary = begin_summary(last.knee.prepared);
  const std::size_t curves = result.scenes.size() * choice.flexions.size() * choice.tests.size();
  summary.poses_asked = static_cast<int>(curves) * (1 + 4 * choice.increments);  // up, down, further down, back
  for (const LaxityOfScene& s : result.scenes)
    for (const LaxityAngle& angle : s.angles)
      for (const LaxityCurve& curve : angle.curves)
        for (const LaxityRow& row : curve.rows) {
          const PosePoint& point = row.record.point;
          ++summary.poses_solved;
          summary.poses_stable += point.stability.verdict == Stability::Verdict::stable ? 1 : 0;
          summary.iterations += point.report.iterations;
          summary.worst_residual = std::max(summary.worst_residual, point.report.certificate.residual);
        }
  summary.verdict = result.verdict;
  summary.verdict_class = exit_code == kExitOk         ? RunSummary::Class::solved
                          : exit_code == kExitDoubtful ? RunSummary::Class::doubtful
                                                       : RunSummary::Class::not_solved;
  summary.exit_code = exit_code;
  summary.seconds.emplace_back("laxity", seconds);
  note_files(last.knee.prepared, summary);
  return summary;
}

std::string write_laxity(const std::string& folder, const LaxityResult& result, const LaxityChoice& choice,
                         const RunSummary& summary) {
  StagedFolder out("results");
  std::string error = text_of(out.open(folder));
  const auto write = [&](const std::string& name, const std::string& content) {
    if (error.empty()) error = write_file_atomically(out.path() / name, content);
  };
  write("laxity.csv", laxity_csv(result.scenes));
  write("laxity_summary.csv", laxity_summary(result.scenes).to_csv());
  std::string pictures;
  for (const LaxityTest& test : choice.tests) {
    const std::string picture = to_svg(laxity_chart(result, choice, test));
    pictures += picture;
    write(std::string(test.name()) + ".svg", picture);
  }
  write("laxity.html", laxity_page(result, pictures));
  write("summary.json", to_json(summary));
  if (error.empty()) error = out.commit();
  return error;
}

}  // namespace

int test_laxity(const Prepared& prepared, const LaxityChoice& choice, Diagnostics& out, LaxityResult& result) {
  auto tested = test_scene(prepared, "as written", choice, out);
  if (!tested) return kExitRefused;
  result.scenes.push_back(std::move(*tested));
  int code = kExitOk;
  result.title = prepared.scene.title;
  result.verdict = verdict_of(result.scenes, choice.tests, code);
  result.text = laxity_text(result.scenes);
  return code == kExitDoubtful ? kExitOk : code;
}

int run_laxity(const SceneSource& source, const std::optional<std::string>& folder, const LaxityChoice& choice,
               Diagnostics& out, LaxityResult& result) {
  const Timer timer;
  const auto prepared = prepare_run(source, folder, out);
  if (!prepared) return kExitRefused;
  if (!source.changes.empty()) {
    Diagnostics said;  // warnings are said once
    auto scene = read_changed_scene(source.path, prepared->meshes->files(), said);
    const auto written = scene ? prepare(std::move(*scene), prepared->meshes, said) : std::nullopt;
    if (!written) {
      for (const Diagnostic& d : said.items()) out.add(d);
      return kExitRefused;
    }
    auto tested = test_scene(*written, "as written", choice, out);
    if (!tested) return kExitRefused;
    result.scenes.push_back(std::move(*tested));
  }
  const std::string name = source.changes.empty() ? "as written" : words_of(source.changes);
  auto tested = test_scene(*prepared, name, choice, out);
  if (!tested) return kExitRefused;
  result.scenes.push_back(std::move(*tested));
  int code = kExitOk;
  result.title = prepared->scene.title;
  result.verdict = verdict_of(result.scenes, choice.tests, code);
  result.text = laxity_text(result.scenes);
  if (!folder) return code;
  RunSummary summary = summary_of(result, choice, timer.seconds(), code);
  RunOptions options;
  options.cancelled = choice.cancelled;
  result.folder = folder_for(*folder, options, summary);
  result.verdict = summary.verdict;
  const std::string error = write_laxity(result.folder, result, choice, summary);
  if (error.empty()) return code;
  out.error(Code::cannot_write, {}, error);
  return kExitFailed;
}

}  // namespace genu
