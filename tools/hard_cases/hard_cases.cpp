#include "hard_cases/hard_cases.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "genu/core/scratch_folder.h"
#include "genu/core/timer.h"
#include "genu/scene/reader.h"
#include "hard_cases/hard_case_check.h"
#include "hard_cases/hard_case_mesh.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

/// The scene and its meshes in `folder`. Returns what went wrong, else an empty text.
std::string lay_out(const HardCase& hard_case, const std::string& shapes_folder, const fs::path& folder) {
  std::error_code failed;
  fs::copy_file(hard_case.scene_file, folder / "scene.toml", fs::copy_options::overwrite_existing, failed);
  if (failed) return hard_case.scene_file + " cannot be copied: " + failed.message();
  if (hard_case.expected.meshes.empty()) return {};
  Diagnostics problems;
  const auto shapes = read_surface_file(shapes_folder + "/shapes.toml", problems);
  if (!shapes) return problems.items().empty() ? "no shapes.toml" : to_string(problems.items().front());
  for (const MeshRecipe& recipe : hard_case.expected.meshes)
    if (const std::string error = write_recipe(recipe, *shapes, folder.string()); !error.empty()) return error;
  return {};
}

void note_work(const RunSummary& s, HardCaseOutcome& out) {
  out.iterations = work_of(s);
  out.worst_residual = s.motion ? s.motion->worst_residual : s.worst_residual;
}

}  // namespace

HardCaseOutcome run_hard_case(const HardCase& hard_case, const std::string& shapes_folder,
                              const HardCaseOptions& options) {
  HardCaseOutcome out;
  out.hard_case = &hard_case;
  const Timer timer;
  try {
    std::optional<ScratchFolder> scratch;
    if (!options.folder) scratch.emplace("genu-hard-case");
    if (scratch && !scratch->problem().empty()) {
      out.misses.push_back(scratch->problem());
      return out;
    }
    const fs::path folder = scratch ? scratch->path() : fs::path(*options.folder) / hard_case.family / hard_case.name;
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (const std::string error = lay_out(hard_case, shapes_folder, folder); !error.empty()) {
      out.misses.push_back(error);
      return out;
    }
    RunOptions run;
    run.starts = hard_case.expected.starts;
    const double limit = hard_case.expected.limit;
    run.cancelled = [&timer, limit] { return timer.seconds() > limit; };
    CaseResult result;
    result.exit_code = run_scene((folder / "scene.toml").string(), (folder / "results").string(), run,
                                 result.diagnostics, &result.solution);
    note_work(result.solution.summary, out);
    out.misses = misses(hard_case.expected, result);
    if (timer.seconds() > limit) out.misses.push_back(fmt::format("took longer than {:g} s", limit));
  } catch (const std::exception& error) {
    out.misses.push_back(std::string("threw: ") + error.what());
  }
  out.seconds = timer.seconds();
  return out;
}

std::vector<HardCaseOutcome> run_hard_cases(const std::vector<HardCase>& cases, const std::string& shapes_folder,
                                            const HardCaseOptions& options) {
  std::vector<HardCaseOutcome> outcomes(cases.size());
  std::mutex telling;
  int done = 0;
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t k) {
    outcomes[k] = run_hard_case(cases[k], shapes_folder, options);
    const std::lock_guard<std::mutex> one_at_a_time(telling);
    if (options.progress) options.progress(++done, static_cast<int>(cases.size()));
  });
  return outcomes;
}

std::string to_text(const std::vector<HardCaseOutcome>& outcomes) {
  std::size_t width = 4;
  const auto name_of = [](const HardCaseOutcome& o) { return o.hard_case->family + "/" + o.hard_case->name; };
  for (const HardCaseOutcome& o : outcomes) width = std::max(width, name_of(o).size());
  std::string table = fmt::format("  {:<{}}  {:<12}  {:>10}  {:>14}  {:>8}\n", "case", width, "verdict", "iterations",
                                  "worst residual", "time s");
  std::string missed;
  double seconds = 0;
  std::size_t met = 0;
  for (const HardCaseOutcome& o : outcomes) {
    const char* verdict = !o.met() ? "MISSED" : o.hard_case->expected.shortcoming.empty() ? "ok" : "shortcoming";
    table += fmt::format("  {:<{}}  {:<12}  {:>10}  {:>14.1e}  {:>8.2f}\n", name_of(o), width, verdict, o.iterations,
                         o.worst_residual, o.seconds);
    for (const std::string& miss : o.misses) missed += fmt::format("  {}: {}\n", name_of(o), miss);
    seconds += o.seconds;
    met += o.met() ? 1 : 0;
  }
  table += fmt::format("\n{} of {} cases are answered as expected; {:.1f} s in all\n", met, outcomes.size(), seconds);
  return table + missed;
}

std::string to_markdown(const std::vector<HardCase>& cases) {
  std::string out;
  std::string family;
  for (const HardCase& c : cases) {
    if (c.family != family) {
      family = c.family;
      out += fmt::format("\n## {}\n\n| case | why it is hard | it fails without |\n|---|---|---|\n", family);
    }
    const Expectation& e = c.expected;
    const std::string guard = e.safeguard.empty() ? "(" + e.cannot_switch + ")" : "`" + e.safeguard + "`";
    out += fmt::format("| [{}](../tests/hard_cases/{}/{}.toml){} | {}{} | {} |\n", c.name, c.family, c.name,
                       e.takes_long ? " (`--long`)" : "", e.why,
                       e.shortcoming.empty() ? "" : " **Known shortcoming:** " + e.shortcoming, guard);
  }
  return out;
}

}  // namespace genu
