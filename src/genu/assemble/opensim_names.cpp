#include "genu/assemble/opensim_names.h"

#include "genu/assemble/plain_text.h"

namespace genu {
namespace {

bool begins_with(const std::string& s, const std::string& begin) { return s.compare(0, begin.size(), begin) == 0; }

/// Index of the joint's coordinate that OpenSim's word for a quantity means, -1 for none or several.
int quantity_index(const JointDef& joint, const std::string& word) {
  constexpr std::size_t kShortest = 3;  // letters that a rotation's name may be cut to
  int found = -1;
  for (int i = 0; i < 6; ++i) {
    if (!joint.leaves(i)) continue;
    const std::string name = lower_case(i < 3 ? joint.rotations[at(i)].name : joint.translations[at(i - 3)]);
    const bool cut = i < 3 && word.size() >= kShortest && begins_with(name, word);
    if (name != word && !cut && !(i >= 3 && word == "t" + name)) continue;
    if (name == word) return i;
    if (found >= 0) return -1;
    found = i;
  }
  return found;
}

}  // namespace

std::string last_part_of_path(const std::string& column) {
  const auto parent = [](const std::string& path) { return path.substr(0, path.rfind('/')); };
  const auto last = [](const std::string& path) { return path.substr(path.rfind('/') + 1); };
  if (column.find('/') == std::string::npos) return column;
  if (last(column) == "speed") return {};
  return last(column) == "value" ? last(parent(column)) : last(column);
}

std::vector<CoordinateRef> opensim_coordinates(const SceneTables& scene, const std::string& column) {
  const std::string part = lower_case(last_part_of_path(column));
  std::vector<CoordinateRef> found;
  for (int j = 0; j < static_cast<int>(scene.joints.size()); ++j) {
    const std::string joint = lower_case(scene.joints[at(j)].name);
    for (const std::string side : {"", "_r", "_l"}) {
      if (part.size() <= side.size() || part.compare(part.size() - side.size(), side.size(), side) != 0) continue;
      const std::string rest = part.substr(0, part.size() - side.size());
      // The joint's own name may tell its side.
      const bool sided = !side.empty() && joint.size() > 2 && joint.substr(joint.size() - 2) == side;
      const std::string stem = sided ? joint.substr(0, joint.size() - 2) : joint;
      if (!begins_with(rest, stem + "_")) continue;
      const int index = quantity_index(scene.joints[at(j)], rest.substr(stem.size() + 1));
      if (index >= 0 && std::find(found.begin(), found.end(), CoordinateRef{j, index}) == found.end())
        found.push_back({j, index});
    }
  }
  return found;
}

}  // namespace genu
