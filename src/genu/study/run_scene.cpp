#include "genu/study/run_scene.h"

#include <algorithm>
#include <filesystem>
#include <mutex>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "genu/appraise/appraise.h"
#include "genu/assemble/surface_variants.h"
#include "genu/core/atomic_output.h"
#include "genu/core/file_checksum.h"
#include "genu/core/units.h"
#include "genu/path/tolerances.h"
#include "genu/results/columns.h"
#include "genu/results/curves.h"
#include "genu/store/checkpoint.h"
#include "genu/study/solve_path.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

std::string interrupted_folder(const std::string& folder) { return beside(folder, ".interrupted"); }

}  // namespace

std::string folder_for(const std::string& folder, const RunOptions& options, RunSummary& summary) {
  if (!asked_to_stop(options.cancelled)) return folder;
  summary.verdict.insert(summary.verdict.begin(), "Interrupted: the poses solved so far are kept.");
  summary.partial = true;
  std::error_code ignored;
  return std::filesystem::exists(folder, ignored) ? interrupted_folder(folder) : folder;
}

void note_files(const Prepared& prepared, RunSummary& summary) {
  const SceneTables& scene = prepared.scene;
  std::vector<std::string> files = mesh_files(scene);
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  files.insert(files.begin(), scene.file);
  for (const std::string& file : files) {
    std::error_code error;
    const std::string path = std::filesystem::absolute(file, error).lexically_normal().string();
    const auto checksum = prepared.meshes->files().checksum(file);
    if (error || !checksum) continue;
    if (&file == &files.front()) summary.scene_path = path;
    summary.files.push_back({path, *checksum});
  }
}

std::string write_results(const std::string& folder, const Prepared& prepared, const Solution& solution,
                          const std::vector<std::pair<std::string, std::string>>& more, const std::string& mark) {
  StagedFolder out("results");
  std::string error = text_of(out.open(folder));
  const auto write = [&](const std::string& name, const std::string& content) {
    if (error.empty()) error = write_file_atomically(out.path() / name, content);
  };
  const std::string table = solution.poses.to_csv();
  write("results" + mark + ".csv", table);
  write("events" + mark + ".csv", solution.event_rows.to_csv());
  if (solution.starts) write("starts.csv", solution.starts->to_csv());
  if (solution.error_bars) write("error_bars.csv", solution.error_bars->bars.to_csv());
  if (solution.error_bars) write("error_shares.csv", solution.error_bars->shares.to_csv());
  const ResultTable* bars = solution.error_bars ? &solution.error_bars->bars : nullptr;
  write("curves.svg", to_svg(curves(prepared.scene, prepared.steps, solution.poses, solution.events, bars)));
  RunSummary summary = solution.summary;
  summary.results = {solution.poses.rows(), checksum(table)};
  note_files(prepared, summary);
  write("summary.json", to_json(summary));
  for (const auto& [name, content] : more) write(name, content);
  if (error.empty()) error = out.commit();
  return error;
}

bool check_start(const Prepared& prepared, ContactField& field, Diagnostics& out) {
  const State start = start_state(prepared.model);
  bool good = true;
  for (std::size_t pair = 0; pair < prepared.model.pairs.size(); ++pair) {
    const double overlap = field.overlap(start, static_cast<int>(pair));
    if (overlap <= kMaxStartOverlap) continue;
    const ContactDef& def = prepared.scene.contacts[pair];
    good = false;
    out.add(error_at({prepared.scene.file, def.where}, Code::overlap_at_start, "contact." + def.name, {},
                     fmt::format("the surfaces overlap by {:.4g} mm where the search starts, at most {:.0f} mm can be "
                                 "resolved: move the bodies apart with the joint's `start`, or check the frames and "
                                 "units of the meshes",
                                 to::kMillimetre * overlap, to::kMillimetre * kMaxStartOverlap)));
  }
  return good;
}

namespace {

/// Columns that a step prescribes, in the order they come.
std::vector<std::string> prescribed_columns(const Prepared& prepared) {
  std::vector<std::string> out;
  for (const StepPlan& step : prepared.steps)
    for (const auto& p : step.prescribed)
      if (const std::string column = coordinate_column(prepared.scene, p.coordinate);
          std::find(out.begin(), out.end(), column) == out.end())
        out.push_back(column);
  return out;
}

}  // namespace

