#include "genu/study/run_motion.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/appraise/appraise.h"
#include "genu/appraise/effects.h"
#include "genu/appraise/implausible.h"
#include "genu/core/timer.h"
#include "genu/model/linearization.h"
#include "genu/motion/motion_rates.h"
#include "genu/results/motion_table.h"
#include "genu/store/stop_of.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

void refuse_dynamics(const Prepared& prepared, Code code, std::string rule, Diagnostics& out) {
  out.add(error_at({prepared.scene.file, prepared.scene.dynamics->where}, code, "dynamics", {}, std::move(rule)));
}

void note_energy(const JointModel& model, const std::vector<MotionPoint>& points, RunSummary::Motion& m) {
  for (const MotionPoint& p : points) {
    const MechanicalEnergy e = mechanical_energy(model, p.state, p.twist);
    m.worst_energy = std::max(m.worst_energy, std::abs(energy_error(model, points.front(), p)));
    for (const double part : {e.kinetic, e.stored, e.gravity, p.load_work, p.dissipated, p.layer_work})
      m.energy_scale = std::max(m.energy_scale, std::abs(part));
  }
}

int impacts(const std::vector<PathEvent>& events) {
  return static_cast<int>(std::count_if(events.begin(), events.end(), [](const PathEvent& e) {
    return e.kind == PathEvent::Kind::contact_gained || e.kind == PathEvent::Kind::contact_lost;
  }));
}

/// Whether energies balance as far as can be expected: elastic layers sum forces to a relative error only.
bool balances(const Prepared& prepared, const RunSummary::Motion& m) {
  double allowed = std::max(kMinEnergyError, kEnergyOfTolerance * m.tolerance);
  if (!prepared.model.layers.empty()) allowed = std::max(allowed, kLayerEnergyError);
  const JointModel::Scales& scales = prepared.model.scales;
  return m.worst_energy <= allowed * (m.energy_scale + scales.length * scales.force);
}

/// The largest |factor| of a load in each of equal parts of the points from the first on at which it acts.
std::vector<double> largest_in_parts(const std::vector<double>& factors) {
  const auto first = std::find_if(factors.begin(), factors.end(), [](double f) { return f > 0; });
  const auto acting = static_cast<std::size_t>(factors.end() - first);
  std::vector<double> largest(kGrowthParts, 0.0);
  for (std::size_t k = 0; k < acting; ++k) {
    double& part = largest[k * kGrowthParts / acting];
    part = std::max(part, first[static_cast<std::ptrdiff_t>(k)]);
  }
  return largest;
}

/// Whether feedback misses its target by more than the target ever moves, and by more from part to part of the motion
/// or by far. A target that moves on is missed by more and more as well, but by no more than that.
bool runs_away(const LoadScale& scale, const std::vector<double>& factors) {
  const double asked = std::max(scale.largest(), factors.front()),
               most = *std::max_element(factors.begin(), factors.end());
  if (!(asked > 0 && most > asked)) return false;
  if (most > kRunaway * asked) return true;
  const std::vector<double> largest = largest_in_parts(factors);
  for (std::size_t k = 1; k < kGrowthParts; ++k)
    if (!(largest[k] > kGrowth * largest[k - 1])) return false;
  return largest.front() > 0;
}

/// Loads with feedback whose target is missed by more and more.
std::vector<std::string> growing_feedback(const JointModel& model, const std::vector<MotionPoint>& points) {
  std::vector<std::string> out;
  if (points.empty()) return out;
  for (const Load& load : model.loads) {
    if (!load.scale || !load.scale->is_feedback()) continue;
    std::vector<double> factors;
    for (const MotionPoint& p : points) factors.push_back(std::abs(load_scale(load, p.state, p.time).factor));
    if (!runs_away(*load.scale, factors)) continue;
    out.push_back(fmt::format(
        "The feedback of load {} misses its target by more and more: its scale reaches {:.3g}, where its target asks "
        "for "
        "{:.3g}. It is unstable, pushes the wrong way, or its target runs away. Lower its gain, raise its rate_gain, "
        "turn its load about, or look for a loop of couplings.",
        load.name, *std::max_element(factors.begin(), factors.end()), load.scale->largest()));
  }
  return out;
}

