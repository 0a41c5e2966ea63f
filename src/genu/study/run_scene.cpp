#include "genu/study/run_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <mutex>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "genu/appraise/contact_location.h"
#include "genu/appraise/effects.h"
#include "genu/appraise/hertz_check.h"
#include "genu/appraise/layer_doubts.h"
#include "genu/appraise/layer_verdict.h"
#include "genu/appraise/overload.h"
#include "genu/appraise/verdict.h"
#include "genu/assemble/surface_variants.h"
#include "genu/core/atomic_output.h"
#include "genu/core/file_checksum.h"
#include "genu/core/timer.h"
#include "genu/core/units.h"
#include "genu/equilibrium/pair_gaps.h"
#include "genu/results/columns.h"
#include "genu/results/curves.h"
#include "genu/store/checkpoint.h"
#include "genu/store/stop_of.h"

namespace genu {
namespace {

constexpr double kLargestOverlap = 6e-3;  // m: a start that overlaps more is refused

int poses_asked(const std::vector<StepPlan>& steps) {
  int asked = steps.empty() ? 0 : 1;
  for (const StepPlan& step : steps) asked += step.increments;
  return asked;
}

void note_pose(const PosePoint& point, RunSummary& s) {
  if (!point.solved()) return;
  const int contacts = static_cast<int>(point.pose.state.contacts.size());
  s.fewest_contacts = s.poses_solved == 0 ? contacts : std::min(s.fewest_contacts, contacts);
  s.most_contacts = std::max(s.most_contacts, contacts);
  ++s.poses_solved;
  if (point.stability.verdict == Stability::Verdict::stable && !point.stability.complex_pair) ++s.poses_stable;
  s.smallest_force = std::min(s.smallest_force, point.report.certificate.smallest_force);
  s.smallest_gap = std::min(s.smallest_gap, point.report.certificate.smallest_gap);
}

std::string interrupted_folder(const std::string& folder) { return beside(folder, ".interrupted"); }

}  // namespace

std::string folder_for(const std::string& folder, const RunOptions& options, RunSummary& summary) {
  if (!asked_to_stop(options.cancelled)) return folder;
  summary.verdict.insert(summary.verdict.begin(), "Interrupted: the poses solved until then are kept.");
  summary.partial = true;
  std::error_code ignored;
  return std::filesystem::exists(folder, ignored) ? interrupted_folder(folder) : folder;
}

void note_files(const Scene& scene, RunSummary& summary) {
  std::vector<std::string> files = mesh_files(scene);
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  files.insert(files.begin(), scene.file);
  for (const std::string& file : files) {
    std::error_code error;
    const std::string path = std::filesystem::absolute(file, error).lexically_normal().string();
    const auto checksum = file_checksum(file);
    if (error || !checksum) continue;  // gone while it was solved: the summary says nothing of it
    if (&file == &files.front()) summary.scene_path = path;
    summary.files.push_back({path, *checksum});
  }
}

std::string write_results(const std::string& folder, const Prepared& prepared, const Solution& solution,
                          const std::vector<std::pair<std::string, std::string>>& more, const std::string& mark) {
  StagedFolder out("results");
  std::string error = out.open(folder);
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
  note_files(prepared.scene, summary);
  write("summary.json", to_json(summary));
  for (const auto& [name, content] : more) write(name, content);
  if (error.empty()) error = out.commit();
  return error;
}

bool check_start(const Prepared& prepared, ContactField& field, Diagnostics& out) {
  if (prepared.model.safeguards.lacks(Safeguard::start_overlap)) return true;
  const State start = start_state(prepared.model);
  bool good = true;
  for (std::size_t pair = 0; pair < prepared.model.pairs.size(); ++pair) {
    const double overlap = field.overlap(start, static_cast<int>(pair));
    if (overlap <= kLargestOverlap) continue;
    const ContactDef& def = prepared.scene.contacts[pair];
    good = false;
    out.add({.file = prepared.scene.file,
             .line = def.where.line,
             .column = def.where.column,
             .key = "contact." + def.name,
             .found = {},
             .rule = fmt::format("the surfaces overlap by {:.4g} mm where the search starts, at most {:.0f} mm can be "
                                 "resolved: move the bodies apart with the joint's `start`, or check the frames and "
                                 "units of the meshes",
                                 to::kMillimetre * overlap, to::kMillimetre * kLargestOverlap)});
  }
  return good;
}

namespace {

std::vector<LayerReport> report_layers(const Prepared& prepared, const State& state, LayerMemories& memories) {
  std::vector<LayerReport> reports;
  memories.each.resize(prepared.model.layers.size());
  for (std::size_t k = 0; k < memories.each.size(); ++k)
    reports.push_back(report_layer(prepared.model, prepared.scene.layers[k].pair.regions, state, static_cast<int>(k),
                                   memories.each[k]));
  return reports;
}

}  // namespace

PathOptions path_options(const Scene& scene, const RunOptions& options) {
  PathOptions path = options.path;
  path.newton.residual_tolerance = scene.solver.tolerance;
  path.newton.residual_floor = std::max(path.newton.residual_floor, scene.solver.tolerance);
  return path;
}

Solution solve(const Prepared& prepared, ContactField& field, const RunOptions& options) {
  const PathOptions how = path_options(prepared.scene, options);
  Solution out;
  RunSummary& s = out.summary;
  s = begin_summary(prepared);
  start_counting(prepared);
  s.poses_asked = poses_asked(prepared.steps);
  s.smallest_force = s.smallest_gap = std::numeric_limits<double>::infinity();

  const Timer timer;
  double gap_seconds = 0;
  PathObserver observer;
  observer.cancelled = options.cancelled;
  observer.event = [&](const PathEvent& event) { out.events.push_back(event); };
  observer.pose = [&](const PosePoint& point, LayerMemories* layers) {
    PoseRecord record{point, {}, {}, {}};
    if (!point.pose.state.poses.empty()) {
      const ScopedTimer timing(gap_seconds);
      if (layers != nullptr && point.solved()) record.layers = report_layers(prepared, point.pose.state, *layers);
      record.pair_gap = pair_gaps(point.pose.state, prepared.model, field, record.point.pose.open);
    }
    note_pose(point, s);
    out.records.push_back(std::move(record));
    if (options.progress) options.progress(static_cast<int>(out.records.size()), s.poses_asked);
  };
  observer.rest = [&](const std::function<std::string()>& save) {
    if (options.checkpoint != nullptr) options.checkpoint->add(out.records, out.events, save);
    if (options.keep_rest && s.poses_solved == static_cast<int>(out.records.size()))
      out.rest = save(), out.rest_rows = out.records.size();
  };
  std::string from = options.from;
  if (options.checkpoint != nullptr) {
    from = options.checkpoint->path;
    out.records = options.checkpoint->records;
    out.events = options.checkpoint->events;
    for (const PoseRecord& record : out.records) note_pose(record.point, s);
  }
  PathResult path;
  const auto walk = [&] { path = follow_path(prepared.model, field, prepared.steps, how, observer, from); };
  options.keep_partial ? void(out.stopped = stop_of(walk)) : walk();
  if (out.stopped.empty() && !path.complete && asked_to_stop(options.cancelled)) out.stopped = "interrupted";
  if (!out.stopped.empty()) path.complete = false;
  s.partial = !out.stopped.empty();
  s.effects = effects_of(prepared);
  s.iterations = path.iterations;
  s.substeps = path.substeps;
  s.worst_residual = path.worst_residual;
  const bool by_arc =
      std::any_of(prepared.steps.begin(), prepared.steps.end(), [](const auto& x) { return x.arc_length; });
  if (by_arc) s.poses_asked = static_cast<int>(out.records.size());  // how often a value comes by is known only now
  s.exit_code = path.complete && s.poses_solved == s.poses_asked ? kExitOk : kExitIncomplete;
  if (s.poses_solved == 0 && !s.partial)
    s.bearable_loads = bearable_loads(prepared, field, stoppable(how.newton, options.cancelled));
  s.locations = locate_contacts(prepared, out.records);
  s.verdict = verdict_sentences(prepared, out.records, out.events, s);
  s.seconds.emplace_back("solving", timer.seconds() - gap_seconds);
  out.poses = pose_table(prepared.scene, prepared.model, prepared.steps, out.records);
  for (const StepPlan& step : prepared.steps)
    for (const auto& p : step.prescribed)
      if (const std::string column = coordinate_column(prepared.scene, p.coordinate);
          std::find(out.prescribed.begin(), out.prescribed.end(), column) == out.prescribed.end())
        out.prescribed.push_back(column);
  for (std::string& sentence : layer_sentences(prepared.scene, prepared.model, out.poses))
    s.verdict.push_back(std::move(sentence));
  say_layer_doubts(prepared, out.records, s.verdict);
  s.hertz = hertz_checks(prepared, out.records, out.poses);
  for (std::string& sentence : hertz_sentences(s.hertz)) s.verdict.push_back(std::move(sentence));
  out.event_rows = event_table(prepared.scene, prepared.steps, out.events);
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
  std::vector<std::optional<Solution>> varied(variants.size());
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
      varied[i] = solve(*other, field, same);
    }
    if (asked_to_stop(options.cancelled)) return;
    const int solved = varied[i] ? static_cast<int>(varied[i]->records.size()) : 0;
    tell(solution.summary.poses_asked - solved);  // a path that ends early is done as well
  });
  std::vector<VariedPoses> poses;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    solution.summary.variants.push_back({to_string(variants[i].cause), variants[i].name, 0});
    if (!varied[i]) continue;
    solution.summary.variants.back().poses_solved = varied[i]->summary.poses_solved;
    poses.push_back({variants[i].cause, &varied[i]->poses});
  }
  return error_bars(solution.poses, poses);
}

