#include <algorithm>

#include "genu/scene/bundle_def.h"
#include "genu/scene/read_parts.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

/// The fibres that one name or pattern means, marked in `chosen`; an error where it means none.
void choose_fibres(ReadContext& context, const Item& item, const std::vector<std::string>& known,
                   std::vector<bool>& chosen) {
  const auto pattern = read_string(context, item);
  if (!pattern) return;
  bool found = false;
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (!matches(*pattern, known[k])) continue;
    chosen[k] = found = true;
  }
  if (!found)
    refuse(context, item, Code::unknown_name, "names no ligament of this scene" + did_you_mean(*pattern, known));
}

}  // namespace

void read_bundles(ReadContext& context, Section& root) {
  Scene& scene = context.scene;
  const std::vector<std::string> enabled = names_of(scene.ligaments);
  for (const Item& item : named_tables(context, root, "bundle")) {
    Section section(context, item, "a bundle");
    BundleDef bundle;
    bundle.name = item.node->key;
    bundle.where = item.node->key_where;
    std::vector<bool> chosen(context.ligaments.size());
    const Item fibres = section.require("fibres");
    if (fibres && fibres.node->kind == TomlNode::Kind::array) {
      if (fibres.node->children.empty()) refuse(context, fibres, Code::missing_key, "needs at least one ligament");
      for (std::size_t k = 0; k < fibres.node->children.size(); ++k)
        choose_fibres(context, fibres.element(k), context.ligaments, chosen);
    } else if (fibres) {
      choose_fibres(context, fibres, context.ligaments, chosen);
    }
    section.finish();
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      if (!chosen[k]) continue;
      bundle.fibres.push_back(context.ligaments[k]);
      const auto member = std::find(enabled.begin(), enabled.end(), context.ligaments[k]);
      if (member != enabled.end()) bundle.members.push_back(static_cast<int>(member - enabled.begin()));
    }
    scene.bundles.push_back(std::move(bundle));
  }
}

std::vector<std::string> with_fibres(const SceneTables& scene, const std::string& pattern) {
  std::vector<std::string> patterns = {pattern};
  const std::string_view prefix = "ligament.";
  const std::size_t first = pattern.rfind(prefix, 0) == 0 ? prefix.size() : 0;
  const std::size_t dot = std::min(pattern.find('.', first), pattern.size());
  const std::string object = pattern.substr(first, dot - first), rest = pattern.substr(dot);
  for (const BundleDef& bundle : scene.bundles)
    if (matches(object, bundle.name))
      for (const std::string& fibre : bundle.fibres) patterns.push_back(fibre + rest);
  return patterns;
}

bool matches(const SceneTables& scene, const std::string& pattern, const std::string& word) {
  const std::vector<std::string> patterns = with_fibres(scene, pattern);
  return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& p) { return matches(p, word); });
}

}  // namespace genu
