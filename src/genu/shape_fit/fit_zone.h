// Which pieces of a mesh are contact surfaces, when nothing but the mesh is known.
//
// An open mesh is the face that was segmented; each of its sheets is a surface. A sheet that wraps round an axis and
// forks into two arms along it (femoral cartilage: the condyles on either side of the notch) is two surfaces, the arms;
// what joins them (the trochlea) belongs to the patella. A closed mesh has two faces or more, and which one is meant
// has to be said.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/mesh/mesh.h"

namespace genu {

struct ZoneOptions {
  std::optional<Vec3> facing;               ///< the way the surface looks: triangles within 70 deg of it take part
  std::function<bool(const Vec3&)> within;  ///< where triangles may lie; empty: anywhere
  bool fork = true;                         ///< whether a sheet may be split into its arms
};

/// A piece of a mesh that is one contact surface.
struct Zone {
  Mesh mesh;
  std::optional<Vec3> axis;  ///< of an arm: about which axis the sheet wraps that it is an arm of
  bool one_face = true;      ///< false where nothing keeps the faces of a closed mesh apart
};

/// The pieces, in the order of their place along the direction in which they lie farthest apart (its largest component
/// positive). Empty, with the reason under `name` in `out`, where nothing is left or the mesh is closed and neither
/// `facing` nor `within` says which face is meant.
[[nodiscard]] std::vector<Zone> find_zones(const Mesh& mesh, const ZoneOptions& options, const std::string& name,
                                           Diagnostics& out);

/// The two arms of a sheet that forks along its axis; empty for one that does not.
std::vector<Zone> arms_of(const Mesh& sheet);

/// The part of `mesh` round a path of contact: what lies within `reach` (m) of one of the points, looks the way that
/// the surface looks there (`normals`, outward), and hangs together with it.
Mesh zone_round(const Mesh& mesh, const std::vector<Vec3>& points, const std::vector<Vec3>& normals, double reach);

}  // namespace genu
