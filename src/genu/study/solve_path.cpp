#include "genu/study/solve_path.h"

#include <algorithm>

#include "genu/appraise/effects.h"
#include "genu/core/timer.h"
#include "genu/equilibrium/pair_gaps.h"
#include "genu/path/path.h"
#include "genu/store/checkpoint.h"
#include "genu/store/stop_of.h"

namespace genu {
namespace {

int poses_asked(const std::vector<StepPlan>& steps) {
  int asked = steps.empty() ? 0 : 1;
  for (const StepPlan& step : steps) asked += step.increments;
  return asked;
}

std::vector<LayerReport> report_layers(const Prepared& prepared, const State& state, LayerMemories& memories) {
  std::vector<LayerReport> reports;
  memories.each.resize(prepared.model.layers.size());
  for (std::size_t k = 0; k < memories.each.size(); ++k)
    reports.push_back(report_layer(prepared.model, prepared.scene.layers[k].pair.regions, state, static_cast<int>(k),
                                   memories.each[k]));
  return reports;
}

}  // namespace

PathOptions path_options(const SceneTables& scene, const RunOptions& options) {
  PathOptions path = options.path;
  path.newton.residual_tolerance = scene.solver.tolerance;
  path.newton.residual_floor = std::max(path.newton.residual_floor, scene.solver.tolerance);
  return path;
}

Solved solve_path(const Prepared& prepared, ContactField& field, const RunOptions& options) {
  const PathOptions how = path_options(prepared.scene, options);
  Solved out;
  out.asked = poses_asked(prepared.steps);
  start_counting(prepared);

  const Timer timer;
  double reporting = 0;
  int solved = 0;
  PathObserver observer;
  observer.cancelled = options.cancelled;
  observer.event = [&](const PathEvent& event) { out.events.push_back(event); };
  observer.pose = [&](const PosePoint& point, LayerMemories* layers) {
    PoseRecord record{point, {}, {}, {}};
    if (!point.pose.state.poses.empty()) {
      const ScopedTimer timing(reporting);
      if (layers != nullptr && point.solved()) record.layers = report_layers(prepared, point.pose.state, *layers);
      record.pair_gap = pair_gaps(point.pose.state, prepared.model, field, record.point.pose.open);
    }
    solved += point.solved() ? 1 : 0;
    out.records.push_back(std::move(record));
    if (options.progress) options.progress(static_cast<int>(out.records.size()), out.asked);
  };
  observer.rest = [&](const std::function<std::string()>& save) {
    if (options.checkpoint != nullptr) options.checkpoint->add(out.records, out.events, save);
    if (options.keep_rest && solved == static_cast<int>(out.records.size()))
      out.rest = save(), out.rest_rows = out.records.size();
  };
  std::string from = options.from;
  if (options.checkpoint != nullptr) {
    from = options.checkpoint->path;
    out.records = options.checkpoint->records;
    out.events = options.checkpoint->events;
    solved = out.solved();
  }
  const auto follow = [&] { out.path = follow_path(prepared.model, field, prepared.steps, how, observer, from); };
  options.keep_partial ? void(out.stopped = stop_of(follow)) : follow();
  if (out.stopped.empty() && !out.path.complete && asked_to_stop(options.cancelled)) out.stopped = "interrupted";
  if (!out.stopped.empty()) out.path.complete = false;
  const bool by_arc =
      std::any_of(prepared.steps.begin(), prepared.steps.end(), [](const auto& x) { return x.arc_length; });
  if (by_arc) out.asked = static_cast<int>(out.records.size());  // how often a value comes by is known only now
  out.effects = effects_of(prepared);
  out.seconds = timer.seconds() - reporting;
  return out;
}

}  // namespace genu
