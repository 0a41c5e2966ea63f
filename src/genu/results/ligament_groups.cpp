#include "genu/results/ligament_groups.h"

#include <algorithm>

namespace genu {

std::vector<LigamentGroup> ligament_groups(const SceneTables& scene) {
  std::vector<LigamentGroup> groups;
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const std::string& name = scene.ligaments[i].name;
    const std::size_t end = name.find_last_not_of("0123456789");
    const std::string stem = name.substr(0, end == std::string::npos ? name.size() : end + 1);
    const auto same = [&](const LigamentGroup& g) { return g.name == stem; };
    auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end()) group = groups.insert(group, {stem, {}});
    group->members.push_back(i);
  }
  return groups;
}

}  // namespace genu
