// drive of a step: loads that hold prescribed coordinates in the place of reactions.
#include <algorithm>

#include <fmt/format.h>

#include "genu/scene/read_parts.h"

namespace genu {
namespace {

/// One or several names of loads that the step does not load itself.
std::vector<int> read_drivers(ReadContext& context, const Item& item, const StepDef& step) {
  std::vector<Item> entries;
  if (item.node->kind == TomlNode::Kind::array)
    for (std::size_t i = 0; i < item.node->children.size(); ++i) entries.push_back(item.element(i));
  else
    entries.push_back(item);
  if (entries.empty()) refuse(context, item, Code::wrong_form, "must name a load");
  const std::vector<std::string> names = names_of(context.scene.loads);
  std::vector<int> drivers;
  bool all_left_out = !entries.empty();
  for (const Item& entry : entries) {
    const auto name = read_string(context, entry);
    const bool left_out = name && is_disabled(context.scene, "load", *name);
    all_left_out = all_left_out && left_out;
    if (!name || left_out) continue;
    const auto found = std::find(names.begin(), names.end(), *name);
    const int load = static_cast<int>(found - names.begin());
    const auto refused = [&](Code code, const std::string& rule) {
      context.error(entry.node->where, code, entry.path, literal(*entry.node), rule);
    };
    const auto among = [load](const std::vector<int>& loads) {
      return std::find(loads.begin(), loads.end(), load) != loads.end();
    };
    if (found == names.end())
      refused(Code::unknown_name, unknown_name_rule("load", *name, names));
    else if (among(drivers) || std::any_of(step.prescribe.begin(), step.prescribe.end(),
                                           [&](const StepDef::Prescribed& p) { return among(p.drivers); }))
      refused(Code::duplicate, "drives a coordinate already");
    else if (std::any_of(step.factors.begin(), step.factors.end(), [load](const auto& f) { return f.load == load; }))
      refused(Code::conflict,
              "has a factor in `load` of this step, and its factor is what drive asks for: leave one of them out");
    else
      drivers.push_back(load);
  }
  if (all_left_out)
    refuse(context, item, Code::conflict,
           "names only loads that are left out, so nothing would hold the coordinate: leave out drive as well, and a "
           "reaction holds it");
  return drivers;
}

}  // namespace

void read_drive(ReadContext& context, const Item& item, StepDef& step) {
  if (!item) return;
  if (item.node->kind != TomlNode::Kind::table) {
    if (step.prescribe.size() == 1)
      step.prescribe.front().drivers = read_drivers(context, item, step);
    else
      refuse(context, item, Code::conflict,
             fmt::format("which of {} prescribed coordinates? Write {{ \"JOINT.COORDINATE\" = \"LOAD\" }}, of one that "
                         "the step prescribes",
                         step.prescribe.size()));
    return;
  }
  for (const NamedItem& entry : coordinate_items(item)) {
    const auto quantity = find_quantity(context, entry.item.node->key_where, entry.item.path, entry.name);
    if (!quantity) continue;
    const auto prescribed = std::find_if(step.prescribe.begin(), step.prescribe.end(),
                                         [&](const auto& p) { return p.coordinate == *quantity; });
    if (prescribed == step.prescribe.end())
      context.error(entry.item.node->key_where, Code::conflict, entry.item.path, {},
                    "is not prescribed in this step: a load can only hold what is");
    else
      prescribed->drivers = read_drivers(context, entry.item, step);
  }
}

}  // namespace genu
