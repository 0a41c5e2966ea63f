// A solid put together of round shapes, as a file for `genu mesh` describes it (shape_fit/solid_field.h is its
// mathematics).
#pragma once

#include <string>
#include <vector>

#include "genu/core/pose.h"
#include "genu/core/source_location.h"
#include "genu/core/types.h"

namespace genu {

struct SolidDef {
  struct Part {
    enum class Shape { sphere, ellipsoid, rod, torus, box, half_space };
    enum class Operation { join, cut, keep };
    Shape shape = Shape::sphere;
    Operation operation = Operation::join;
    double blend = 0;                             ///< m: how far from its seam it is blended with what is there
    Pose placement;                               ///< X_solid_shape
    double radius = 0;                            ///< m: sphere; rod, at `from`
    double end_radius = 0;                        ///< m: rod, at `to`
    Vec3 radii = Vec3::Zero();                    ///< m: ellipsoid
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< m: rod, in the shape's frame
    double major_radius = 0, minor_radius = 0;    ///< m: torus
    Vec3 size = Vec3::Zero();                     ///< m: box, from side to side
    double rounding = 0;                          ///< m: box
  };
  std::string name;
  std::vector<Part> parts;  ///< in order; the first is joined and bounded
  SourceLocation where;
};

}  // namespace genu
