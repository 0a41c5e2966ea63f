#include "genu/results/ligament_groups.h"

#include <algorithm>

namespace genu {
namespace {

/// "ACLam" of "ACLam1"; "7" of "7".
std::string before_number(const std::string& name) {
  const std::size_t end = name.find_last_not_of("0123456789");
  return name.substr(0, end == std::string::npos ? name.size() : end + 1);
}

}  // namespace

std::vector<LigamentGroup> ligament_groups(const SceneTables& scene) {
  std::vector<LigamentGroup> groups;
  std::vector<bool> bundled(scene.ligaments.size());
  for (const BundleDef& bundle : scene.bundles) {
    if (bundle.members.empty()) continue;
    LigamentGroup& group = groups.emplace_back(LigamentGroup{bundle.name, {}, true});
    for (const int member : bundle.members) {
      group.members.push_back(static_cast<std::size_t>(member));
      bundled[static_cast<std::size_t>(member)] = true;
    }
  }
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    if (bundled[i]) continue;
    const std::string stem = before_number(scene.ligaments[i].name);
    const auto same = [&](const LigamentGroup& g) { return g.name == stem && !g.bundle; };
    auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end()) group = groups.insert(group, {stem, {}});
    group->members.push_back(i);
  }
  return groups;
}

std::string force_column(const SceneTables& scene, const LigamentGroup& group) {
  if (group.bundle) return group.name + ".force_N";
  return group.members.size() == 1 ? scene.ligaments[group.members.front()].name + ".force_N" : std::string();
}

}  // namespace genu