std::optional<Prepared> prepare_run(const std::string& path, const std::optional<std::string>& folder, Diagnostics& out,
                                    const std::vector<std::string>& inputs, const Safeguards& safeguards) {
  if (!folder) return prepare(path, out, safeguards);
  {
    // Before an hour of solving: can the folder be written at all?
    StagedFolder probe("results");
    if (const std::string error = probe.open(*folder); !error.empty()) {
      out.add({.file = {}, .key = {}, .found = {}, .rule = error});
      return std::nullopt;
    }
  }
  if (folder_holds(*folder, path)) {
    out.error(*folder, "holds the scene itself, which would be lost with the folder: choose another folder");
    return std::nullopt;
  }
  for (const std::string& input : inputs) {
    if (!folder_holds(*folder, input)) continue;
    out.error(*folder, "holds " + input + ", which would be lost with the folder: choose another folder");
    return std::nullopt;
  }
  auto prepared = prepare(path, out, safeguards);
  if (!prepared) return std::nullopt;
  for (const std::string& file : mesh_files(prepared->scene)) {
    if (!folder_holds(*folder, file)) continue;
    out.error(*folder, "holds the mesh " + file + ", which would be lost with the folder: choose another folder");
    return std::nullopt;
  }
  return prepared;
}

}  // namespace genu
