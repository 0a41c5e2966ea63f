#include <algorithm>

#include "genu/scene/read_parts.h"

namespace genu {

namespace {

void read_pair(ReadContext& context, const Item& item, ContactDef& contact) {
  if (!is_array(context, item, "the names of two surfaces", 2)) return;
  const Scene& scene = context.scene;
  const std::vector<std::string> names = names_of(scene.surfaces);
  contact.surface_a = read_reference(context, item.element(0), "surface", names).value_or(-1);
  contact.surface_b = read_reference(context, item.element(1), "surface", names).value_or(-1);
  if (contact.surface_a < 0 || contact.surface_b < 0) return;
  const int a = scene.surfaces[static_cast<std::size_t>(contact.surface_a)].body;
  const int b = scene.surfaces[static_cast<std::size_t>(contact.surface_b)].body;
  const auto fixed = [&](int body) { return scene.bodies[static_cast<std::size_t>(body)].fixed; };
  if (a >= 0 && b >= 0 && a == b) {
    refuse(context, item, "both surfaces are on body." + scene.bodies[static_cast<std::size_t>(a)].name);
  } else if (a >= 0 && b >= 0 && fixed(a) && fixed(b)) {
    refuse(context, item, "both surfaces are on fixed bodies");
  }
  const auto pair = std::minmax(contact.surface_a, contact.surface_b);
  for (const ContactDef& other : scene.contacts) {
    if (std::minmax(other.surface_a, other.surface_b) != pair) continue;
    refuse(context, item, "contact." + other.name + " has the same pair; however many contacts it needs are found");
    break;
  }
}

void read_regions(ReadContext& context, const Item& item, ContactDef& contact) {
  if (!is_table(context, item)) return;
  for (const TomlNode& child : item.node->children) {
    const Item region = item.member(child);
    check_name(context, child.key_where, region.path, child.key);
    contact.regions.push_back({.name = child.key, .conditions = read_region(context, region)});
  }
}

}  // namespace

void read_contacts(ReadContext& context, Section& root) {
  for (const Item& item : named_tables(context, root, "contact")) {
    Section section(context, item, "a rigid contact");
    ContactDef contact;
    contact.name = item.node->key;
    contact.where = item.node->key_where;
    read_pair(context, section.require("surfaces"), contact);
    const auto model = read_choice(context, section.require("model"), {"rigid"}, {"cartilage"});
    if (model) ++context.rigid_pairs;
    read_regions(context, section.find("regions"), contact);
    section.not_built({"modulus", "poisson", "thickness", "law", "quadrature", "cast_from", "search_depth"},
                      "contact with model \"cartilage\"");
    section.finish();
    context.scene.contacts.push_back(contact);
  }
}

}  // namespace genu
