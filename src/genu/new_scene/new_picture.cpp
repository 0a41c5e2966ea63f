#include "genu/new_scene/new_picture.h"

#include <map>

#include <fmt/format.h>

#include "genu/atlas/fitted_knee.h"
#include "genu/new_scene/fit_doubts.h"
#include "genu/new_scene/knee_picture.h"
#include "genu/new_scene/tolerances.h"

namespace genu {
namespace {

/// The bundle of each ligament that is in one, and its own name for others.
std::map<int, std::string> groups_of(const Scene& scene) {
  std::map<int, std::string> out;
  for (const BundleDef& bundle : scene.bundles)
    for (const int i : bundle.members) out.emplace(i, bundle.name);
  for (int i = 0; i < static_cast<int>(scene.ligaments.size()); ++i) out.emplace(i, scene.ligaments[at(i)].name);
  return out;
}

PictureEnd end_of(const Vec3& point, const Insertion* known) {
  if (!known || (known->at - point).norm() > kWrittenEnd) return {point, 0, false};
  return {point, known->error, !known->given.empty()};
}

/// Words in lines of about that many letters.
void add_lines(const std::string& text, std::size_t letters, std::vector<std::string>& out) {
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    if (!line.empty() && line.size() + end - at > letters) {
      out.push_back(line);
      line.clear();
    }
    line += (line.empty() ? "" : " ") + text.substr(at, end - at);
    at = end + 1;
  }
  if (!line.empty()) out.push_back(line);
}

/// Two meshes as one.
Mesh both(Mesh a, const Mesh& b) {
  const int before = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + before, t[1] + before, t[2] + before});
  return a;
}

}  // namespace

std::string picture_of(const NewKnee& knee, const Scene& scene) {
  const NewBones& bones = knee.bones;
  const KneeAxes axes = axes_of(knee.layout, knee.left);
  FittedKnee fitted = fit_reference_knee(bones.femur_shape(), bones.tibia_shape(), axes);
  if (bones.fibula) put_on_fibula(bones.fibula->mesh, fitted);
  const Mesh lower_leg = bones.fibula ? both(bones.tibia_shape(), bones.fibula->mesh) : bones.tibia_shape();
  KneePicture picture{{&bones.femur_shape()},
                      {&lower_leg},
                      axes.anterior,
                      axes.proximal,
                      axes.lateral,
                      axes.centre,
                      axes.width,
                      {},
                      {},
                      scene.title,
                      {}};
  if (bones.femur_bone) picture.femur.push_back(&bones.femur.mesh);
  if (bones.tibia_bone) picture.tibia.push_back(&bones.tibia.mesh);
  std::map<std::string, std::size_t> fibres;
  for (std::size_t i = 0; i < reference_knee().fibres.size(); ++i) fibres[reference_knee().fibres[i].name] = i;
  for (const auto& [i, group] : groups_of(scene)) {
    const LigamentDef& ligament = scene.ligaments[at(i)];
    const auto known = fibres.find(ligament.name);
    const bool taken = known != fibres.end() && knee.doubt.empty();
    const bool from_femur = scene.bodies[at(ligament.from.body)].name == "femur";
    const Vec3 &femur = from_femur ? ligament.from.point : ligament.to.point,
               &tibia = from_femur ? ligament.to.point : ligament.from.point;
    picture.fibres.push_back({group, end_of(femur, taken ? &fitted.femur.insertions[known->second] : nullptr),
                              end_of(tibia, taken ? &fitted.tibia.insertions[known->second] : nullptr)});
  }
  for (const auto& [name, at] : knee.landmarks.places) picture.places.emplace_back(name, at);
  add_lines(knee.doubt.empty() ? knee.choice : "DOUBTED: " + knee.doubt, 170, picture.notes);
  return knee_picture(picture);
}

}  // namespace genu
