#include "genu/scene/centre_bodies.h"

#include <algorithm>
#include <cmath>

#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"

namespace genu {
namespace {

/// Calls visit(body, point) for every point that a scene fixes to a body.
template <typename Visit>
void for_points(PlacedScene& scene, Visit visit) {
  const auto of_tables = [&](auto& defs) {
    for (std::size_t i = 0; i < defs.size(); ++i)
      for (const auto& number : kind_of(defs[i]).numbers) {
        if (number.frame == nullptr) continue;
        const int frame = number.frame(defs[i]);
        visit(frame == kItself ? static_cast<int>(i) : frame, Eigen::Map<Vec3>(number.values(defs[i])));
      }
  };
  of_tables(scene.surfaces);
  of_tables(scene.loads);
  of_tables(scene.joints);
  of_tables(scene.bodies);
  for (auto& l : scene.ligaments) LigamentDef::for_each_end(l, [&](auto& end) { visit(end.body, end.point); });
  for (auto& b : scene.bushings)
    for (auto* frame : {&b.from, &b.to}) visit(frame->body, frame->placement.p);
  for (auto& l : scene.loads)
    for (PathEnd& end : l.points) visit(end.body, end.point);
  for (auto& j : scene.joints) {
    if (!j.grood_suntay) continue;
    visit(j.grood_suntay->femur.body, j.grood_suntay->femur.origin);
    visit(j.grood_suntay->tibia.body, j.grood_suntay->tibia.origin);
  }
}

/// The points of a load, those of its last numbers first. One that the file may leave out tells nothing where it is 0.
void add_points(const LoadDef& load, std::vector<std::vector<Vec3>>& points) {
  const auto numbers = kind_of(load).numbers;
  for (auto number = numbers.rbegin(); number != numbers.rend(); ++number) {
    if (number->frame == nullptr) continue;
    const Vec3 point = Eigen::Map<const Vec3>(number->values_of(load));
    if (number->row.presence == NumberRow::Presence::required || !point.isZero(0))
      points[at(number->frame(load))].push_back(point);
  }
}

/// What lies on each body: a load without a point of its own is felt at the origin of the file, which says nothing of
/// where the body is, and so is a mesh whose placement leaves it where its file has it. `known[i]` is the middle of
/// surface i in its own frame, its origin if unknown.
std::vector<std::vector<Vec3>> telling_points(const SceneTables& scene, const std::vector<Vec3>& known) {
  std::vector<std::vector<Vec3>> points(scene.bodies.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    const SurfaceDef& s = scene.surfaces[i];
    if (s.shape != SurfaceDef::Shape::mesh || !s.placement.p.isZero(0))
      points[at(s.body)].push_back(s.placement * known[i]);
  }
  for (const LigamentDef& l : scene.ligaments)
    LigamentDef::for_each_end(l, [&](const auto& end) { points[at(end.body)].push_back(end.point); });
  for (const BushingDef& b : scene.bushings)
    for (const auto* frame : {&b.from, &b.to}) points[at(frame->body)].push_back(frame->placement.p);
  for (const LoadDef& l : scene.loads) add_points(l, points);
  for (const LoadDef& l : scene.loads)
    for (const PathEnd& end : l.points) points[at(end.body)].push_back(end.point);
  for (const JointDef& j : scene.joints) {
    if (j.type == JointDef::Type::free) continue;  // a hinge is a point of both
    points[at(j.parent)].emplace_back(j.reference[3], j.reference[4], j.reference[5]);
    points[at(j.child)].push_back(Vec3::Zero());
  }
  return points;
}

Vec3 mean(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// How large things are: what is farthest from the middle of its body, and the largest of the sizes given as such.
double size_of(const SceneTables& scene, const std::vector<std::vector<Vec3>>& points) {
  double size = kMinSceneSize;
  for (const auto& of_body : points)
    for (const Vec3& p : of_body) size = std::max(size, (p - mean(of_body)).norm());
  for (const SurfaceDef& s : scene.surfaces)
    for (const NumberOf<SurfaceDef>& number : kind_of(s).numbers)
      if (number.row.unit == Unit::length && number.frame == nullptr)
        size = std::max(size, *std::max_element(number.values_of(s), number.values_of(s) + number.row.size));
  return size;
}

/// The middle of each body's points; of a body without points, and of the world without points on fixed bodies, what
/// lies at the middle of all others in the reference pose.
std::vector<Vec3> middles(const SceneTables& scene, const std::vector<std::vector<Vec3>>& points) {
  const std::vector<Pose> poses = reference_poses(scene);
  std::vector<Vec3> in_world, on_fixed, out(scene.bodies.size(), Vec3::Zero());
  for (std::size_t b = 0; b < points.size(); ++b)
    for (const Vec3& p : points[b]) {
      in_world.push_back(poses[b] * p);
      if (scene.bodies[b].fixed) on_fixed.push_back(p);
    }
  if (in_world.empty()) return out;
  const Vec3 all = mean(in_world);
  for (std::size_t b = 0; b < points.size(); ++b) {
    const std::vector<Vec3>& own = scene.bodies[b].fixed ? on_fixed : points[b];
    out[b] = own.empty() ? poses[b].inverse() * all : mean(own);
  }
  return out;
}

/// The middles of those bodies that lie far from their origins, 0 for the others.
std::vector<Vec3> far_middles(const SceneTables& scene, const std::vector<Vec3>& known) {
  const auto points = telling_points(scene, known);
  const double far = kFarFromCentre * size_of(scene, points);
  std::vector<Vec3> centres = middles(scene, points);
  for (Vec3& centre : centres)
    if (centre.norm() <= far) centre.setZero();
  return centres;
}

}  // namespace

std::vector<Vec3> choose_origins(const Scene& scene, const MeshMiddle& mesh_middle) {
  std::vector<Vec3> known(scene.surfaces.size(), Vec3::Zero());
  std::vector<Vec3> centres = far_middles(scene, known);
  bool found = false;
  for (std::size_t i = 0; mesh_middle && i < known.size(); ++i) {
    const SurfaceDef& s = scene.surfaces[i];
    if (s.shape != SurfaceDef::Shape::mesh || s.placement.p.isZero(0) || centres[at(s.body)].isZero(0)) continue;
    const std::optional<Vec3> middle = mesh_middle(s);
    if (middle) known[i] = *middle;
    found = found || middle;
  }
  if (found) centres = far_middles(scene, known);
  return centres;
}

PlacedScene place(const Scene& scene, const std::vector<Vec3>& origins) {
  PlacedScene placed{scene, origins};
  for_points(placed, [&](int body, auto&& point) { point -= origins[at(body)]; });
  const auto move_regions = [&](ContactDef& c) {
    for (RegionDef& region : c.regions)
      for (auto& condition : region.conditions)
        condition.value -= origins[at(placed.surfaces[at(c.surface_b)].body)][condition.axis];
  };
  for (ContactDef& c : placed.contacts) move_regions(c);
  for (LayerDef& layer : placed.layers) move_regions(layer.pair);
  return placed;
}

PlacedScene place(const Scene& scene) { return place(scene, std::vector<Vec3>(scene.bodies.size(), Vec3::Zero())); }

}  // namespace genu
