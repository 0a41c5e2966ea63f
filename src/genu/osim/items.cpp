// Every element of a file that a set or list holds. What is inside a path, a joint's functions or a muscle's curves is
// part of its owner and has no row of its own.
#include <algorithm>
#include <array>
#include <string_view>

#include "genu/osim/read_parts.h"

namespace genu::osim {
namespace {

constexpr std::array<std::string_view, 6> kLists = {"objects",    "coordinates",       "frames",
                                                    "components", "attached_geometry", "groups"};
constexpr std::array<std::string_view, 4> kInnerParts = {"GeometryPath", "FrameGeometry", "defaults", "Appearance"};
/// Elements of a model that are no sets and need no row.
constexpr std::array<std::string_view, 9> kPlain = {
    "Ground",       "gravity",     "credits",           "publications",
    "length_units", "force_units", "assembly_accuracy", "ModelVisualPreferences",
    "components"};

template <std::size_t N>
bool one_of(const std::array<std::string_view, N>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// What the members of `e` are part of; wrap objects are part of the body that has them.
std::string set_of(const XmlElement& e, const std::string& around) {
  if (e.tag == "Ground") return "ground";
  if (!e.tag.ends_with("Set") || e.tag == "WrapObjectSet") return around;
  return e.name().empty() ? e.tag : e.name();
}

void collect(const XmlElement& e, const std::string& set, std::vector<Item>& items) {
  for (const XmlElement& child : e.children) {
    if (one_of(kInnerParts, child.tag)) continue;
    if (!one_of(kLists, child.tag)) {
      collect(child, set_of(child, set), items);
      continue;
    }
    for (const XmlElement& member : child.children) {
      items.push_back({set, member.tag, member.name(), member.where});
      collect(member, member.name(), items);
    }
  }
}

}  // namespace

std::vector<Item> items_of(const XmlElement& model) {
  std::vector<Item> items;
  for (const XmlElement& child : model.children)
    if (!child.tag.ends_with("Set") && !one_of(kPlain, child.tag) && !one_of(kInnerParts, child.tag))
      items.push_back({"model", child.tag, child.name(), child.where});
  collect(model, "model", items);
  const auto before = [](const Item& a, const Item& b) {
    return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
  };
  std::sort(items.begin(), items.end(), before);
  return items;
}

}  // namespace genu::osim
