// moment_arms: about which coordinates those of ligaments and cables are written.
#include <algorithm>

#include "genu/scene/read_parts.h"

namespace genu {

void read_moment_arms(ReadContext& context, Section& root) {
  const Item item = root.find("moment_arms");
  if (!item) return;
  if (context.in_motion)
    return refuse(context, item, Code::conflict, "are written of poses: not together with [dynamics]");
  if (item.node->kind != TomlNode::Kind::array || item.node->children.empty())
    return refuse(context, item, Code::wrong_form, "must be a list of coordinates, [\"JOINT.COORDINATE\"]");
  std::vector<CoordinateRef>& all = context.scene.moment_arms;
  for (std::size_t k = 0; k < item.node->children.size(); ++k) {
    const Item entry = item.element(k);
    const auto name = read_string(context, entry);
    if (!name) continue;
    const auto found = find_coordinate(context, entry.node->where, entry.path, *name, literal(*entry.node));
    if (!found) continue;
    if (std::find(all.begin(), all.end(), *found) != all.end())
      refuse(context, entry, Code::duplicate, "is named twice");
    else
      all.push_back(*found);
  }
}

}  // namespace genu
