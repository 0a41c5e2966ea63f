#include "genu/study/laxity.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/assemble/changed_scene.h"
#include "genu/assemble/refuse_option.h"
#include "genu/assemble/with_numbers.h"
#include "genu/core/atomic_output.h"
#include "genu/core/timer.h"
#include "genu/core/units.h"
#include "genu/results/summary.h"
#include "genu/study/envelope_table.h"
#include "genu/study/laxity_doubts.h"
#include "genu/study/laxity_solve.h"
#include "genu/study/laxity_table.h"
#include "genu/study/run_scene.h"

namespace genu {

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
  for (EnvelopePath& path : tested.envelope) {
    for (EnvelopePath::Row& row : path.rows) row.pose.record.point.step += static_cast<int>(all.size());
    all.insert(all.end(), path.steps.begin(), path.steps.end());
  }
  tested.knee.prepared.steps = std::move(all);
}

std::optional<LaxityOfScene> test_scene(const Prepared& prepared, const std::string& name, const LaxityChoice& choice,
                                        Diagnostics& out) {
  ContactField field(prepared.model);
  if (!check_start(prepared, field, out)) return std::nullopt;
  const auto [least, most] = std::minmax_element(choice.flexions.begin(), choice.flexions.end());
  if (choice.envelope && !(*most > *least)) {
    out.add(error_at({}, Code::conflict, "--envelope", {},
                     "needs two angles or more in --at: the knee bends between them"));
    return std::nullopt;
  }
  auto knee = with_laxity_loads(prepared, out);
  if (!knee) return std::nullopt;
  share_search(knee->prepared);
  LaxityOfScene tested{name, std::move(*knee), {}, {}};
  tested.angles = solve_laxity(tested.knee, choice);
  if (choice.envelope) tested.envelope = solve_envelope(tested.knee, choice);
  take_steps(tested);
  return tested;
}

/// Sentences for everything that is missing or doubtful; the first says how much there is. `code`: kExitOk,
/// kExitDoubtful or kExitIncomplete.
std::vector<std::string> verdict_of(const std::vector<LaxityOfScene>& scenes, const std::vector<LaxityTest>& tests,
                                    int& code) {
  std::vector<std::string> sentences = {""};
  std::size_t asked = 0, whole = 0;
  int cut = 0;  // paths of envelopes that end early
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
    for (const std::string& note : envelope_notes(s, cut))
      sentences.push_back((scenes.size() > 1 ? s.name + ": " : "") + note);
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
  code = whole < asked || cut > 0 ? kExitIncomplete : doubtful ? kExitDoubtful : kExitOk;
  sentences.front() = whole < asked
                          ? fmt::format("{} of {} curves are complete.", whole, asked)
                          : fmt::format("All {} curves are complete{}.", asked, doubtful ? ", with doubts" : "");
  if (cut > 0)
    sentences.front() +=
        fmt::format(" {} path{} of envelopes end{} early.", cut, cut == 1 ? "" : "s", cut == 1 ? "s" : "");
  return sentences;
}

RunSummary summary_of(const LaxityResult& result, const LaxityChoice& choice, double seconds, int exit_code) {
  const LaxityOfScene& last = result.scenes.back();
  RunSummary summary = begin_summary(last.knee.prepared);
  const std::size_t curves = result.scenes.size() * choice.flexions.size() * choice.tests.size();
  summary.poses_asked = static_cast<int>(curves) * (1 + 4 * choice.increments);  // up, down, further down, back
  const auto count = [&](const PosePoint& point) {
    ++summary.poses_solved;
    summary.poses_stable += point.stability.verdict == Stability::Verdict::stable ? 1 : 0;
    summary.iterations += point.report.iterations;
    summary.worst_residual = std::max(summary.worst_residual, point.report.certificate.residual);
  };
  for (const LaxityOfScene& s : result.scenes) {
    for (const LaxityAngle& angle : s.angles)
      for (const LaxityCurve& curve : angle.curves)
        for (const LaxityRow& row : curve.rows) count(row.record.point);
    for (const EnvelopePath& path : s.envelope) {
      summary.poses_asked += 1;
      for (std::size_t k = 1; k < path.steps.size(); ++k) summary.poses_asked += path.steps[k].increments;
      for (const EnvelopePath::Row& row : path.rows) count(row.pose.record.point);
    }
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
  if (choice.envelope) write("envelope.csv", envelope_rows(result.scenes).to_csv());
  std::string pictures;
  for (const LaxityTest& test : choice.tests) {
    const std::string picture = to_svg(laxity_chart(result, choice, test));
    pictures += picture;
    write(std::string(test.name()) + ".svg", picture);
    if (!choice.envelope) continue;
    const std::string envelope = to_svg(envelope_chart(result, test));
    pictures += envelope;
    write(std::string("envelope-") + test.name() + ".svg", envelope);
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
  if (choice.envelope) result.text += "\n" + envelope_text(result.scenes, choice);
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
  if (choice.envelope) result.text += "\n" + envelope_text(result.scenes, choice);
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
