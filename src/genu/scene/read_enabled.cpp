#include <algorithm>

#include "genu/scene/read_parts.h"

namespace genu {

bool read_enabled(ReadContext& context, Section& section, const char* group) {
  const Item item = section.find("enabled");
  if (!item || read_bool(context, item).value_or(true)) return true;
  context.scene.disabled.push_back({group, section.item().node->key, section.item().node->key_where});
  return false;
}

bool is_disabled(const Scene& scene, const std::string& group, const std::string& name) {
  return std::any_of(scene.disabled.begin(), scene.disabled.end(),
                     [&](const DisabledTable& t) { return t.group == group && t.name == name; });
}

}  // namespace genu
