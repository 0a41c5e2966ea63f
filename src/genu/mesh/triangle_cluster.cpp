// The triangles of a tree in clusters, asked by a ray all at once in single precision, and then by all rays near it
// exactly.
#include <algorithm>
#include <cmath>

#include "genu/mesh/tolerances.h"
#include "genu/mesh/triangle_ray.h"
#include "genu/mesh/triangle_tree.h"

namespace genu {
namespace {

constexpr float kNowhere = 1e6F;  // m: where no ray comes

}  // namespace

void TriangleTree::gather_clusters() {
  std::vector<int> open = {0};
  while (!open.empty()) {
    Node& node = nodes_[static_cast<std::size_t>(open.back())];
    open.pop_back();
    if (node.last - node.first > Cluster::kSize) {
      open.push_back(node.children + 1);
      open.push_back(node.children);
      continue;
    }
    node.cluster = static_cast<int>(clusters_.size());
    Cluster& cluster = clusters_.emplace_back();
    cluster.first = node.first;
    cluster.count = node.last - node.first;
    cluster.low = node.low;
    cluster.high = node.high;
    cluster.centre = 0.5 * (node.low + node.high);
    for (auto* v : {&cluster.y, &cluster.z, &cluster.radius, &cluster.nx, &cluster.ny, &cluster.nz}) v->setZero();
    cluster.x.setConstant(kNowhere);
    for (std::size_t i = 0; i < static_cast<std::size_t>(cluster.count); ++i) {
      const std::size_t k = static_cast<std::size_t>(node.first) + i;
      const auto& c = corners_[k];
      const Vec3 middle = (c[0] + c[1] + c[2]) / 3, from = middle - cluster.centre;
      const Vec3 n = sizes_[k] > 0 ? Vec3(areas_[k] / sizes_[k]) : Vec3::Zero();
      double radius = 0;
      for (const Vec3& p : c) radius = std::max(radius, (p - middle).norm());
      const auto at = static_cast<Eigen::Index>(i);
      cluster.x[at] = static_cast<float>(from.x());
      cluster.y[at] = static_cast<float>(from.y());
      cluster.z[at] = static_cast<float>(from.z());
      cluster.radius[at] = static_cast<float>((1 + kSingleRadiusSlack) * radius);
      cluster.nx[at] = static_cast<float>(n.x());
      cluster.ny[at] = static_cast<float>(n.y());
      cluster.nz[at] = static_cast<float>(n.z());
      cluster.reach = std::max(cluster.reach, (1 + kSingleRadiusSlack) * (from.norm() + radius));
    }
  }
}

std::vector<int> TriangleTree::pieces(double size) const {
  std::vector<int> firsts;
  std::vector<int> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const Node& node = nodes_[static_cast<std::size_t>(open.back())];
    open.pop_back();
    if (node.cluster < 0 && (node.high - node.low).norm() > size) {
      open.push_back(node.children + 1);
      open.push_back(node.children);
    } else {
      firsts.push_back(node.first);
    }
  }
  firsts.push_back(this->size());
  return firsts;
}

void TriangleTree::clusters_near(const Vec3& origin, const Vec3& direction, double length, double margin,
                                 ClustersNear& out) const {
  out.balls.clear();
  out.count = 0;
  out.centre = origin;
  out.reach = 0;
  if (nodes_.empty()) return;
  const Slab slab(origin, direction, length);
  int stack[kMostDepth];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[static_cast<std::size_t>(stack[--top])];
    if (slab.entry(node.low, node.high, margin, length) == Slab::kOutside) continue;
    if (node.cluster < 0) {
      stack[top++] = node.children;
      stack[top++] = node.children + 1;
      continue;
    }
    const Cluster& cluster = clusters_[static_cast<std::size_t>(node.cluster)];
    const int i = out.count++ % ClustersNear::Balls::kSize;
    if (i == 0) {
      out.balls.emplace_back();
      out.balls.back().x.setConstant(kNowhere);
      out.balls.back().cluster.fill(-1);
      for (auto* v : {&out.balls.back().y, &out.balls.back().z, &out.balls.back().reach}) v->setZero();
    }
    ClustersNear::Balls& balls = out.balls.back();
    const Vec3 from = cluster.centre - out.centre;
    balls.x[i] = static_cast<float>(from.x());
    balls.y[i] = static_cast<float>(from.y());
    balls.z[i] = static_cast<float>(from.z());
    balls.reach[i] = static_cast<float>(cluster.reach);
    balls.cluster[static_cast<std::size_t>(i)] = node.cluster;
    out.reach = std::max(out.reach, from.norm() + cluster.reach);
  }
}

/// A ray that clusters are asked about, and the least motion that its triangles are listed for.
struct TriangleTree::Asked {
  Vec3 origin, direction;
  double length, least;
};