Solution solve(const Prepared& prepared, ContactField& field, const RunOptions& options) {
  Solution out{solve_path(prepared, field, options), {}, {}, {}, {}, {}, {}, {}, {}, {}};
  out.poses = pose_table(prepared.scene, prepared.model, prepared.steps, out.records);
  out.event_rows = event_table(prepared.scene, prepared.steps, out.events);
  out.prescribed = prescribed_columns(prepared);
  out.summary = appraise(prepared, out, out.poses);
  return out;
}

ResultTable find_equilibria(const Prepared& prepared, ContactField& field, const RunOptions& options,
                            const Solution& solution) {
  StartOptions how;
  how.count = options.starts;
  how.angle = options.spread;
  how.translation *= options.spread / kStartSpread;
  how.newton = path_options(prepared.scene, options).newton;
  std::vector<JointValues> first = start_state(prepared.model).coordinates;
  if (!solution.records.empty() && solution.records.front().point.solved())
    first = solution.records.front().point.pose.state.coordinates;
  const StartSearch search =
      search_starts(prepared.model, field, prepared.steps.front().target(0), first, how, options.cancelled);
  return starts_table(prepared.scene, prepared.model, search);
}

ErrorBars find_error_bars(const Prepared& prepared, const RunOptions& options, Solution& solution) {
  const std::vector<SurfaceVariant>& variants = surface_variants();
  const std::vector<MeshNoise> noises = mesh_noises(prepared);
  RunOptions same = options;
  same.checkpoint = nullptr;
  same.keep_rest = same.keep_partial = false;
  std::vector<std::optional<Solved>> varied(variants.size());
  std::vector<ResultTable> tables(variants.size());
  std::mutex telling;
  int done = 0;
  const int asked = solution.summary.poses_asked * static_cast<int>(variants.size());
  const auto tell = [&](int more) {
    if (!options.varied_progress || more == 0) return;
    const std::lock_guard<std::mutex> one_at_a_time(telling);
    options.varied_progress(done += more, asked);
  };
  same.progress = [&](int, int) { tell(1); };
  tbb::parallel_for(std::size_t{0}, variants.size(), [&](std::size_t i) {
    if (asked_to_stop(options.cancelled)) return;
    if (const auto other = vary(prepared, noises, variants[i])) {
      ContactField field(other->model);
      varied[i] = solve_path(*other, field, same);
      tables[i] = pose_table(other->scene, other->model, other->steps, varied[i]->records);
    }
    if (asked_to_stop(options.cancelled)) return;
    const int solved = varied[i] ? static_cast<int>(varied[i]->records.size()) : 0;
    tell(solution.summary.poses_asked - solved);  // a path that ends early is done as well
  });
  std::vector<VariedPoses> poses;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    solution.summary.variants.push_back({to_string(variants[i].cause), variants[i].name, 0});
    if (!varied[i]) continue;
    solution.summary.variants.back().poses_solved = varied[i]->solved();
    poses.push_back({variants[i].cause, &tables[i]});
  }
  return error_bars(solution.poses, poses);
}

std::optional<Prepared> prepare_run(const SceneSource& source, const std::optional<std::string>& folder,
                                    Diagnostics& out, const std::vector<std::string>& inputs) {
  if (!folder) return prepare(source, out);
  {
    // Before an hour of solving: can the folder be written at all?
    StagedFolder probe("results");
    if (const auto refused = probe.open(*folder)) {
      out.error(refused->code, {}, refused->text);
      return std::nullopt;
    }
  }
  if (folder_holds(*folder, source.path)) {
    out.error(Code::would_lose_input, *folder,
              "holds the scene itself, which would be lost with the folder: choose another folder");
    return std::nullopt;
  }
  for (const std::string& input : inputs) {
    if (!folder_holds(*folder, input)) continue;
    out.error(Code::would_lose_input, *folder,
              "holds " + input + ", which would be lost with the folder: choose another folder");
    return std::nullopt;
  }
  auto prepared = prepare(source, out);
  if (!prepared) return std::nullopt;
  for (const std::string& file : mesh_files(prepared->scene)) {
    if (!folder_holds(*folder, file)) continue;
    out.error(Code::would_lose_input, *folder,
              "holds the mesh " + file + ", which would be lost with the folder: choose another folder");
    return std::nullopt;
  }
  return prepared;
}

}  // namespace genu
