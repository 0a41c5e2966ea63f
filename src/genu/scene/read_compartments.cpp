// [compartment.NAME]: contacts that carry a load side by side.
#include <algorithm>

#include "genu/scene/read_parts.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

/// Every contact, and each of its regions as "CONTACT.REGION".
std::vector<std::string> names_of_contacts(const Scene& scene) {
  std::vector<std::string> names;
  const auto add = [&](const ContactDef& contact) {
    names.push_back(contact.name);
    for (const RegionDef& region : contact.regions) names.push_back(contact.name + "." + region.name);
  };
  for (const ContactDef& contact : scene.contacts) add(contact);
  for (const LayerDef& layer : scene.layers) add(layer.pair);
  return names;
}

std::vector<std::string> read_names(ReadContext& context, const Item& item) {
  std::vector<std::string> out;
  if (!item || !is_array(context, item, "contacts or their regions, [\"CONTACT\", \"CONTACT.REGION\", ...]"))
    return out;
  const std::vector<std::string> known = names_of_contacts(context.scene);
  for (std::size_t k = 0; k < item.node->children.size(); ++k) {
    const auto name = read_string(context, item.element(k));
    if (!name) continue;
    if (std::find(known.begin(), known.end(), *name) != known.end())
      out.push_back(*name);
    else if (!is_disabled(context.scene, "contact", name->substr(0, name->find('.'))))
      refuse(context, item.element(k), Code::unknown_name,
             "names no contact of this scene, and no region of one" + did_you_mean(*name, known));
  }
  return out;
}

/// A contact, or a part of it, must not count twice; regions may overlap on purpose.
void check_counted_once(Section& section, const CompartmentDef& compartment) {
  std::vector<std::string> all = compartment.direct;
  all.insert(all.end(), compartment.meniscal.begin(), compartment.meniscal.end());
  for (std::size_t j = 0; j < all.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      if (all[i] == all[j] || all[j].starts_with(all[i] + ".") || all[i].starts_with(all[j] + "."))
        return section.error(Code::duplicate, "", "counts " + all[j] + " twice");
}

}  // namespace

void read_compartments(ReadContext& context, Section& root) {
  for (const Item& item : named_tables(context, root, "compartment")) {
    Section section(context, item, "a compartment");
    CompartmentDef compartment;
    compartment.name = item.node->key;
    compartment.where = item.node->key_where;
    compartment.direct = read_names(context, section.find("direct"));
    compartment.meniscal = read_names(context, section.require("meniscal"));
    section.finish();
    check_counted_once(section, compartment);
    context.scene.compartments.push_back(std::move(compartment));
  }
}

}  // namespace genu
