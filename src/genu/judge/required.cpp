#include "genu/judge/required.h"

#include <fmt/format.h>

#include "genu/judge/joints.h"
#include "genu/judge/wrapping.h"

namespace genu::judge {
namespace {

void add_points(const Scene& scene, const ContactDef& pair, std::vector<std::string>& names) {
  for (const int surface : {pair.surface_a, pair.surface_b})
    for (const char axis : {'x', 'y', 'z'})
      names.push_back(fmt::format("{}.{}.{}_mm", pair.name, scene.surfaces[at(surface)].name, axis));
}

void add_reaction(const Scene& scene, const QuantityRef& q, std::vector<std::string>& names) {
  names.push_back(quantity_name(scene, q) + ".reaction" + (q.is_rotation() ? "_Nm" : "_N"));
}

void add_touches(const Scene& scene, const std::string& name, const std::vector<WrapDef>& wraps,
                 std::vector<std::string>& names) {
  for (const std::string& stem : touch_stems(scene, name, wraps)) {
    for (const char* quantity : {".touches", ".arc_mm"}) names.push_back(stem + quantity);
    for (const char* end : {"begin", "end"})
      for (const char axis : {'x', 'y', 'z'}) names.push_back(fmt::format("{}.{}.{}_mm", stem, end, axis));
  }
}

}  // namespace

std::vector<std::string> required_columns(const Scene& scene) {
  std::vector<std::string> names = {"step", "increment", "time_s", "status", "residual"};
  for (int j = 0; j < static_cast<int>(scene.joints.size()); ++j) {
    const JointDef& joint = scene.joints[at(j)];
    for (int i = 0; i < 6; ++i) {
      if (!joint.leaves(i)) continue;
      names.push_back(column_of(scene, {j, i}));
      if (scene.dynamics)
        names.push_back(coordinate_name(scene, {j, i}) + (i < 3 ? "_velocity_deg_s" : "_velocity_mm_s"));
    }
    if (joint.type == JointDef::Type::free) continue;
    for (const char axis : {'x', 'y', 'z'}) {
      names.push_back(fmt::format("{}.reaction.force_{}_N", joint.name, axis));
      names.push_back(fmt::format("{}.reaction.moment_{}_Nm", joint.name, axis));
    }
  }
  for (int k = 0; k < static_cast<int>(scene.combinations.size()); ++k)
    names.push_back(column_of(scene, {scene.combinations[at(k)].terms.front().coordinate, k}));
  for (const StepDef& step : scene.steps)
    for (const auto& p : step.prescribe)
      if (p.drivers.empty())
        add_reaction(scene, p.coordinate, names);
      else
        for (const int driver : p.drivers) names.push_back(scene.loads[at(driver)].name + ".factor");
  if (scene.dynamics)
    for (const auto& drive : scene.dynamics->prescribe) add_reaction(scene, drive.quantity, names);
  for (const ContactDef& pair : scene.contacts) {
    for (const char* end : {".force_N", ".gap_mm"}) names.push_back(pair.name + end);
    add_points(scene, pair, names);
  }
  for (const LayerDef& layer : scene.layers)
    for (const char axis : {'x', 'y', 'z'}) {
      names.push_back(fmt::format("{}.force_{}_N", layer.pair.name, axis));
      names.push_back(fmt::format("{}.moment_{}_Nm", layer.pair.name, axis));
    }
  for (const LigamentDef& l : scene.ligaments)
    for (const char* end : {".length_mm", ".strain", ".force_N"}) names.push_back(l.name + end);
  for (const BushingDef& b : scene.bushings)
    for (const char axis : {'x', 'y', 'z'})
      for (const char* quantity : {".{}_mm", ".turn_{}_deg", ".force_{}_N", ".moment_{}_Nm"})
        names.push_back(b.name + fmt::format(fmt::runtime(quantity), axis));
  for (const LigamentDef& l : scene.ligaments) add_touches(scene, l.name, l.wraps, names);
  for (const LoadDef& l : scene.loads) {
    if (l.kind == LoadDef::Kind::cable) names.push_back(l.name + ".length_mm");
    add_touches(scene, l.name, l.wraps, names);
  }
  for (const LoadDef& l : scene.loads)
    if (l.scale) names.push_back(l.name + ".scale");
  return names;
}

}  // namespace genu::judge
