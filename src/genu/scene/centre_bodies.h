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

/// The origin of each body (m, in the body as the file has it): the middle of its points for a body that lies far from
/// its origin in the file, else 0. All fixed bodies keep one common frame. A scene whose points lie within 4 times its
/// size of their origins keeps all of them. A placement may bring a mesh to its body as well as away from it:
/// `mesh_middle` says which, and is asked only for meshes whose body would be moved.
std::vector<Vec3> choose_origins(const Scene& scene, const MeshMiddle& mesh_middle = {});

/// The scene with the points of its bodies measured from `origins`. The axes stay, and coordinates of joints keep their
/// meaning, for the origins of the file.
PlacedScene place(const Scene& scene, const std::vector<Vec3>& origins);

/// The scene with the origins of its file.
PlacedScene place(const Scene& scene);

}  // namespace genu
