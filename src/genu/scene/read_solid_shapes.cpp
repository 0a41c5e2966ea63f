// [solid.NAME]: shapes joined, cut out or kept, one after the other.
#include <fmt/format.h>

#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"

namespace genu {
namespace {

using Part = SolidDef::Part;

double length(ReadContext& context, const Item& item) {
  return read_number(context, item, positive(length_rule(context))).value_or(1);
}

Vec3 lengths(ReadContext& context, const Item& item) {
  return read_vector(context, item, positive(length_rule(context))).value_or(Vec3::Ones());
}

void read_sphere(ReadContext& context, Section& section, Part& part) {
  part.radius = length(context, section.require("radius"));
}

void read_solid_ellipsoid(ReadContext& context, Section& section, Part& part) {
  part.radii = lengths(context, section.require("radii"));
}

/// `radius` of both ends, or `radii`, one of each.
void read_rod(ReadContext& context, Section& section, Part& part) {
  const Item from = section.require("from"), to = section.require("to");
  const auto first = read_vector(context, from, length_rule(context));
  const auto last = read_vector(context, to, length_rule(context));
  part.from = first.value_or(Vec3::Zero());
  part.to = last.value_or(Vec3::UnitZ());
  if (first && last && *first == *last)
    refuse(context, to, Code::out_of_range, "is where the rod begins: a ball is a sphere");
  const Item radii = section.find("radii");
  if (!radii) {
    part.radius = part.end_radius = length(context, section.require("radius"));
    return;
  }
  if (const Item one = section.find("radius"))
    refuse(context, one, Code::conflict, "and `radii` say the same: leave one of the two out");
  if (!is_array(context, radii, "[radius at from, radius at to]", 2)) return;
  part.radius = length(context, radii.element(0));
  part.end_radius = length(context, radii.element(1));
}

void read_solid_torus(ReadContext& context, Section& section, Part& part) {
  const Item major = section.require("major_radius"), minor = section.require("minor_radius");
  part.major_radius = length(context, major);
  part.minor_radius = length(context, minor);
  if (major && minor && !(part.minor_radius < part.major_radius))
    refuse(context, minor, Code::out_of_range, "must be < major_radius");
}

void read_box(ReadContext& context, Section& section, Part& part) {
  part.size = lengths(context, section.require("size"));
  const Item rounding = section.find("rounding");
  part.rounding = read_number(context, rounding, non_negative(length_rule(context))).value_or(0);
  if (rounding && 2 * part.rounding > part.size.minCoeff())
    refuse(context, rounding, Code::out_of_range, "must be at most half the size");
}

void read_half_space(ReadContext&, Section&, Part&) {}

struct SolidShapeReader {
  const char* word;
  const char* what;
  Part::Shape shape;
  void (*read)(ReadContext&, Section&, Part&);
};
constexpr SolidShapeReader kSolidShapes[] = {
    {"sphere", "a sphere", Part::Shape::sphere, read_sphere},
    {"ellipsoid", "an ellipsoid", Part::Shape::ellipsoid, read_solid_ellipsoid},
    {"rod", "a rod", Part::Shape::rod, read_rod},
    {"torus", "a torus", Part::Shape::torus, read_solid_torus},
    {"box", "a box", Part::Shape::box, read_box},
    {"half_space", "a half space", Part::Shape::half_space, read_half_space},
};

void read_part(ReadContext& context, const Item& item, double blend, SolidDef& solid) {
  if (!is_table(context, item)) return;
  Section section(context, item, "a part");
  Part part;
  std::vector<std::string> words;
  for (const SolidShapeReader& shape : kSolidShapes) words.emplace_back(shape.word);
  const auto shape = read_choice(context, section.require("shape"), words);
  const Item operation = section.find("operation");
  part.operation = static_cast<Part::Operation>(read_choice(context, operation, {"join", "cut", "keep"}).value_or(0));
  const Item own = section.find("blend");
  part.blend = read_number(context, own, non_negative(length_rule(context))).value_or(blend);
  part.placement = read_placement(context, section);
  if (!shape) return;  // without a shape no key of any shape can be called wrong
  const SolidShapeReader& reader = kSolidShapes[*shape];
  part.shape = reader.shape;
  section.rename(reader.what);
  reader.read(context, section, part);
  section.finish();
  const bool joined = part.operation == Part::Operation::join;
  if (solid.parts.empty() && !joined)
    refuse(context, operation, Code::no_effect, "there is nothing yet: the first part is joined");
  if (joined && part.shape == Part::Shape::half_space)
    section.error(Code::conflict, "operation", "a half space has no end: it can only be cut or kept");
  solid.parts.push_back(part);
}

}  // namespace

void read_solid_shapes(ReadContext& context, Section& root) {
  for (const Item& item : named_tables(context, root, "solid")) {
    Section section(context, item, "a solid");
    SolidDef solid;
    solid.name = item.node->key;
    solid.where = item.node->key_where;
    const double blend = read_number(context, section.find("blend"), non_negative(length_rule(context))).value_or(0);
    const Item parts = section.require("parts");
    section.finish();
    if (!is_array(context, parts, "a list of parts [{ shape = \"sphere\", radius = 20 }, ...]")) continue;
    const std::size_t count = parts.node->children.size();
    if (count == 0) refuse(context, parts, Code::missing_key, "needs at least one part");
    if (count > kMaxSolidParts) {
      refuse(context, parts, Code::too_large, fmt::format("has {} parts, more than {}", count, kMaxSolidParts));
      continue;
    }
    for (std::size_t k = 0; k < count; ++k) read_part(context, parts.element(k), blend, solid);
    context.scene.solids.push_back(std::move(solid));
  }
}

}  // namespace genu
