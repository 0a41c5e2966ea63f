#include "genu/model/step_plan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/model/tolerances.h"

namespace genu {

Target StepPlan::target(double t) const {
  Target out;
  // This form is exact at both ends.
  const auto between = [t](double from, double to) { return (1 - t) * from + t * to; };
  for (const Prescribed& p : prescribed) out.prescribed.push_back({p.coordinate, between(p.from, p.to), p.drivers});
  for (const Factor& f : factors) out.load_factors.push_back(between(f.from, f.to));
  out.time = between(start_time, end_time);
  return out;
}

Target StepPlan::rate() const {
  Target out;
  for (const Prescribed& p : prescribed) out.prescribed.push_back({p.coordinate, p.to - p.from, p.drivers});
  for (const Factor& f : factors) out.load_factors.push_back(f.to - f.from);
  out.time = end_time - start_time;
  return out;
}

double StepPlan::part_within(double angle) const {
  const double range = angle_range();
  return range > 0 ? std::min(1.0, angle / range) : 1.0 / increments;
}

double StepPlan::angle_range() const {
  double range = 0;
  for (const Prescribed& p : prescribed)
    if (p.coordinate.is_rotation()) range = std::max(range, std::abs(p.to - p.from));
  return range;
}

bool StepPlan::varies_nothing() const {
  const auto held = [](const auto& x) { return x.from == x.to; };
  return std::all_of(prescribed.begin(), prescribed.end(), held) && std::all_of(factors.begin(), factors.end(), held);
}

int StepPlan::only_driven() const {
  int driven = -1;
  for (std::size_t i = 0; i < prescribed.size(); ++i) {
    if (prescribed[i].from == prescribed[i].to) continue;
    if (driven >= 0 || !prescribed[i].drivers.empty()) return -1;
    driven = static_cast<int>(i);
  }
  const bool loads = std::any_of(factors.begin(), factors.end(), [](const Factor& f) { return f.from != f.to; });
  return loads ? -1 : driven;
}

std::vector<StepPlan> plan_steps(const SceneTables& scene) {
  std::vector<StepPlan> steps;
  double time = 0;
  for (const StepDef& def : scene.steps) {
    StepPlan plan;
    for (const auto& p : def.prescribe) plan.prescribed.push_back({p.coordinate, p.from, p.to, p.drivers});
    plan.factors.resize(scene.loads.size());
    for (const auto& f : def.factors) plan.factors[static_cast<std::size_t>(f.load)] = {f.from, f.to};
    for (const auto& p : def.prescribe)
      for (const int driver : p.drivers) plan.factors[static_cast<std::size_t>(driver)] = {0, 0};
    plan.increments = def.increments;
    plan.arc_length = def.arc_length;
    plan.start_time = time;
    plan.end_time = time += def.duration;
    steps.push_back(std::move(plan));
  }
  return steps;
}

StepPlan approach_to(const StepPlan& step, const JointModel& model, const State& state,
                     const std::vector<double>& factors) {
  StepPlan plan = step;
  for (auto& p : plan.prescribed) {
    p.to = p.from;
    p.from = quantity_value(model, state.coordinates, p.coordinate);
  }
  for (std::size_t i = 0; i < plan.factors.size(); ++i) plan.factors[i] = {factors[i], step.factors[i].from};
  for (const auto& p : plan.prescribed)
    for (const int driver : p.drivers) plan.factors[at(driver)] = {0, 0};
  plan.increments = 1;
  plan.end_time = plan.start_time;
  return plan;
}

double reaction_noise(const JointModel& model, const StepPlan& plan, int driven) {
  double noise = kSolvedResidual;
  for (const auto& layer : model.layers)
    noise = std::max(noise, layer.tolerance > 0 ? layer.tolerance : LayerDef().tolerance);
  const bool angle = plan.prescribed[at(driven)].coordinate.is_rotation();
  return noise * model.scales.force * (angle ? model.scales.length : 1);
}

std::string reaction_words(const JointModel& model, const StepPlan& plan, int driven, double rate, const State& state) {
  const double reaction = state.multipliers[at(driven)];
  if (!(std::abs(reaction) > reaction_noise(model, plan, driven))) return {};
  const bool angle = plan.prescribed[at(driven)].coordinate.is_rotation();
  return fmt::format("{} {:.9g} {}", rate < 0 ? "largest" : "smallest", reaction, angle ? "Nm" : "N");
}

}  // namespace genu
