#include "genu/study/anatomy_doubts.h"

#include <fmt/format.h>

#include "genu/study/layout_doubts.h"

namespace genu {
namespace {

/// The meshes of both bones that are in contact, at the reference coordinates in the tibia's anatomical axes: x
/// anterior, y proximal.
struct Bones {
  Mesh femur, tibia;
};

void add(const Mesh& part, const Pose& pose, Mesh& mesh) {
  const int base = static_cast<int>(mesh.vertices.size());
  for (const Vec3& v : part.vertices) mesh.vertices.push_back(pose * v);
  for (const auto& t : part.triangles) mesh.triangles.push_back({base + t[0], base + t[1], base + t[2]});
}

Bones bones_of(const Prepared& prepared, const GroodSuntayDef& def) {
  Bones bones;
  Pose anatomical = prepared.model.reference_poses[at(def.tibia.body)];
  Mat3 axes;
  axes << def.tibia.anterior, def.tibia.proximal, def.tibia.anterior.cross(def.tibia.proximal);
  anatomical.R = anatomical.R * axes;
  const auto& defs = prepared.scene.surfaces;
  const auto add_side = [&](int surface) {
    const int body = defs[at(surface)].body;
    if (defs[at(surface)].shape != SurfaceDef::Shape::mesh) return;
    add(prepared.surfaces[at(surface)]->triangles(0, Vec3::Zero(), 0),
        anatomical.inverse() * prepared.model.reference_poses[at(body)],
        body == def.femur.body ? bones.femur : bones.tibia);
  };
  const auto add_pair = [&](const ContactDef& pair) {
    const int a = defs[at(pair.surface_a)].body, b = defs[at(pair.surface_b)].body;
    if (std::minmax(a, b) != std::minmax(def.femur.body, def.tibia.body)) return;
    add_side(pair.surface_a);
    add_side(pair.surface_b);
  };
  for (const ContactDef& contact : prepared.scene.contacts) add_pair(contact);
  for (const LayerDef& layer : prepared.scene.layers) add_pair(layer.pair);
  return bones;
}

double mean_height(const Mesh& mesh) {
  double sum = 0;
  for (const Vec3& v : mesh.vertices) sum += v.y();
  return sum / static_cast<double>(mesh.vertices.size());
}

void warn_about(const Prepared& prepared, const JointDef& joint, Diagnostics& out) {
  const GroodSuntayDef& def = *joint.grood_suntay;
  const Bones bones = bones_of(prepared, def);
  if (bones.femur.triangles.empty() || bones.tibia.triangles.empty()) return;
  const auto warn = [&](const std::string& what) {
    out.add(warning_at({prepared.scene.file, joint.where}, Code::layout, "joint." + joint.name + ".grood_suntay", {},
                       what));
  };
  if (mean_height(bones.femur) < mean_height(bones.tibia))
    return warn(
        "the femur lies below the tibia along `proximal`: are the two swapped, or is `proximal` the other way?");
  const auto knee = lay_out_knee(bones.femur, bones.tibia, Vec3::UnitY(), Vec3::UnitX());
  if (!knee) return;
  if (const auto left = seems_left(*knee); left && *left == def.right)
    warn(fmt::format("`side` is \"{}\", and the bones look like a {} knee: {}", def.right ? "right" : "left",
                     *left ? "left" : "right", why_this_side(*knee)));
}

}  // namespace

void warn_about_anatomy(const Prepared& prepared, Diagnostics& out) {
  for (const JointDef& joint : prepared.scene.joints)
    if (joint.grood_suntay && !joint.grood_suntay->patella) warn_about(prepared, joint, out);
}

}  // namespace genu
