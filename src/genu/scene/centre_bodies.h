// Bodies whose own origin lies far from everything on them (a scanner's origin, a laboratory's) get another one for the
// time of solving, near their points: a turn about a far origin moves the body by far more than it seems to, and the
// origin's moments drown in rounding.
#pragma once

#include <functional>
#include <optional>

#include "genu/scene/scene.h"

namespace genu {

/// The middle of a mesh surface's file (m, in the file's own frame); nothing where it cannot be read.
using MeshMiddle = std::function<std::optional<Vec3>(const SurfaceDef&)>;

/// Moves the origin of each body that needs it into the middle of its points: surfaces, ends of ligaments, points of
/// loads, centre of mass and regions are then measured from there, BodyDef::centre is where it is. The axes stay. All
/// fixed bodies keep one common frame. Coordinates of joints keep their meaning, for the origins of the file. A scene
/// whose points lie within 4 times its size of their origins is left as it is. A placement may as well bring a mesh to
/// its body as away from it: `mesh_middle` tells, and is asked for those meshes alone whose body would be moved.
void centre_bodies(Scene& scene, const MeshMiddle& mesh_middle = {});

}  // namespace genu