/// How far (m) a ray may move, at least, before it can come out of each triangle of a cluster, as far as the balls and
/// planes tell: it has to come to the ball, to be turned into the right direction, and to begin before the plane.
TriangleTree::Cluster::Floats TriangleTree::room(const Cluster& c, const Vec3& from, const Vec3& direction,
                                                 double length) {
  using Floats = Cluster::Floats;
  const Eigen::Array3f o = from.cast<float>(), d = direction.cast<float>();
  const float error = static_cast<float>(kSingleRadiusSlack * (from.norm() + length + c.reach));
  const Floats x = c.x - o[0], y = c.y - o[1], z = c.z - o[2];
  const Floats along = x * d[0] + y * d[1] + z * d[2], whole = x * x + y * y + z * z;
  const Floats t = along.max(0.0F).min(static_cast<float>(length));
  const Floats off = (whole - t * (2 * along - t) - kSingleSquareSlack * whole).max(0.0F).sqrt() - c.radius;
  const Floats behind = -(c.nx * x + c.ny * y + c.nz * z);
  const Floats turned = (c.nx * d[0] + c.ny * d[1] + c.nz * d[2]) * static_cast<float>(-0.5 * length);
  return off.max(behind).max(turned) - error;
}

/// Lowers `free` to what the triangles of a cluster leave, and adds those that are met before the least motion.
void TriangleTree::ask(int cluster, const Asked& ray, double& free, TrianglesAtRay& out) const {
  const Cluster& c = clusters_[static_cast<std::size_t>(cluster)];
  const Cluster::Floats rooms = room(c, ray.origin - c.centre, ray.direction, ray.length);
  const float smallest = rooms.minCoeff(), near = static_cast<float>((1 + kSingleRadiusSlack) * ray.least);
  if (smallest < free) {
    free = std::max(ray.least, (1 - kSingleRadiusSlack) * static_cast<double>(smallest));
    out.nearest = cluster;
  }
  if (smallest > near) return;
  const RayLine line(ray.origin, ray.direction, ray.length);
  // Sheared along the ray, distances across it grow by up to the root of 3.
  const double turn = 2 * ray.least / ray.length, aside = std::sqrt(3.0) * ray.least;
  for (int i = 0; i < c.count; ++i) {
    if (rooms[i] > near || misses(static_cast<std::size_t>(c.first + i), line, turn, aside)) continue;
    if (out.count < TrianglesAtRay::kMost) out.places[static_cast<std::size_t>(out.count)] = c.first + i;
    ++out.count;
  }
}

void TriangleTree::at_ray(const ClustersNear& clusters, const Vec3& origin, const Vec3& direction, double length,
                          double least, double most, TrianglesAtRay& out) const {
  using Balls = ClustersNear::Balls;
  const Asked ray{origin, direction, length, least};
  const Slab slab(origin, direction, length);
  const Vec3 from = origin - clusters.centre;
  const Eigen::Array3f o = from.cast<float>(), d = direction.cast<float>();
  const double error = kSingleRadiusSlack * (from.norm() + length + clusters.reach);
  double free = most;
  out.count = 0;
  // What was nearest the last time goes first: what is farther is then known to be so.
  const int first = out.nearest;
  if (first >= 0) ask(first, ray, free, out);
  for (const Balls& balls : clusters.balls) {
    const Balls::Floats x = balls.x - o[0], y = balls.y - o[1], z = balls.z - o[2];
    const Balls::Floats along = x * d[0] + y * d[1] + z * d[2], whole = x * x + y * y + z * z;
    const Balls::Floats t = along.max(0.0F).min(static_cast<float>(length));
    const Balls::Floats off = (whole - t * (2 * along - t) - kSingleSquareSlack * whole).max(0.0F).sqrt() - balls.reach;
    for (int i = 0; i < Balls::kSize; ++i) {
      const int cluster = balls.cluster[static_cast<std::size_t>(i)];
      if (!(off[i] <= free + error) || cluster == first || cluster < 0) continue;
      const Cluster& c = clusters_[static_cast<std::size_t>(cluster)];
      if (slab.entry(c.low, c.high, free, length) != Slab::kOutside) ask(cluster, ray, free, out);
    }
  }
  out.margin = free;
}

/// Whether no line comes out of a triangle that crosses the plane of the sheared coordinates within `aside` of `line`,
/// and whose direction is within `turn` of its own.
bool TriangleTree::misses(std::size_t k, const RayLine& line, double turn, double aside) const {
  if (!(areas_[k].dot(line.direction) + turn * sizes_[k] > 0)) return true;
  const auto& c = corners_[k];
  const std::array<Vec2, 3> p = {line.across(c[0]), line.across(c[1]), line.across(c[2])};
  std::array<double, 3> side;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 &a = p[i], &b = p[(i + 1) % 3];
    side[i] = a[0] * b[1] - a[1] * b[0];
  }
  const double sign = side[0] + side[1] + side[2] < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double beyond = -sign * side[i];
    if (beyond > 0 && beyond * beyond > aside * aside * (p[(i + 1) % 3] - p[i]).squaredNorm()) return true;
  }
  return false;
}

TriangleTree::Hit TriangleTree::leaving(std::span<const int> places, const Vec3& origin, const Vec3& direction,
                                        double length) const {
  const RayLine line(origin, direction, length);
  Hit best;
  for (const int place : places) meet(static_cast<std::size_t>(place), line, 1, best);
  return best;
}

TriangleTree::Hit TriangleTree::leaving(const ClustersNear& among, const Vec3& origin, const Vec3& direction,
                                        double length) const {
  const RayLine line(origin, direction, length);
  Hit best;
  each_place(among, [&](int place) { meet(static_cast<std::size_t>(place), line, 1, best); });
  return best;
}

}  // namespace genu
