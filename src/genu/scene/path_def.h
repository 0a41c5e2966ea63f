// The path of a ligament or cable in a scene: points of bodies, and surfaces that it wraps round.
#pragma once

#include <optional>
#include <vector>

#include "genu/core/source_location.h"
#include "genu/core/types.h"

namespace genu {

/// A point of a body.
struct PathEnd {
  int body = -1;
  Vec3 point = Vec3::Zero();  ///< m, in the body
};

/// A surface that a path stays outside of.
struct WrapDef {
  int surface = -1;            ///< index into Scene::surfaces
  int after = 0;               ///< how many via points come before it
  std::optional<Vec3> side;    ///< direction in the surface's body: the side it passes; empty: the shortest
  bool ignore_inside = false;  ///< an end inside the surface: the path passes through it, as in OpenSim
  SourceLocation where;

  bool operator==(const WrapDef&) const = default;
};

}  // namespace genu