std::vector<std::string> verdict(const Prepared& prepared, const MotionResult& result,
                                 const std::vector<MotionPoint>& points, const RunSummary& s) {
  std::vector<std::string> out;
  if (result.complete)
    out.push_back(fmt::format("The motion is integrated to its end, {:g} s.", s.motion->duration));
  else
    out.push_back(fmt::format("{} of {} rows: {}.", s.poses_solved, s.poses_asked, result.why));
  if (!balances(prepared, *s.motion))
    out.push_back(fmt::format(
        "Its energies do not balance: they are off by {:.2g} of {:.3g} J. What is prescribed or loads it may "
        "change too fast for the tolerance.",
        s.motion->worst_energy, s.motion->energy_scale));
  for (std::string& sentence : growing_feedback(prepared.model, points)) out.push_back(std::move(sentence));
  if (result.stiff_from && std::any_of(prepared.model.loads.begin(), prepared.model.loads.end(),
                                       [](const Load& l) { return l.scale && l.scale->is_feedback(); }))
    out.push_back(fmt::format("The motion is stiff from {:g} s on: a gain or a rate_gain may be higher than needed.",
                              *result.stiff_from));
  if (s.motion->switches > 0)
    out.push_back(
        fmt::format("{} times a ligament became slack or taut, a law changed formula or a joint passed its limit: "
                    "events.csv.",
                    s.motion->switches));
  if (s.motion->impacts > 0)
    out.push_back(fmt::format("{} times a contact closed or opened: events.csv.", s.motion->impacts));
  return out;
}

}  // namespace

MotionPlan plan_motion(const DynamicsDef& dynamics) {
  MotionPlan plan;
  plan.duration = dynamics.duration;
  plan.output_interval = dynamics.output_interval;
  plan.tolerance = dynamics.tolerance;
  plan.from_equilibrium = dynamics.from_equilibrium;
  for (const DynamicsDef::Rate& rate : dynamics.start_rates) plan.start_rates.emplace_back(rate.coordinate, rate.value);
  return plan;
}

Solution solve_motion(const Prepared& prepared, const RunOptions& options) {
  Solution out;
  RunSummary& s = out.summary;
  s = begin_summary(prepared);
  start_counting(prepared);

  const Timer timer;
  const MotionPlan plan = plan_motion(*prepared.scene.dynamics);
  s.poses_asked = static_cast<int>(output_times(plan).size());
  std::vector<MotionPoint> points;
  MotionObserver observer;
  observer.cancelled = options.cancelled;
  observer.event = [&](PathEvent event) {
    event.t = event.target.time / plan.duration;
    event.target.load_factors.assign(prepared.model.loads.size(), 1.0);
    event.rows_before = static_cast<int>(points.size());
    out.events.push_back(std::move(event));
  };
  observer.point = [&](const MotionPoint& point) {
    points.push_back(point);
    if (options.progress) options.progress(static_cast<int>(points.size()), s.poses_asked);
  };
  MotionResult result;
  const auto move = [&] { result = follow_motion(prepared.model, plan, observer); };
  options.keep_partial ? void(out.stopped = stop_of(move)) : move();
  if (out.stopped.empty() && asked_to_stop(options.cancelled)) out.stopped = "interrupted";
  if (!out.stopped.empty()) result.complete = false, result.why = out.stopped;
  s.partial = !out.stopped.empty();
  s.effects = effects_of(prepared);
  s.poses_solved = static_cast<int>(points.size());
  s.motion = {plan.duration,
              plan.output_interval,
              plan.tolerance,
              result.stiff_from ? fmt::format("Adams, from {:g} s on BDF: stiff", *result.stiff_from) : "Adams",
              result.counts.steps,
              result.counts.evaluations,
              result.counts.jacobians,
              result.counts.starts,
              result.worst_residual,
              result.worst_drift,
              0,
              0,
              static_cast<int>(out.events.size()) - impacts(out.events),
              impacts(out.events)};
  if (!points.empty()) note_energy(prepared.model, points, *s.motion);
  s.exit_code = result.complete && balances(prepared, *s.motion) ? kExitOk : kExitIncomplete;
  s.verdict = verdict(prepared, result, points, s);
  s.seconds.emplace_back("integrating", timer.seconds());
  out.poses = motion_table(prepared.scene, prepared.model, points);
  classify(implausible(prepared, out.poses), false, s);
  out.event_rows = event_table(prepared.scene, prepared.steps, out.events);
  out.motion = std::move(points);
  return out;
}

bool check_motion_options(const Prepared& prepared, const RunOptions& options, Diagnostics& out) {
  if (options.starts > 0)
    refuse_dynamics(prepared, Code::not_applicable, "a motion has one start: run it without --starts", out);
  if (options.error_bars)
    refuse_dynamics(prepared, Code::not_built, "not built yet: error bars of a motion; run it without --error-bars",
                    out);
  return !out.has_errors();
}

bool refused_start(const Prepared& prepared, const Solution& found, Diagnostics& out) {
  if (found.summary.poses_solved > 0) return false;
  refuse_dynamics(prepared, Code::not_solved, found.summary.verdict.front(), out);
  return true;
}

bool refuse_motion(const Prepared& prepared, const char* command, Diagnostics& out) {
  if (!prepared.scene.dynamics) return false;
  refuse_dynamics(prepared, Code::not_built, fmt::format("not built yet: {} of a scene in motion", command), out);
  return true;
}

}  // namespace genu
