// How thick cartilage is: of both layers together in a contact, or of each surface, as a number or down to a bone.
#include <algorithm>

#include "genu/core/units.h"
#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"

namespace genu {
namespace {

void read_thickness_to_bone(ReadContext& context, const Item& item, SurfaceDef::Thickness& thickness) {
  Section section(context, item, "a thickness down to a bone");
  thickness.bone = read_mesh_files(context, section.require("bone"));
  thickness.bone_unit = read_length_unit(context, section.require("units"));
  const NumberRule length = positive(length_rule(context));
  thickness.least = read_number(context, section.find("minimum"), length).value_or(thickness.least);
  const Item most = section.find("maximum");
  thickness.most = read_number(context, most, length).value_or(std::max(thickness.most, 2 * thickness.least));
  if (most && !(thickness.most > thickness.least)) refuse(context, most, Code::out_of_range, "must be > minimum");
  section.finish();
}

const SurfaceDef* surface_of(const ReadContext& context, int surface) {
  return surface < 0 ? nullptr : &context.scene.surfaces[at(surface)];
}

/// Without a thickness of the contact: the sum of what its surfaces have.
void take_from_surfaces(ReadContext& context, Section& section, LayerDef& layer) {
  const SurfaceDef *a = surface_of(context, layer.pair.surface_a), *b = surface_of(context, layer.pair.surface_b);
  if (a == nullptr || b == nullptr) return;  // whether it is missing cannot be told
  if (!a->thickness && !b->thickness) {
    section.require("thickness");
    return;
  }
  for (const SurfaceDef* s : {a, b}) {
    if (!s->thickness)
      section.error(
          Code::missing_key, "thickness",
          "is missing, and surface." + s->name + " has none of its own (thickness = 0 there means bare bone)");
    else if (s->thickness->measured)
      layer.measured = true;
    else
      layer.thickness += s->thickness->constant;
  }
  if (a->thickness && b->thickness && !layer.measured && !(layer.thickness > 0))
    section.error(Code::missing_key, "thickness", "is missing, and both surfaces are without cartilage");
}

}  // namespace

std::optional<SurfaceDef::Thickness> read_surface_thickness(ReadContext& context, const Item& item) {
  if (!item) return {};
  SurfaceDef::Thickness thickness;
  thickness.where = item.node->where;
  thickness.measured = item.node->kind == TomlNode::Kind::table;
  if (thickness.measured)
    read_thickness_to_bone(context, item, thickness);
  else
    thickness.constant = read_number(context, item, non_negative(length_rule(context))).value_or(0);
  return thickness;
}

void read_layer_thickness(ReadContext& context, Section& section, LayerDef& layer) {
  const NumberRule length = positive(length_rule(context));
  if (const Item item = section.find("thickness")) {
    layer.thickness = read_number(context, item, length).value_or(0);
    for (const int k : {layer.pair.surface_a, layer.pair.surface_b}) {
      const SurfaceDef* s = surface_of(context, k);
      if (s != nullptr && s->thickness)
        refuse(context, item, Code::conflict,
               "surface." + s->name + " has a thickness of its own: leave one of the two out");
    }
  } else {
    take_from_surfaces(context, section, layer);
  }
  const Item depth = section.find("search_depth");
  layer.search_depth = layer.measured ? 0 : layer.thickness;
  if (!depth) return;
  layer.search_depth = read_number(context, depth, length).value_or(0);
  if (layer.search_depth > kMaxSearchDepth) refuse(context, depth, Code::out_of_range, "must be at most 1 m");
  constexpr double kLeastShare = 1e-3;  // of the thickness: a shorter reach finds no contact that could carry anything
  if (layer.search_depth > 0 && layer.search_depth < kLeastShare * layer.thickness)
    refuse(context, depth, Code::out_of_range, "must be at least a thousandth of the thickness");
}

void check_thickness_used(ReadContext& context) {
  const Scene& scene = context.scene;
  const auto is_contact = [](const DisabledTable& t) { return t.group == "contact"; };
  if (std::any_of(scene.disabled.begin(), scene.disabled.end(), is_contact)) return;  // it may be the one that uses it
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    const SurfaceDef& s = scene.surfaces[k];
    const auto uses = [&](const LayerDef& l) {
      return l.pair.surface_a == static_cast<int>(k) || l.pair.surface_b == static_cast<int>(k);
    };
    if (!s.thickness || std::any_of(scene.layers.begin(), scene.layers.end(), uses)) continue;
    context.error(s.thickness->where, Code::no_effect, "surface." + s.name + ".thickness", {},
                  "belongs to cartilage: no contact with model = \"cartilage\" has this surface");
  }
}

}  // namespace genu
