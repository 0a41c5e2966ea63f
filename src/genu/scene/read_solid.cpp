// `solid` of a body: the closed mesh and the density that its mass, centre of mass and inertia come from.
#include "genu/core/units.h"
#include "genu/scene/read_parts.h"

namespace genu {

bool read_solid(ReadContext& context, Section& body_section, BodyDef& body) {
  const Item item = body_section.find("solid");
  if (!item) return false;
  std::vector<Item> others = given_numbers(body_section, kind_of(body));
  if (context.in_motion) others.push_back(body_section.find("inertia"));
  for (const Item& other : others)
    if (other) refuse(context, other, Code::conflict, "follows from `solid`: leave one of the two out");
  if (body.fixed) refuse(context, item, Code::no_effect, "is of a fixed body, which nothing moves");
  if (!is_table(context, item)) return true;
  Section section(context, item, "a solid");
  BodyDef::Solid solid;
  solid.where = item.node->where;
  solid.file = read_mesh_files(context, section.require("file"));
  solid.file_unit = read_length_unit(context, section.require("units"));
  solid.placement = read_placement(context, section);
  const NumberRule density{.unit = 1, .unit_name = "kg/m^3", .above = {}, .at_least = {}};
  solid.density = read_number(context, section.require("density"), positive(density)).value_or(1);
  section.finish();
  body.solid = solid;
  return true;
}

}  // namespace genu
