#include "genu/scene/scene.h"

#include <algorithm>

namespace genu {

namespace {

bool holds(const RegionDef::Condition& c, double x) {
  switch (c.comparison) {
    case RegionDef::Comparison::less:
      return x < c.value;
    case RegionDef::Comparison::less_equal:
      return x <= c.value;
    case RegionDef::Comparison::greater:
      return x > c.value;
    case RegionDef::Comparison::greater_equal:
      return x >= c.value;
  }
  return false;
}

}  // namespace

bool RegionDef::contains(const Vec3& p) const {
  return std::all_of(conditions.begin(), conditions.end(), [&](const Condition& c) { return holds(c, p[c.axis]); });
}

std::vector<std::string> mesh_files(const SceneTables& scene) {
  std::vector<std::string> files;
  const auto add = [&](const PieceFiles& of) { files.insert(files.end(), of.paths.begin(), of.paths.end()); };
  for (const BodyDef& body : scene.bodies)
    if (body.solid) add(body.solid->file);
  for (const SurfaceDef& surface : scene.surfaces) {
    add(surface.file);
    if (surface.thickness && surface.thickness->measured) add(surface.thickness->bone);
  }
  return files;
}

std::vector<LigamentDef::End> LigamentDef::path_points() const {
  std::vector<End> out = {from};
  out.insert(out.end(), via.begin(), via.end());
  out.push_back(to);
  return out;
}

double LigamentDef::number(std::string_view key) const {
  for (const Number& n : numbers)
    if (n.key == key) return n.value;
  return 0;
}

double path_length(const LigamentDef& ligament, const std::vector<Pose>& poses) {
  double length = 0;
  const std::vector<LigamentDef::End> points = ligament.path_points();
  const auto place = [&](std::size_t k) -> Vec3 { return poses[at(points[k].body)] * points[k].point; };
  for (std::size_t k = 0; k + 1 < points.size(); ++k) length += (place(k + 1) - place(k)).norm();
  return length;
}

std::string coordinate_name(const SceneTables& scene, const CoordinateRef& c) {
  const JointDef& joint = scene.joints[static_cast<std::size_t>(c.joint)];
  const auto k = static_cast<std::size_t>(c.index);
  return joint.name + "." + (k < 3 ? joint.rotations[k].name : joint.translations[k - 3]);
}

std::string quantity_name(const SceneTables& scene, const QuantityRef& q) {
  if (q.combination < 0) return coordinate_name(scene, q.first);
  return scene.combinations[static_cast<std::size_t>(q.combination)].name;
}

}  // namespace genu
