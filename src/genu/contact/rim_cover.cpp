#include "genu/contact/rim_cover.h"

#include <algorithm>
#include <cmath>

#include "genu/contact/tolerances.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/triangle_ray.h"

namespace genu {
namespace {

/// The rate of something with gradient g at point x of the mesh (casting axes): x moves by minus the twist.
Vec6 rate_at(const Vec3& x, const Vec3& g) {
  Vec6 rate;
  rate << -g, -x.cross(g);
  return rate;
}

/// A border edge as the ray sees it: `a` and `b` across the ray, and its point nearest to the ray.
struct Seen {
  Vec3 A, B;              // m, in the casting body's frame
  Vec3 a, along;          // m, across the ray: from the ray to A, from A to B
  double from, to;        // m along the ray, of A and B
  double length2, where;  // m^2 across the ray; nearest point, 0 at A and 1 at B
  Vec3 foot;              // m, across the ray
  double off2;            // m^2: square of its distance from the ray

  Seen(const Ray& ray, const Vec3& first, const Vec3& second) : A(first), B(second) {
    const Vec3 u = A - ray.origin, v = B - ray.origin;
    from = u.dot(ray.direction);
    to = v.dot(ray.direction);
    a = u - from * ray.direction;
    along = v - to * ray.direction - a;
    length2 = along.squaredNorm();
    where = length2 > 0 ? std::clamp(-a.dot(along) / length2, 0.0, 1.0) : 0;
    foot = a + where * along;
    off2 = foot.squaredNorm();
  }

  double depth() const { return from + where * (to - from); }
  Vec3 place() const { return A + where * (B - A); }
  /// Of where the nearest point is along the edge.
  Vec6 where_rate() const {
    if (!(where > 0 && where < 1)) return Vec6::Zero();
    return rate_at(A, ((where - 1) * along + foot) / length2) + rate_at(B, -(foot + where * along) / length2);
  }
};

/// Adds the segment behind the chord of an edge to a share of the disc with radius squared r2.
void add_segment(const Seen& edge, const Vec3& direction, double r2, double& share, Vec6& rate) {
  const double middle = -edge.a.dot(edge.along) / edge.length2;
  const double half = std::sqrt(std::max(0.0, (r2 - (edge.a + middle * edge.along).squaredNorm()) / edge.length2));
  const double begin = std::max(0.0, middle - half), end = std::min(1.0, middle + half);
  if (!(begin < end)) return;
  const Vec3 c = edge.a + begin * edge.along, d = edge.a + end * edge.along;
  const double twice = direction.dot(c.cross(d));
  share -= (std::atan2(twice, c.dot(d)) - twice / r2) / (2 * M_PI);
  const Vec3 outward = edge.along.cross(direction) / (M_PI * r2);  // times the length of the edge
  const double of_b = (end * end - begin * begin) / 2;
  rate += rate_at(edge.A, (end - begin - of_b) * outward) + rate_at(edge.B, of_b * outward);
}

/// A share is found up to whole discs where the ray passes through the border: which side it is on is rounding.
void settle(double nearest2, double r2, RimCover::Cover& out) {
  if (nearest2 < kOnBorder * kOnBorder * r2) out.share -= std::floor(out.share);
  if (out.share >= 0 && out.share <= 1) return;
  out.share = std::clamp(out.share, 0.0, 1.0);
  out.share_rate.setZero();
}

}  // namespace

RimCover::RimCover(const Mesh& mesh, std::shared_ptr<const ThicknessField> thickness) {
  Mesh facets;
  facets.vertices = mesh.vertices;
  for (const MeshEdge& edge : mesh_edges(mesh)) {
    if (edge.count != 1) continue;
    const auto& t = mesh.triangles[at(edge.t[0])];
    const Vec3 &p = mesh.vertices[at(t[0])], &q = mesh.vertices[at(t[1])], &r = mesh.vertices[at(t[2])];
    const Vec3 twice = (q - p).cross(r - p);
    if (!(twice.norm() > 0)) continue;
    std::size_t i = 0;
    while (std::minmax(t[i], t[(i + 1) % 3]) != std::minmax(edge.v[0], edge.v[1])) ++i;
    const int a = t[i], b = t[(i + 1) % 3];
    edges_.push_back({mesh.vertices[at(a)], mesh.vertices[at(b)], twice.normalized(),
                      thickness ? thickness->at_vertex(a) : 0, thickness ? thickness->at_vertex(b) : 0, edge.t[0]});
    facets.triangles.push_back(t);
  }
  if (edges_.empty()) return;
  facets_ = std::make_shared<const TriangleTree>(facets);
  nodes_.push_back({Vec3::Zero(), Vec3::Zero(), 0, static_cast<int>(edges_.size())});
  for (std::size_t i = 0; i < nodes_.size(); ++i) split(static_cast<int>(i));
}

void RimCover::split(int index) {
  const int first = nodes_[at(index)].first, last = nodes_[at(index)].last;
  Vec3 low = edges_[at(first)].a, high = low;
  for (int k = first; k < last; ++k)
    for (const Vec3& p : {edges_[at(k)].a, edges_[at(k)].b}) low = low.cwiseMin(p), high = high.cwiseMax(p);
  nodes_[at(index)].low = low;
  nodes_[at(index)].high = high;
  if (last - first <= kRimLeaf) return;
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const int half = (first + last) / 2;
  const auto middle = [axis](const Edge& e) { return e.a[axis] + e.b[axis]; };
  std::nth_element(edges_.begin() + first, edges_.begin() + half, edges_.begin() + last,
                   [&](const Edge& e, const Edge& f) {
                     const double x = middle(e), y = middle(f);
                     return x < y || (x == y && e.triangle < f.triangle);
                   });
  nodes_[at(index)].children = static_cast<int>(nodes_.size());
  nodes_.push_back({Vec3::Zero(), Vec3::Zero(), first, half});
  nodes_.push_back({Vec3::Zero(), Vec3::Zero(), half, last});
}

/// Calls visit(edge) for every edge within `radius` of a segment given in the mesh's frame, and for some others.
template <typename Visit>
void RimCover::each_near(const Ray& ray, double length, double radius, Visit visit) const {
  const Slab slab(ray.origin, ray.direction, length);
  int stack[kMostDepth];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[at(stack[--top])];
    if (slab.entry(node.low, node.high, radius, length) == Slab::kOutside) continue;
    if (node.children >= 0) {
      stack[top++] = node.children + 1;
      stack[top++] = node.children;
      continue;
    }
    for (int k = node.first; k < node.last; ++k) visit(edges_[at(k)]);
  }
}

