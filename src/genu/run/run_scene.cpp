#include "genu/run/run_scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "genu/core/atomic_output.h"
#include "genu/core/timer.h"
#include "genu/results/columns.h"
#include "genu/results/curves.h"
#include "genu/results/pressure_map.h"
#include "genu/run/contact_location.h"
#include "genu/run/hertz_check.h"
#include "genu/run/layer_doubts.h"
#include "genu/run/layer_verdict.h"
#include "genu/run/run_motion.h"
#include "genu/run/surface_variants.h"
#include "genu/run/verdict.h"

namespace genu {
namespace {

constexpr double kMillimetre = 1e3;
constexpr double kLargestOverlap = 5e-3;  // m: a start that overlaps more is refused

int poses_asked(const std::vector<StepPlan>& steps) {
  int asked = steps.empty() ? 0 : 1;
  for (const StepPlan& step : steps) asked += step.increments;
  return asked;
}

std::vector<double> pair_gaps(const PosePoint& point, const JointModel& model, ContactField& field) {
  std::vector<double> gaps(model.pairs.size(), std::numeric_limits<double>::infinity());
  for (int pair = 0; pair < static_cast<int>(gaps.size()); ++pair) {
    double& gap = gaps[static_cast<std::size_t>(pair)];
    bool held = false;
    for (const ActiveContact& c : point.pose.state.contacts) {
      if (c.pair != pair) continue;
      const auto& p = model.pairs[static_cast<std::size_t>(pair)];
      const Pose &X_a = point.pose.state.poses[static_cast<std::size_t>(p.body_a)],
                 &X_b = point.pose.state.poses[static_cast<std::size_t>(p.body_b)];
      gap = std::min(gap, (X_a.R * c.geometry.a.n).dot(X_b * c.geometry.b.p - X_a * c.geometry.a.p));
      held = true;
    }
    for (const OpenContact& c : point.pose.open)
      if (c.pair == pair) gap = std::min(gap, c.gap);
    if (!held && !std::isfinite(gap)) gap = field.smallest_gap(point.pose.state, pair);
  }
  return gaps;
}

/// "no unknowns; tibiofemoral measured, 1.1 to 8.3 mm thick"
std::string layer_note(const Prepared& p) {
  std::string note = "no unknowns";
  for (std::size_t k = 0; k < p.model.layers.size(); ++k) {
    const JointModel::Layer& layer = p.model.layers[k];
    if (p.scene.layers[k].measured)
      note += fmt::format("; {} measured, {:.2g} to {:.2g} mm thick", layer.name, kMillimetre * layer.thinnest,
                          kMillimetre * layer.thickest);
  }
  return note;
}

void note_effects(const Prepared& p, RunSummary& summary) {
  const Scene& scene = p.scene;
  const int bodies = p.model.moving_count;
  std::size_t prescribed = 0;
  for (const StepPlan& step : p.steps) prescribed = std::max(prescribed, step.prescribed.size());
  summary.effects.push_back({"moving bodies", bodies, fmt::format("6 unknowns each: {}", 6 * bodies)});
  if (!p.model.held.empty())
    summary.effects.push_back(
        {"joint constraints", static_cast<int>(p.model.held.size()), "coordinates held, 1 multiplier each"});
  if (!p.model.joint_springs.empty())
    summary.effects.push_back({"joint springs", static_cast<int>(p.model.joint_springs.size()), "no unknowns"});
  if (prescribed > 0)
    summary.effects.push_back({"prescribed coordinates", static_cast<int>(prescribed), "1 multiplier each"});
  if (!scene.contacts.empty())
    summary.effects.push_back(
        {"rigid contact pairs", static_cast<int>(scene.contacts.size()), "5 unknowns for each contact point found"});
  if (!scene.layers.empty())
    summary.effects.push_back({"cartilage layers", static_cast<int>(scene.layers.size()), layer_note(p)});
  if (!scene.ligaments.empty())
    summary.effects.push_back({"ligaments", static_cast<int>(scene.ligaments.size()), "no unknowns"});
  if (!scene.loads.empty()) summary.effects.push_back({"loads", static_cast<int>(scene.loads.size()), "no unknowns"});
  if (!p.model.weights.empty())
    summary.effects.push_back({"weights", static_cast<int>(p.model.weights.size()), "no unknowns"});
}

void note_pose(const PosePoint& point, RunSummary& s) {
  if (!point.solved()) return;
  const int contacts = static_cast<int>(point.pose.state.contacts.size());
  s.fewest_contacts = s.poses_solved == 0 ? contacts : std::min(s.fewest_contacts, contacts);
  s.most_contacts = std::max(s.most_contacts, contacts);
  ++s.poses_solved;
  if (point.stability.verdict == Stability::Verdict::stable) ++s.poses_stable;
  s.smallest_force = std::min(s.smallest_force, point.report.certificate.smallest_force);
  s.smallest_gap = std::min(s.smallest_gap, point.report.certificate.smallest_gap);
}

std::string interrupted_folder(std::string folder) {
  while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
  return folder + ".interrupted";
}

}  // namespace

std::string folder_for(const std::string& folder, const RunOptions& options, RunSummary& summary) {
  if (!options.cancelled || !options.cancelled()) return folder;
  summary.verdict.insert(summary.verdict.begin(), "Interrupted: the poses solved until then are kept.");
  std::error_code ignored;
  return std::filesystem::exists(folder, ignored) ? interrupted_folder(folder) : folder;
}

std::string write_results(const std::string& folder, const Prepared& prepared, const Solution& solution,
                          const std::vector<std::pair<std::string, std::string>>& more) {
  StagedFolder out;
  std::string error = out.open(folder);
  const auto write = [&](const std::string& name, const std::string& content) {
    if (error.empty()) error = write_file_atomically(out.path() / name, content);
  };
  write("results.csv", solution.poses.to_csv());
  write("events.csv", solution.event_rows.to_csv());
  if (solution.starts) write("starts.csv", solution.starts->to_csv());
  if (solution.error_bars) write("error_bars.csv", solution.error_bars->bars.to_csv());
  if (solution.error_bars) write("error_shares.csv", solution.error_bars->shares.to_csv());
  const ResultTable* bars = solution.error_bars ? &solution.error_bars->bars : nullptr;
  write("curves.svg", to_svg(curves(prepared.scene, prepared.steps, solution.poses, solution.events, bars)));
  write("summary.json", to_json(solution.summary));
  for (const auto& [name, content] : more) write(name, content);
  if (error.empty()) error = out.commit();
  return error;
}

bool check_start(const Prepared& prepared, ContactField& field, Diagnostics& out) {
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
                                 kMillimetre * overlap, kMillimetre * kLargestOverlap)});
  }
  return good;
}

