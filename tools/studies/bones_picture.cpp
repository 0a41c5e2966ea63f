#include "studies/bones_picture.h"

#include "genu/assemble/build_solid.h"
#include "genu/core/units.h"
#include "genu/scene/reader.h"
#include "genu/shape_fit/solid_mesh.h"
#include "genu/study/run_motion.h"
#include "studies/mesh_picture.h"

namespace genu::studies {
namespace {

constexpr double kEdge = 5.5e-3;  // m: coarser than the committed meshes, for a small file
constexpr int kHeight = 420;

/// Angles of j1 and j2 (rad) where the tibia is flexed most.
std::pair<double, double> flexed_most(const std::string& file, Diagnostics& problems) {
  std::pair<double, double> most;
  const auto prepared = prepare(file, problems);
  if (!prepared) return most;
  const ResultTable t = solve_motion(*prepared, {}).poses;
  for (std::size_t row = 0; row < t.rows(); ++row)
    if (const double tibia = units::kDegree * t.number(row, "j1.angle_deg"); tibia > most.first)
      most = {tibia, units::kDegree * t.number(row, "j2.angle_deg")};
  return most;
}

}  // namespace

Files bones_files(const std::string& folder, Diagnostics& problems) {
  const auto shapes = read_surface_file(folder + "/bones.toml", problems);
  const auto scene = read_scene(folder + "/scene-bones.toml", problems);
  if (!shapes || !scene) return {};
  std::vector<Mesh> meshes;
  for (const SolidDef& def : shapes->solids) {
    std::string why;
    meshes.push_back(solid_mesh(make_solid(def), kEdge, why));
    if (!why.empty()) problems.error(Code::no_surface, folder + "/bones.toml", "solid." + def.name + " " + why);
  }
  // The patella's mesh is drawn about the hinge of scene.toml, (12, 30) mm.
  const Vec3 drawn(0.012, 0.03, 0);
  const auto shown = [&](double tibia, double patella) {
    std::vector<PictureMesh> out;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const std::string& name = shapes->solids[i].name;
      Pose pose;
      if (name == "tibia") pose.R = exp_rotation(Vec3(0, 0, -tibia));
      if (name == "patella") {
        const auto& place = scene->joints.back().reference;
        const Vec3 hinge(place[3], place[4], place[5]);
        pose.R = exp_rotation(Vec3(0, 0, -patella));
        pose.p = hinge + pose.R * (drawn - hinge);
      }
      out.push_back({&meshes[i], pose});
    }
    return out;
  };
  // x anterior, y superior, z lateral of a right knee.
  const PictureView front{-Vec3::UnitZ(), Vec3::UnitY()}, outer{Vec3::UnitX(), Vec3::UnitY()};
  const auto [tibia, patella] = flexed_most(folder + "/scene-bones.toml", problems);
  return {{"bones.svg", mesh_picture(shown(0, 0), {front, outer}, kHeight)},
          {"bones-flexed.svg", mesh_picture(shown(tibia, patella), {front, outer}, kHeight)}};
}

}  // namespace genu::studies
