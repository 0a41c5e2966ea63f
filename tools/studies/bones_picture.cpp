#include "studies/bones_picture.h"

#include "genu/assemble/build_solid.h"
#include "genu/scene/reader.h"
#include "genu/shape_fit/solid_mesh.h"
#include "studies/mesh_picture.h"

namespace genu::studies {

Files bones_files(const std::string& folder, Diagnostics& problems) {
  constexpr double kEdge = 5.5e-3;  // m: coarser than the committed meshes, for a small file
  constexpr int kHeight = 420;
  const Vec3 patella(0.012, 0.03, 0);  // where j2 puts it; the others stand at j1
  const auto scene = read_surface_file(folder + "/bones.toml", problems);
  if (!scene) return {};
  std::vector<Mesh> meshes;
  for (const SolidDef& def : scene->solids) {
    std::string why;
    meshes.push_back(solid_mesh(make_solid(def), kEdge, why));
    if (!why.empty()) problems.error(Code::no_surface, folder + "/bones.toml", "solid." + def.name + " " + why);
  }
  std::vector<PictureMesh> shown;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    shown.push_back(
        {&meshes[i], {Mat3::Identity(), scene->solids[i].name == "patella" ? patella : Vec3(Vec3::Zero())}});
  // x anterior, y superior, z lateral of a right knee.
  const PictureView front{-Vec3::UnitZ(), Vec3::UnitY()}, outer{Vec3::UnitX(), Vec3::UnitY()};
  return {{"bones.svg", mesh_picture(shown, {front, outer}, kHeight)}};
}

}  // namespace genu::studies
