// A run from the scene to the folder: what is refused, what is kept of work that was stopped, what is removed after it.
#include <algorithm>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "genu/appraise/place.h"
#include "genu/assemble/surface_variants.h"
#include "genu/assemble/with_numbers.h"
#include "genu/core/atomic_output.h"
#include "genu/core/counted.h"
#include "genu/core/file_list.h"
#include "genu/core/file_text.h"
#include "genu/core/timer.h"
#include "genu/results/motion_table.h"
#include "genu/results/pressure_map.h"
#include "genu/store/checkpoint.h"
#include "genu/store/input_hash.h"
#include "genu/store/report.h"
#include "genu/store/report_beside.h"
#include "genu/store/stop_of.h"
#include "genu/study/anatomy_doubts.h"
#include "genu/study/failure.h"
#include "genu/study/run_motion.h"
#include "genu/study/run_scene.h"

namespace genu {
namespace {

/// Not one pose, because contact leans on a flaw of a mesh from the start: the input is to blame.
bool refused_for_flaws(const Prepared& prepared, const Solution& found, Diagnostics& out) {
  if (found.summary.poses_solved > 0 || found.records.empty()) return false;
  const PoseReport& first = found.records.front().point.report;
  if (first.status != PoseStatus::flawed_mesh) return false;
  out.error(Code::mesh_flawed, prepared.scene.file,
            first.why + ": no pose can be trusted. Repair the mesh (genu mesh-check FILE --repair OUT)");
  return true;
}

}  // namespace

std::optional<Solution> solve_all(const Prepared& prepared, const RunOptions& options, Diagnostics& out) {
  const Timer timer;
  ContactField field = contact_field(prepared);
  if (!check_start(prepared, field, out)) return std::nullopt;
  const double search_seconds = timer.seconds();
  Solution found = solve(prepared, field, options);
  if (refused_for_flaws(prepared, found, out)) return std::nullopt;
  auto& stages = found.summary.seconds;
  stages.insert(std::find_if(stages.begin(), stages.end(), [](const auto& s) { return s.first == "solving"; }),
                {"preparing contact search", search_seconds});
  if (!found.stopped.empty()) return found;
  found.stopped = stop_of([&] {
    if (options.starts > 0) {
      const Timer searching;
      found.starts = find_equilibria(prepared, field, options, found);
      found.summary.seconds.emplace_back("searching from starts", searching.seconds());
    }
    if (options.error_bars && has_meshes(prepared)) {
      const Timer varying;
      found.error_bars = find_error_bars(prepared, options, found);
      found.summary.seconds.emplace_back("error bars", varying.seconds());
    }
  });
  if (found.stopped.empty() && asked_to_stop(options.cancelled)) found.stopped = "interrupted";
  found.summary.partial = !found.stopped.empty();
  return found;
}

std::optional<Solution> move_all(const Prepared& prepared, const RunOptions& options, Diagnostics& out) {
  if (!check_motion_options(prepared, options, out)) return std::nullopt;
  if (options.resume)
    out.add(warning_at({prepared.scene.file}, Code::cannot_resume, "dynamics", {},
                       "a motion is computed again from its start: its integrator cannot continue with the same bits"));
  Solution found = solve_motion(prepared, options);
  if (found.stopped.empty() && refused_start(prepared, found, out)) return std::nullopt;
  return found;
}

namespace {

/// Files in the folder that genu did not write and that the run will write: said before anything is computed.
bool holds_others(const std::string& folder, const RunOptions& options, Diagnostics& out) {
  const auto list = read_file_list(folder);
  if (!list) return false;
  std::vector<std::string> names = {"results.csv", "events.csv", "curves.svg", "summary.json"};
  if (options.report) names.emplace_back("report.html");
  if (options.starts > 0) names.emplace_back("starts.csv");
  if (options.error_bars) names.insert(names.end(), {"error_bars.csv", "error_shares.csv"});
  bool any = false;
  for (const std::string& file : not_listed(folder, *list)) {
    if (std::find(names.begin(), names.end(), file) == names.end()) continue;
    out.error(Code::would_overwrite, (std::filesystem::path(folder) / file).string(),
              "was not written by genu and would be replaced: move it, or choose another folder");
    any = true;
  }
  return any;
}

/// The table of options.beside, held against the columns of a results.csv without rows; none where it is not wanted.
/// Empty where it is refused in `out`.
std::optional<std::vector<ReportBeside>> beside_of(const Prepared& p, const RunOptions& options, Diagnostics& out) {
  if (options.beside.empty()) return std::vector<ReportBeside>();
  const ResultTable names =
      p.scene.dynamics ? motion_table(p.scene, p.model, {}) : pose_table(p.scene, p.model, p.steps, {});
  auto table = read_beside(options.beside, options.beside_columns, names.columns(), out);
  if (!table) return std::nullopt;
  return std::vector<ReportBeside>{std::move(*table)};
}

/// " --without 'ACL*' --set 'AAC.stiffness=x0.5'"
std::string options_of(const SceneChanges& changes) {
  std::string words;
  for (const std::string& pattern : changes.without) words += " --without " + shell_word(pattern);
  for (const std::string& option : changes.set) words += " --set " + shell_word(option);
  return words;
}

/// What its scene was warned of, as sentences of the verdict: a report outlives what was printed. The layout of the
/// bones decides what angles mean and is said in full.
std::vector<std::string> warned_of(const std::string& scene, const SceneChanges& changes, const Diagnostics& out) {
  constexpr std::size_t kNamed = 5;
  std::vector<std::string> sentences, keys;
  std::size_t others = 0;
  for (const Diagnostic& d : out.items()) {
    if (d.severity != Diagnostic::Severity::warning || d.file != scene || d.key.empty()) continue;
    if (d.code == Code::layout) {
      sentences.push_back(fmt::format("{}: {}", d.key, as_sentence(d.rule)));
      continue;
    }
    ++others;
    if (keys.size() <= kNamed && std::find(keys.begin(), keys.end(), d.key) == keys.end()) keys.push_back(d.key);
  }
  if (others == 0) return sentences;
  if (keys.size() > kNamed) keys.back() = "...";
  sentences.push_back(fmt::format("The scene has {} ({}): `genu check{}` says what they are.",
                                  counted(others, sentences.empty() ? "warning" : "more warning"),
                                  fmt::join(keys, ", "), options_of(changes)));
  return sentences;
}

/// Writes what was found where it belongs. The exit code.
int keep_results(const Prepared& prepared, const std::string& folder, const RunOptions& options, Checkpoint& checkpoint,
                 std::vector<ReportBeside> beside_tables, Diagnostics& out, Solution& found) {
  const bool partial = found.summary.partial;
  if (partial) mark_partial(prepared.scene.file, folder, prepared.scene.dynamics ? nullptr : &checkpoint, found);
  found.folder = partial ? beside(folder, ".partial") : folder;
  auto more = options.pressure_maps ? pressure_maps(prepared.scene, prepared.model, found.records)
                                    : std::vector<std::pair<std::string, std::string>>();
  for (const auto& [name, content] : more) found.pressure_files.push_back(name);
  const bool memory = !partial || found.stopped == "interrupted";  // else there may be none left for a page
  if (options.report && memory) add_report(prepared, found, more, {}, std::move(beside_tables));
  std::string error = write_results(found.folder, prepared, found, more, partial ? ".partial" : "");
  if (!error.empty()) {
    if (partial)
      found.summary.verdict.front() = fmt::format("PARTIAL: {} after {} of {} rows, which could not be written.",
                                                  found.stopped, found.poses.rows(), found.summary.poses_asked);
    error += checkpoint.rows() > 0 ? fmt::format(
                                         "; {} rows are kept in {}: the same command with --resume continues "
                                         "from there",
                                         checkpoint.rows(), checkpoint.file())
                                   : "; no row of this run is kept, earlier results are untouched";
    out.error(Code::cannot_write, {}, error);
    return kExitFailed;
  }
  if (partial) return found.stopped == "interrupted" ? kExitIncomplete : kExitFailed;
  checkpoint.remove();
  remove_listed(beside(folder, ".partial"), "results");
  return found.summary.exit_code;
}

}  // namespace

void mark_partial(const std::string& scene, const std::string& folder, const Checkpoint* checkpoint, Solution& found) {
  RunSummary& s = found.summary;
  s.exit_code = found.stopped == "interrupted" ? kExitIncomplete : kExitFailed;
  const std::size_t rows = checkpoint != nullptr ? checkpoint->rows() : 0;
  std::string said = fmt::format("PARTIAL: {} after {} of {} rows, which are kept in {}. ", found.stopped,
                                 found.poses.rows(), s.poses_asked, beside(folder, ".partial"));
  std::string goes_on = "computes them again";
  if (rows > 0)
    goes_on = fmt::format("continues from row {} and ends with the bytes of an undisturbed run", rows);
  else if (checkpoint != nullptr && checkpoint->earlier())
    goes_on = fmt::format("continues from the rows of an earlier run in {}", checkpoint->file());
  said += fmt::format("genu run {}{} --out {} --resume {}.", shell_word(scene), options_of(s.changed.asked),
                      shell_word(folder), goes_on);
  if (checkpoint != nullptr && !checkpoint->problem().empty())
    said += fmt::format(" {} cannot be written: {}.", checkpoint->file(), checkpoint->problem());
  s.verdict.insert(s.verdict.begin(), said);
}

int run_scene(const SceneSource& source, const std::string& folder, const RunOptions& options, Diagnostics& out,
              Solution* solution) {
  if (!options.save_failure.empty())
    if (const auto kept = why_not_replaced(options.save_failure, "\"genu_failure\":")) {
      out.error(kept->code, {}, kept->text);
      return kExitRefused;
    }
  const auto prepared = prepare_run(source, folder, out);
  if (!prepared) {
    if (!options.save_failure.empty()) save_failure(options.save_failure, source.path, nullptr, {}, options, out);
    return kExitRefused;
  }
  warn_about_anatomy(*prepared, out);
  const std::vector<std::string> warned = warned_of(prepared->scene.file, source.changes, out);
  auto beside_tables = beside_of(*prepared, options, out);
  if (!beside_tables || holds_others(folder, options, out)) return kExitRefused;
  auto inputs = input_hashes(prepared->scene, prepared->meshes->files());
  inputs.emplace_back("what --without and --set change", change_hash(prepared->scene));
  Checkpoint checkpoint(folder, std::move(inputs), options.checkpoint_seconds);
  RunOptions own = options;
  own.keep_partial = true;
  own.keep_rest = !options.save_failure.empty();
  const bool moves = prepared->scene.dynamics.has_value();
  if (!moves) own.checkpoint = &checkpoint;
  if (options.resume && !moves && !checkpoint.resume(out)) return kExitRefused;
  if (const std::string why = moves ? std::string() : checkpoint.blocked(); !why.empty())
    out.warning(Code::cannot_write, checkpoint.file(), why + ": the rows of this run are not kept there");
  auto found = moves ? move_all(*prepared, own, out) : solve_all(*prepared, own, out);
  if (found) found->summary.verdict.insert(found->summary.verdict.end(), warned.begin(), warned.end());
  int code = kExitRefused;
  if (found) code = keep_results(*prepared, folder, own, checkpoint, std::move(*beside_tables), out, *found);
  if (!options.save_failure.empty() && !(found && found->stopped == "interrupted"))
    save_failure(options.save_failure, source.path, &*prepared, found ? *found : Solution(), options, out);
  if (found && solution != nullptr) *solution = std::move(*found);
  return code;
}

}  // namespace genu
