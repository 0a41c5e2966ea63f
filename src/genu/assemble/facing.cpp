#include "genu/assemble/facing.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/assemble/tolerances.h"
#include "genu/mesh/mesh_check.h"
#include "genu/mesh/triangle_tree.h"
#include "genu/model/state.h"

namespace genu {
namespace {

enum class Met { ahead, behind, same };

struct Meeting {
  double distance;  ///< m
  Met met;
  Vec3 from;
};

/// What the lines along the normals of `a` meet of `b` first.
std::vector<Meeting> meetings(const Mesh& a, const Mesh& b) {
  const BoundingBox box = bounding_box(a);
  const double reach = (box.high - box.low).norm();
  const TriangleTree tree(b);
  const std::size_t stride = 1 + a.triangles.size() / kMaxFacingLines;
  std::vector<Meeting> out;
  for (std::size_t k = 0; k < a.triangles.size(); k += stride) {
    const auto& t = a.triangles[k];
    const Vec3 &p = a.vertices[at(t[0])], &q = a.vertices[at(t[1])], &r = a.vertices[at(t[2])];
    const Vec3 x = (p + q + r) / 3, area = (q - p).cross(r - p);
    if (!(area.norm() > 0)) continue;
    const Vec3 n = area.normalized();
    std::optional<Meeting> first;
    const auto consider = [&](const TriangleTree::Hit& hit, Met met) {
      if (hit && (!first || hit.distance < first->distance)) first = Meeting{hit.distance, met, x};
    };
    consider(tree.entering(x, n, reach), Met::ahead);
    consider(tree.leaving(x, -n, reach), Met::behind);
    consider(tree.leaving(x, n, reach), Met::same);
    consider(tree.entering(x, -n, reach), Met::same);
    if (first) out.push_back(*first);
  }
  return out;
}

std::size_t count(const std::vector<Meeting>& all, Met met) {
  return static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [met](const Meeting& m) { return m.met == met; }));
}

/// Whether the distance grows from the middle outward: that between two bones does, that of an overlap falls.
bool widens(std::vector<Meeting> all) {
  Vec3 middle = Vec3::Zero();
  for (const Meeting& m : all) middle += m.from / static_cast<double>(all.size());
  std::sort(all.begin(), all.end(), [&](const Meeting& p, const Meeting& q) {
    return (p.from - middle).squaredNorm() < (q.from - middle).squaredNorm();
  });
  const std::size_t part = all.size() / 3;
  double inner = 0, outer = 0;
  for (std::size_t i = 0; i < part; ++i) {
    inner += all[i].distance;
    outer += all[all.size() - 1 - i].distance;
  }
  return inner < kWideningShare * outer;
}

/// The triangles of a pair's surface in the frame of another body; of what has no end those near `centre`.
Mesh triangles_of(const Surface& surface, double size, const Vec3& centre, const Pose& pose) {
  Mesh mesh = surface.triangles(size / kFacingTriangles, pose.inverse() * centre, 2 * size);
  for (Vec3& v : mesh.vertices) v = pose * v;
  return mesh;
}

Facing facing_of(const JointModel::Pair& pair, bool open_a, const State& start) {
  const Surface& open = open_a ? *pair.a : *pair.b;
  const Surface& other = open_a ? *pair.b : *pair.a;
  const Pose &of_open = start.poses[at(open_a ? pair.body_a : pair.body_b)],
             &of_other = start.poses[at(open_a ? pair.body_b : pair.body_a)];
  const Mesh a = triangles_of(open, 0.1, Vec3::Zero(), of_other.inverse() * of_open);
  if (a.vertices.empty()) return Facing::unknown;
  const BoundingBox box = bounding_box(a);
  return how_they_face(a, triangles_of(other, (box.high - box.low).norm(), 0.5 * (box.low + box.high), Pose{}));
}

}  // namespace

Facing how_they_face(const Mesh& a, const Mesh& b) {
  std::vector<Meeting> all = meetings(a, b);
  if (all.size() < kMinFacingLines) return Facing::unknown;
  std::stable_sort(all.begin(), all.end(), [](const Meeting& p, const Meeting& q) { return p.distance < q.distance; });
  const std::vector<Meeting> nearest(
      all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::max(kMinFacingLines, all.size() / 10)));
  if (static_cast<double>(count(nearest, Met::same)) > kFacingShare * static_cast<double>(nearest.size()))
    return Facing::same_way;
  if (count(all, Met::ahead) > 0) return Facing::opposed;
  std::erase_if(all, [](const Meeting& m) { return m.met != Met::behind; });
  return all.size() >= kMinFacingLines && widens(all) ? Facing::away : Facing::opposed;
}

std::vector<std::string> facing_problems(const PlacedScene& scene, const JointModel& model,
                                         const std::vector<bool>& open) {
  std::vector<std::string> out;
  const State start = start_state(model);
  const auto examine = [&](const ContactDef& def, const JointModel::Pair& pair, bool rigid) {
    const bool open_a = open[at(def.surface_a)], open_b = open[at(def.surface_b)];
    if (!open_a && !open_b) return;
    const Facing facing = facing_of(pair, open_a, start);
    const std::string &a = scene.surfaces[at(def.surface_a)].name, &b = scene.surfaces[at(def.surface_b)].name;
    if (facing == Facing::away)
      out.push_back(fmt::format(
          "the outward sides of {} and {} (contact {}) face away from each other at the start, so the bodies would "
          "pass through each other: set inside = true for both surfaces, or turn the triangles of their files round; "
          "where one body starts inside the other, correct its `start`",
          a, b, def.name));
    const std::string suspect = open_a && open_b ? "one of them" : open_a ? a : b;
    if (facing == Facing::same_way && rigid)  // of layers the poses tell more (facing_doubts)
      out.push_back(fmt::format(
          "{} and {} (contact {}) face the same way where they are nearest at the start, so they cannot press on each "
          "other: set inside = true for {}, or turn the triangles of its file round",
          a, b, def.name, suspect));
  };
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) examine(scene.contacts[i], model.pairs[i], true);
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    const JointModel::Layer& layer = model.layers[i];
    examine(scene.layers[i].pair, {layer.name, layer.body_a, layer.body_b, layer.a, layer.b}, false);
  }
  return out;
}

}  // namespace genu
