#include "genu/appraise/effects.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/model/damping.h"
#include "genu/motion/hinged_motion.h"

namespace genu {
namespace {

/// "no unknowns; tibiofemoral measured, 1.1 to 8.3 mm thick; tibiofemoral and 5 more by triangles (...)"
std::string layer_note(const Prepared& p) {
  std::string note = "no unknowns", by_triangles;
  std::size_t more = 0;
  for (std::size_t k = 0; k < p.model.layers.size(); ++k) {
    const JointModel::Layer& layer = p.model.layers[k];
    if (p.scene.layers[k].measured)
      note += fmt::format("; {} measured, {:.2g} to {:.2g} mm thick", layer.name, to::kMillimetre * layer.thinnest,
                          to::kMillimetre * layer.thickest);
    if (p.scene.layers[k].quadrature != LayerDef::Quadrature::triangles) continue;
    if (by_triangles.empty())
      by_triangles = layer.name;
    else
      ++more;
  }
  if (more > 0) by_triangles += fmt::format(" and {} more", more);
  if (!by_triangles.empty())
    note +=
        fmt::format("; {} by triangles (quadrature = \"smooth\": 3 % nearer, up to ten times the time)", by_triangles);
  return note;
}

class EffectList {
 public:
  explicit EffectList(const EffectMeter* meter) : meter_(meter) {}

  void add(const char* name, std::size_t count, std::string unknowns) {
    if (count > 0) effects.push_back({name, static_cast<int>(count), std::move(unknowns), std::nullopt, 0});
  }
  void add(Effect effect, const char* name, std::size_t count, std::string unknowns = "no unknowns") {
    if (count == 0) return;
    add(name, count, std::move(unknowns));
    if (meter_ == nullptr) return;
    effects.back().evaluations = meter_->evaluations(effect);
    effects.back().seconds = meter_->seconds(effect);
  }

  std::vector<RunSummary::Effect> effects;

 private:
  const EffectMeter* meter_;
};

std::size_t most_prescribed(const std::vector<StepPlan>& steps) {
  std::size_t most = 0;
  for (const StepPlan& step : steps) most = std::max(most, step.prescribed.size());
  return most;
}

/// What is integrated in a motion.
std::string numbers_over_time(const JointModel& model) {
  const int energies = model.layers.empty() ? 2 : 3;
  if (!HingedMotion::fits(model))
    return fmt::format("{} numbers over time: pose, quaternion, twist; {} energies", 13 * model.moving_count, energies);
  return fmt::format("{} numbers over time: angle and rate of each hinge; {} energies", 2 * HingeTree(model).count(),
                     energies);
}

}  // namespace

void start_counting(const Prepared& prepared) {
  if (prepared.model.meter) *prepared.model.meter = {};
}

std::vector<RunSummary::Effect> effects_of(const Prepared& p) {
  const JointModel& m = p.model;
  const int bodies = m.moving_count;
  const bool moves = p.scene.dynamics.has_value();
  EffectList list(m.meter.get());
  if (moves) {
    list.add("dynamics", 1, numbers_over_time(m));
    list.add(Effect::inertia, "moving bodies", m.inertias.size(),
             HingedMotion::fits(m) ? fmt::format("an acceleration of each hinge: {}", HingeTree(m).count())
                                   : fmt::format("6 accelerations each: {}", 6 * bodies));
  } else {
    list.add("moving bodies", static_cast<std::size_t>(bodies), fmt::format("6 unknowns each: {}", 6 * bodies));
  }
  list.add(Effect::held, "joint constraints", m.held.size(), "coordinates held, 1 multiplier each");
  list.add(Effect::joint_springs, "joint springs", m.joint_springs.size());
  if (moves)
    list.add(Effect::prescribed, "driven coordinates", m.drives.size(), "1 multiplier each");
  else
    list.add(Effect::prescribed, "prescribed coordinates", most_prescribed(p.steps), "1 multiplier each");
  list.add(Effect::rigid_contacts, "rigid contact pairs", m.pairs.size(),
           moves ? "1 multiplier for each contact that is closed" : "5 unknowns for each contact point found");
  list.add(Effect::contact_search, "search for contacts", m.pairs.size());
  list.add(Effect::layers, "cartilage layers", m.layers.size(), layer_note(p));
  list.add(Effect::ligaments, "ligaments", m.ligaments.size());
  list.add(Effect::bushings, "bushings", m.bushings.size());
  list.add(Effect::damping, "dampers", moves ? damper_count(m) : 0);
  list.add(Effect::loads, "loads", m.loads.size());
  list.add(Effect::weights, "weights", m.weights.size());
  return list.effects;
}

}  // namespace genu
