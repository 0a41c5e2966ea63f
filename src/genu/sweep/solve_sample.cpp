#include "genu/sweep/solve_sample.h"

#include <cmath>

#include <fmt/format.h>

#include "genu/appraise/appraise.h"
#include "genu/assemble/changed_scene.h"
#include "genu/assemble/with_numbers.h"
#include "genu/results/columns.h"
#include "genu/study/run_motion.h"
#include "genu/study/solve_path.h"
#include "genu/sweep/statistics.h"

namespace genu {
namespace {

/// The first error of many, as the reason of a row.
std::string first_error(const Diagnostics& found) {
  for (const Diagnostic& d : found.items())
    if (d.severity == Diagnostic::Severity::error) return (d.key.empty() ? d.file : d.key) + " " + d.rule;
  return "cannot be prepared";
}

std::optional<Prepared> scene_with(const Sweep& sweep, const SweepCase& in, std::uint64_t sample,
                                   const std::vector<double>& draws, Diagnostics& found) {
  if (in.factors.prepares_anew()) {
    auto scene = read_changed_scene(source_of_sample(sweep, in, sample), in.prepared.meshes->files(), found);
    if (!scene) return std::nullopt;
    const auto drawn = draw_meshes(in.prepared, mesh_draws(in, draws), found);
    if (!drawn) return std::nullopt;
    const std::string label = fmt::format("sample {} in {}/{}", sample, in.scene, in.what_if);
    return prepare_with_meshes(std::move(*scene), in.prepared, *drawn, label, found);
  }
  std::vector<NewNumber> numbers;
  for (std::size_t f = 0; f < draws.size(); ++f)
    for (const VariedNumber& number : in.factors.numbers[f])
      numbers.emplace_back(*number.parameter,
                           number.unit * number_at(number, sweep.def.vary[sweep.factors[f].vary].how, draws[f]));
  return with_numbers(in.prepared, numbers, found);
}

/// Why a path ended before its end.
std::string why_not_solved(const SweepCase& in, const Solved& solved) {
  for (const PoseRecord& record : solved.records) {
    if (record.point.solved()) continue;
    const PoseReport& report = record.point.report;
    std::string where;
    for (const auto& p : record.point.target.prescribed)
      if (coordinate_column(in.prepared.scene, p.coordinate) == in.main.column)
        where = fmt::format(" at {} = {:.6g}", in.main.column, shown_value(p.coordinate, p.value));
    return (report.why.empty() ? to_string(report.status) : report.why) + where;
  }
  return fmt::format("the path ended after {} of {} poses", solved.records.size(), solved.asked);
}

/// The sentence of a motion's verdict that is the reason of its class. Of a motion that came to its end the first says
/// so, and the second that its energies do not balance.
std::string why_not_solved(const RunSummary& s) {
  if (s.verdict_class == RunSummary::Class::solved || s.verdict.empty()) return {};
  const bool to_its_end = s.poses_solved == s.poses_asked && s.verdict_class == RunSummary::Class::not_solved;
  return s.verdict[to_its_end && s.verdict.size() > 1 ? 1 : 0];
}

void count_jumps(const SweepCase& in, const std::vector<PathEvent>& events, SampleResult& result) {
  for (const PathEvent& event : events) {
    if (!event.begins_branch() || result.jumps++ > 0) continue;
    for (const auto& p : event.target.prescribed)
      if (coordinate_column(in.prepared.scene, p.coordinate) == in.main.column)
        result.jump_at = shown_value(p.coordinate, p.value);
  }
}

void solve_steps(const Prepared& prepared, const SweepCase& in, const RunOptions& options, const Sweep& sweep,
                 SampleResult& result) {
  ContactField field = contact_field(prepared);
  Diagnostics found;
  if ((in.factors.prepares_anew() || in.factors.moves_start()) && !check_start(prepared, field, found)) {
    result.verdict = "refused";
    result.reason = first_error(found);
    return;
  }
  const Solved solved = solve_path(prepared, field, options);
  ResultTable table = pose_table(prepared.scene, prepared.model, prepared.steps, solved.records);
  result.kept = kept_values(sweep.kept, in.main, table, solved.complete());
  count_jumps(in, solved.events, result);
  const std::vector<std::string> doubts = doubts_of(prepared, solved, table);
  RunSummary summary;
  summary.exit_code = solved.complete() ? kExitOk : kExitIncomplete;
  classify(doubts, !prepared.facing.empty(), summary);
  result.verdict = to_string(summary.verdict_class);
  if (!solved.complete())
    result.reason = why_not_solved(in, solved);
  else if (summary.verdict_class != RunSummary::Class::solved)
    result.reason = doubts.empty() ? prepared.facing.front() : doubts.front();
  if (!sweep.def.tables.empty()) result.table = std::move(table);
}

void solve_dynamics(const Prepared& prepared, const SweepCase& in, const RunOptions& options, const Sweep& sweep,
                    SampleResult& result) {
  Solution found = solve_motion(prepared, options);
  const bool complete = found.summary.verdict_class != RunSummary::Class::not_solved;
  result.kept = kept_values(sweep.kept, in.main, found.poses, complete);
  result.verdict = to_string(found.summary.verdict_class);
  result.reason = why_not_solved(found.summary);
  if (!sweep.def.tables.empty()) result.table = std::move(found.poses);
}

}  // namespace

std::optional<SampleResult> solve_sample(const Sweep& sweep, const SweepCase& in, std::uint64_t sample,
                                         const Cancelled& cancelled) {
  SampleResult result;
  result.draws = sweep.design.draws(sample);
  result.jump_at = kNoNumber;
  result.kept.assign(sweep.kept.size(), kNoNumber);
  Diagnostics found;
  const auto prepared = scene_with(sweep, in, sample, result.draws, found);
  if (!prepared) {
    result.verdict = "refused";
    result.reason = first_error(found);
    return result;
  }
  RunOptions options;
  options.cancelled = options.path.newton.cancelled = cancelled;
  if (prepared->scene.dynamics)
    solve_dynamics(*prepared, in, options, sweep, result);
  else
    solve_steps(*prepared, in, options, sweep, result);
  if (asked_to_stop(cancelled)) return std::nullopt;
  return result;
}

}  // namespace genu
