#include "genu/assemble/build_solid.h"

namespace genu {
namespace {

SolidPart::Shape shape_of(SolidDef::Part::Shape shape) {
  using Shape = SolidDef::Part::Shape;
  switch (shape) {
    case Shape::sphere:
      return SolidPart::Shape::sphere;
    case Shape::ellipsoid:
      return SolidPart::Shape::ellipsoid;
    case Shape::rod:
      return SolidPart::Shape::rod;
    case Shape::torus:
      return SolidPart::Shape::torus;
    case Shape::box:
      return SolidPart::Shape::box;
    case Shape::half_space:
      return SolidPart::Shape::half_space;
  }
  return SolidPart::Shape::sphere;
}

SolidPart part_of(const SolidDef::Part& def) {
  using Operation = SolidDef::Part::Operation;
  SolidPart part;
  part.shape = shape_of(def.shape);
  part.operation = def.operation == Operation::join  ? SolidPart::Operation::join
                   : def.operation == Operation::cut ? SolidPart::Operation::cut
                                                     : SolidPart::Operation::keep;
  part.blend = def.blend;
  part.placement = def.placement;
  part.radius = def.radius;
  part.end_radius = def.end_radius;
  part.radii = def.radii;
  part.from = def.from;
  part.to = def.to;
  if (def.shape == SolidDef::Part::Shape::torus) {
    part.radius = def.major_radius;
    part.end_radius = def.minor_radius;
  }
  if (def.shape == SolidDef::Part::Shape::box) {
    part.radii = def.size;
    part.radius = def.rounding;
  }
  return part;
}

}  // namespace

SolidField make_solid(const SolidDef& def) {
  std::vector<SolidPart> parts;
  for (const SolidDef::Part& part : def.parts) parts.push_back(part_of(part));
  return SolidField(std::move(parts));
}

}  // namespace genu