Solution solve(const Prepared& prepared, ContactField& field, const RunOptions& options) {
  Solution out;
  RunSummary& s = out.summary;
  s.scene_file = prepared.scene.file;
  s.title = prepared.scene.title;
  s.version = GENU_VERSION;
  s.length_scale = prepared.model.scales.length;
  s.force_scale = prepared.model.scales.force;
  s.poses_asked = poses_asked(prepared.steps);
  s.smallest_force = s.smallest_gap = std::numeric_limits<double>::infinity();
  s.seconds = prepared.seconds;
  for (const SurfaceNote& note : prepared.notes) s.surfaces.push_back({note.name, note.text});
  note_effects(prepared, s);

  const Timer timer;
  double gap_seconds = 0;
  PathObserver observer;
  observer.cancelled = options.cancelled;
  observer.event = [&](const PathEvent& event) { out.events.push_back(event); };
  observer.pose = [&](const PosePoint& point) {
    PoseRecord record{point, {}};
    if (!point.pose.state.poses.empty()) {
      const ScopedTimer timing(gap_seconds);
      record.pair_gap = pair_gaps(point, prepared.model, field);
    }
    note_pose(point, s);
    out.records.push_back(std::move(record));
    if (options.progress) options.progress(static_cast<int>(out.records.size()), s.poses_asked);
  };
  const PathResult path = follow_path(prepared.model, field, prepared.steps, options.path, observer);
  s.iterations = path.iterations;
  s.substeps = path.substeps;
  s.worst_residual = path.worst_residual;
  const bool by_arc =
      std::any_of(prepared.steps.begin(), prepared.steps.end(), [](const auto& x) { return x.arc_length; });
  if (by_arc) s.poses_asked = static_cast<int>(out.records.size());  // how often a value comes by is known only now
  s.exit_code = path.complete && s.poses_solved == s.poses_asked ? kExitOk : kExitIncomplete;
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
  how.newton = options.path.newton;
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
  same.progress = {};
  std::vector<std::optional<Solution>> varied(variants.size());
  std::atomic<int> done = 0;
  tbb::parallel_for(std::size_t{0}, variants.size(), [&](std::size_t i) {
    if (const auto other = vary(prepared, noises, variants[i])) {
      ContactField field(other->model);
      varied[i] = solve(*other, field, same);
    }
    ++done;
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
                                    const std::vector<std::string>& inputs) {
  if (!folder) return prepare(path, out);
  {
    // Before an hour of solving: can the folder be written at all?
    StagedFolder probe;
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
  auto prepared = prepare(path, out);
  if (!prepared) return std::nullopt;
  for (const SurfaceDef& def : prepared->scene.surfaces) {
    for (const std::string& file : {def.file, def.thickness ? def.thickness->bone : std::string()}) {
      if (file.empty() || !folder_holds(*folder, file)) continue;
      out.error(*folder, "holds the mesh " + file + ", which would be lost with the folder: choose another folder");
      return std::nullopt;
    }
  }
  return prepared;
}

namespace {

int write_motion(const Prepared& prepared, const std::string& folder, const RunOptions& options, Diagnostics& out,
                 Solution* solution) {
  if (!check_motion_options(prepared, options, out)) return kExitRefused;
  Solution found = solve_motion(prepared, options);
  if (refused_start(prepared, found, out)) return kExitRefused;
  int code = found.summary.exit_code;
  found.folder = folder_for(folder, options, found.summary);
  if (const std::string error = write_results(found.folder, prepared, found); !error.empty()) {
    out.add({.file = {}, .key = {}, .found = {}, .rule = error});
    code = kExitFailed;
  }
  if (solution != nullptr) *solution = std::move(found);
  return code;
}

/// Not one pose, because contact leans on a flaw of a mesh from the start: the input is to blame.
bool refused_for_flaws(const Prepared& prepared, const Solution& found, Diagnostics& out) {
  if (found.summary.poses_solved > 0 || found.records.empty()) return false;
  const PoseReport& first = found.records.front().point.report;
  if (first.status != PoseStatus::flawed_mesh) return false;
  out.error(prepared.scene.file,
            first.why + ": no pose can be trusted. Mend the mesh (genu mesh-check FILE --repair OUT)");
  return true;
}

}  // namespace

int run_scene(const std::string& path, const std::string& folder, const RunOptions& options, Diagnostics& out,
              Solution* solution) {
  const auto prepared = prepare_run(path, folder, out);
  if (!prepared) return kExitRefused;
  if (prepared->scene.dynamics) return write_motion(*prepared, folder, options, out, solution);
  const Timer timer;
  ContactField field(prepared->model);
  if (!check_start(*prepared, field, out)) return kExitRefused;
  const double search_seconds = timer.seconds();
  Solution found = solve(*prepared, field, options);
  if (refused_for_flaws(*prepared, found, out)) return kExitRefused;
  found.summary.seconds.insert(found.summary.seconds.end() - 1, {"preparing contact search", search_seconds});
  if (options.starts > 0) {
    const Timer searching;
    found.starts = find_equilibria(*prepared, field, options, found);
    found.summary.seconds.emplace_back("searching from starts", searching.seconds());
  }
  if (options.error_bars && has_meshes(*prepared)) {
    const Timer varying;
    found.error_bars = find_error_bars(*prepared, options, found);
    found.summary.seconds.emplace_back("error bars", varying.seconds());
  }
  int code = found.summary.exit_code;
  found.folder = folder_for(folder, options, found.summary);
  const auto maps = options.pressure_maps ? pressure_maps(prepared->scene, prepared->model, found.records)
                                          : std::vector<std::pair<std::string, std::string>>();
  for (const auto& [name, content] : maps) found.pressure_files.push_back(name);
  if (const std::string error = write_results(found.folder, *prepared, found, maps); !error.empty()) {
    out.add({.file = {}, .key = {}, .found = {}, .rule = error});
    code = kExitFailed;
  }
  if (solution != nullptr) *solution = std::move(found);
  return code;
}

}  // namespace genu