/// Calls visit(edge, seen) for every border edge that the disc sees the outward side of, within the ray's reach and
/// kRimDepth radii before its start.
template <typename Visit>
void RimCover::each_seen(const Pose& X_TC, const Disc& disc, Visit visit) const {
  const Pose X_CT = X_TC.inverse();
  const Vec3 direction = X_TC.R * disc.ray.direction;
  const double r2 = disc.radius * disc.radius;
  const double lead = kRimDepth * disc.radius;
  const Vec3 start = X_TC * disc.ray.origin - lead * direction;
  each_near({start, direction}, lead + disc.length, (1 + kOnBorder) * disc.radius, [&](const Edge& edge) {
    if (!(edge.normal.dot(direction) > 0)) return;
    const Seen seen(disc.ray, X_CT * edge.a, X_CT * edge.b);
    if (!(seen.off2 < r2 && seen.length2 > 0)) return;
    if (const double depth = seen.depth(); depth >= -lead && depth <= disc.length) visit(edge, seen);
  });
}

RimCover::Cover RimCover::over(const Pose& X_TC, const Disc& disc, double hit) const {
  Cover out;
  out.share = 1;
  const double r2 = disc.radius * disc.radius;
  double nearest = r2;
  each_seen(X_TC, disc, [&](const Edge& edge, const Seen& seen) {
    if (std::abs(seen.depth() - hit) > kRimDepth * disc.radius) return;
    add_segment(seen, disc.ray.direction, r2, out.share, out.share_rate);
    if (seen.off2 >= nearest) return;
    nearest = seen.off2;
    out.triangle = edge.triangle;
  });
  settle(nearest, r2, out);
  return out;
}

RimCover::Cover RimCover::beside(const Pose& X_TC, const Disc& disc) const {
  Cover out;
  const double r2 = disc.radius * disc.radius;
  // Sums of the weights m, and of m times depth and thickness less those of the first edge, with their rates.
  double nearest = r2, m = 0, depth = 0, thickness = 0, first_depth = 0, first_thickness = 0;
  Vec6 m_rate = Vec6::Zero();
  each_seen(X_TC, disc, [&](const Edge& edge, const Seen& seen) {
    add_segment(seen, disc.ray.direction, r2, out.share, out.share_rate);
    const double h = edge.h_a + seen.where * (edge.h_b - edge.h_a);
    if (m == 0) {
      first_depth = seen.depth();
      first_thickness = h;
    }
    const double q = std::max(seen.off2, kOnBorder * kOnBorder * r2), past = r2 / q - 1, weight = past * past;
    const double d = seen.depth() - first_depth, e = h - first_thickness;
    const Vec6 weight_rate = rate_at(seen.place(), -4 * past * r2 / (q * q) * seen.foot), where = seen.where_rate();
    m += weight;
    depth += weight * d;
    thickness += weight * e;
    m_rate += weight_rate;
    out.depth_rate +=
        d * weight_rate + weight * (rate_at(seen.place(), disc.ray.direction) + (seen.to - seen.from) * where);
    out.thickness_rate += e * weight_rate + weight * (edge.h_b - edge.h_a) * where;
    if (seen.off2 >= nearest) return;
    nearest = seen.off2;
    out.triangle = edge.triangle;
  });
  if (!(m > 0)) return {};
  out.depth_rate = (out.depth_rate - depth / m * m_rate) / m;
  out.thickness_rate = (out.thickness_rate - thickness / m * m_rate) / m;
  out.depth = first_depth + depth / m;
  out.thickness = first_thickness + thickness / m;
  settle(nearest, r2, out);
  return out;
}

}  // namespace genu
