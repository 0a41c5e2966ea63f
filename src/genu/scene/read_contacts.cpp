#include <algorithm>

#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"

namespace genu {

namespace {

void read_pair(ReadContext& context, const Item& item, bool enabled, ContactDef& contact) {
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
    refuse(context, item, Code::conflict,
           "both surfaces are on body." + scene.bodies[static_cast<std::size_t>(a)].name);
  } else if (a >= 0 && b >= 0 && fixed(a) && fixed(b)) {
    refuse(context, item, Code::no_effect, "both surfaces are on fixed bodies");
  }
  if (!enabled) return;
  const auto pair = std::minmax(contact.surface_a, contact.surface_b);
  const auto refuse_same = [&](const ContactDef& other) {
    if (std::minmax(other.surface_a, other.surface_b) == pair)
      refuse(context, item, Code::duplicate,
             "contact." + other.name + " has the same pair; however many contacts it needs are found");
  };
  for (const ContactDef& other : scene.contacts) refuse_same(other);
  for (const LayerDef& other : scene.layers) refuse_same(other.pair);
}

void read_regions(ReadContext& context, const Item& item, ContactDef& contact) {
  if (!is_table(context, item)) return;
  for (const TomlNode& child : item.node->children) {
    const Item region = item.member(child);
    check_name(context, child.key_where, region.path, child.key);
    contact.regions.push_back({.name = child.key, .conditions = read_region(context, region)});
  }
}

/// The surface whose triangles send the rays.
void read_cast_from(ReadContext& context, const Item& item, LayerDef& layer) {
  const int a = layer.pair.surface_a, b = layer.pair.surface_b;
  if (!item) return;
  const auto found = read_reference(context, item, "surface", names_of(context.scene.surfaces));
  if (!found || a < 0 || b < 0) return;
  layer.cast_from = *found;
  if (*found != a && *found != b)
    refuse(context, item, Code::unknown_name, "must be one of the contact's two surfaces");
}

bool is_mesh(const ReadContext& context, int surface) {
  return surface >= 0 && context.scene.surfaces[at(surface)].shape == SurfaceDef::Shape::mesh;
}

/// What is wanted where nothing is said: the way that a given key belongs to; between two meshes triangles, which take
/// a small part of the time.
int usual_quadrature(const ReadContext& context, const LayerDef& layer, bool tolerance, bool of_triangles) {
  if (tolerance != of_triangles) return of_triangles ? 1 : 0;
  return is_mesh(context, layer.pair.surface_a) && is_mesh(context, layer.pair.surface_b) ? 1 : 0;
}

/// How the triangles count at the rim of the other surface.
void read_rim(ReadContext& context, const Item& item, bool smooth, LayerDef& layer) {
  if (!item) return;
  layer.rim = static_cast<LayerDef::Rim>(read_choice(context, item, {"weighted", "cut"}).value_or(0));
  if (smooth)
    refuse(context, item, Code::conflict,
           "belongs to quadrature = \"triangles\": smooth surfaces have no rays to weight");
}

/// How the pressure is summed, and the keys that belong to that way alone.
void read_quadrature(ReadContext& context, Section& section, LayerDef& layer) {
  const Item quadrature = section.find("quadrature"), tolerance = section.find("tolerance"),
             cast_from = section.find("cast_from"), rim = section.find("rim");
  const std::optional<int> choice =
      quadrature ? read_choice(context, quadrature, {"smooth", "triangles"})
                 : usual_quadrature(context, layer, static_cast<bool>(tolerance), cast_from || rim);
  // Where nobody knows which of the two is meant each key is still looked at for what it holds.
  const bool triangles = choice == 1, smooth = choice == 0;
  if (triangles) {
    layer.quadrature = LayerDef::Quadrature::triangles;
    layer.cast_from = layer.pair.surface_b;
  }
  if (smooth && cast_from)
    refuse(context, cast_from, Code::conflict,
           "belongs to quadrature = \"triangles\": smooth surfaces both send rays, half and half");
  else
    read_cast_from(context, cast_from, layer);
  read_rim(context, rim, smooth, layer);
  if (!tolerance) return;
  if (triangles)
    return refuse(context, tolerance, Code::conflict, "belongs to quadrature = \"smooth\": triangles have none");
  layer.tolerance =
      read_number(context, tolerance, {.unit = 1, .unit_name = {}, .above = {}, .at_least = kMinLayerTolerance})
          .value_or(layer.tolerance);
  if (layer.tolerance > kMaxLayerTolerance)
    refuse(context, tolerance, Code::out_of_range, "must be <= 0.1: a relative error of the force");
}

void read_layer(ReadContext& context, Section& section, LayerDef& layer) {
  const NumberRule modulus{.unit = 1e6, .unit_name = "MPa", .above = 0, .at_least = {}};
  layer.modulus = read_number(context, section.require("modulus"), modulus).value_or(0);
  const Item poisson = section.require("poisson");
  const auto nu = read_number(context, poisson, {.unit = 1, .unit_name = {}, .above = {}, .at_least = 0});
  if (nu && *nu >= 0.5)
    refuse(context, poisson, Code::out_of_range,
           "must be < 0.5: a layer that cannot be compressed carries any pressure");
  layer.poisson = nu.value_or(0);
  read_layer_thickness(context, section, layer);
  warn_unlikely(context, section, layer);
  if (const Item law = section.find("law"))
    layer.law = static_cast<LayerDef::Law>(read_choice(context, law, {"linear", "logarithmic"}).value_or(0));
  read_quadrature(context, section, layer);
  read_number_row(context, section, kLayerDamping, {.objects = "cartilage"}, &layer.damping);
}

}  // namespace

void read_contacts(ReadContext& context, Section& root) {
  for (const Item& item : named_tables(context, root, "contact")) {
    Section section(context, item, "a rigid contact");
    ContactDef contact;
    contact.name = item.node->key;
    contact.where = item.node->key_where;
    const Item surfaces = section.require("surfaces");
    const auto model = read_choice(context, section.require("model"), {"rigid", "cartilage"});
    const bool enabled = read_enabled(context, section, "contact");
    read_pair(context, surfaces, enabled, contact);
    read_regions(context, section.find("regions"), contact);
    if (model == 1) {
      section.rename("a cartilage contact");
      LayerDef layer;
      layer.pair = contact;
      read_layer(context, section, layer);
      if (enabled) context.scene.layers.push_back(std::move(layer));
    } else if (enabled) {
      if (model) ++context.rigid_pairs;
      context.scene.contacts.push_back(std::move(contact));
    }
    section.finish();
  }
}

}  // namespace genu
