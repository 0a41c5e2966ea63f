#include "genu/assemble/read_bones.h"

#include "genu/assemble/mesh_diagnostics.h"
#include "genu/contact/bone_thickness.h"
#include "genu/core/length_units.h"
#include "genu/mesh/mesh_check.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh_care/mesh_shape.h"

namespace genu {
namespace {

std::shared_ptr<const BoneUnder> read_bone(const PlacedScene& scene, const SurfaceDef& surface, MeshLibrary& meshes,
                                           Diagnostics& out) {
  const SurfaceDef::Thickness& thickness = *surface.thickness;
  Diagnostics found;
  auto mesh = meshes.read(thickness.bone, thickness.bone_unit, found);
  if (mesh) check_scale(check_mesh(*mesh), thickness.bone.text(), length_unit_name(thickness.bone_unit), found);
  add_at_key(scene, "surface." + surface.name + ".thickness.bone", thickness.bone, found, out);
  if (!mesh || found.has_errors()) return nullptr;
  make_winding_consistent(*mesh, mesh_edges(*mesh));
  turn_odd_pieces(*mesh);
  for (Vec3& v : mesh->vertices) v = surface.placement * v;
  BoneUnder bone;
  bone.triangles = std::make_shared<const TriangleTree>(*mesh);
  bone.least = thickness.least;
  bone.most = thickness.most;
  return std::make_shared<const BoneUnder>(std::move(bone));
}

}  // namespace

Bones read_bones(const PlacedScene& scene, MeshLibrary& meshes, Diagnostics& out) {
  Bones bones;
  for (const SurfaceDef& surface : scene.surfaces)
    bones.push_back(surface.thickness && surface.thickness->measured ? read_bone(scene, surface, meshes, out)
                                                                     : nullptr);
  return bones;
}

}  // namespace genu
