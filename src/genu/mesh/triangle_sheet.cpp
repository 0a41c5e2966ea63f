#include "genu/mesh/triangle_sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/mesh/tolerances.h"
#include "genu/mesh/triangle_ray.h"

namespace genu {
namespace {

double distance_to_segment(const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double t = along.squaredNorm() > 0 ? std::clamp(-a.dot(along) / along.squaredNorm(), 0.0, 1.0) : 0.0;
  return (a + t * along).norm();
}

}  // namespace

/// Whether a triangle lies outside of the cylinder that goes on for ever, surely.
bool TriangleSheet::Cylinder::passes_by(const std::array<Vec3, 3>& c) const {
  const Vec2 a = seen(c[0]), b = seen(c[1]), d = seen(c[2]), middle = (a + b + d) / 3;
  const double size = std::max({(a - middle).squaredNorm(), (b - middle).squaredNorm(), (d - middle).squaredNorm()});
  return middle.norm() > (1 + kSheetRounding) * radius + std::sqrt(size);
}

/// Whether a triangle lies outside, surely.
bool TriangleSheet::Cylinder::excludes(const std::array<Vec3, 3>& c) const {
  const std::array<double, 3> z = {axis.dot(c[0] - origin), axis.dot(c[1] - origin), axis.dot(c[2] - origin)};
  return std::max({z[0], z[1], z[2]}) < low || std::min({z[0], z[1], z[2]}) > high || passes_by(c);
}

/// Through the triangle in the middle, along the mean of the normals.
bool TriangleSheet::choose_axis(const TriangleTree& tree, int first, int last, double length) {
  Vec3 area = Vec3::Zero(), low = tree.corners_[at(first)][0], high = low;
  for (int k = first; k < last; ++k) {
    area += tree.areas_[at(k)];
    for (const Vec3& p : tree.corners_[at(k)]) low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  if (!(area.norm() > 0)) return false;
  const Vec3 middle = 0.5 * (low + high);
  double nearest = std::numeric_limits<double>::infinity();
  int best = first;
  for (int k = first; k < last; ++k) {
    const auto& c = tree.corners_[at(k)];
    const Vec3 centroid = (c[0] + c[1] + c[2]) / 3;
    if (const double off = (centroid - middle).norm(); off < nearest) {
      nearest = off;
      best = k;
      cylinder_.origin = centroid;
    }
  }
  cylinder_.axis = area.normalized();
  cylinder_.across = cylinder_.axis.unitOrthogonal();
  cylinder_.upward = cylinder_.axis.cross(cylinder_.across);
  double reach = 0;
  for (int k = first; k < last; ++k)
    for (const Vec3& p : tree.corners_[at(k)]) reach = std::max(reach, cylinder_.seen(p).norm());
  cylinder_.radius = reach + kSheetAside * length;
  cylinder_.roomy = cylinder_.radius - kSheetRoom * length;
  cylinder_.low = -kSheetBelow * length;
  cylinder_.high = kSheetAbove * length;
  facets_.push_back({best, {-1, -1, -1}});
  return true;
}

/// The facet of a triangle, which becomes one if it is none yet; -1 if it lies beside the cylinder.
int TriangleSheet::join(const TriangleTree& tree, int place, Marks& marks) {
  if (marks.triangle[at(place)] == marks.stamp) return marks.facet[at(place)];
  const bool beside = cylinder_.passes_by(tree.corners_[at(place)]);
  marks.triangle[at(place)] = marks.stamp;
  marks.facet[at(place)] = beside ? -1 : static_cast<int>(facets_.size());
  if (!beside) facets_.push_back({place, {-1, -1, -1}});
  return marks.facet[at(place)];
}

/// Marks the vertices of the corners whose angle holds the direction `across`: each once at most.
bool TriangleSheet::winds_once(const TriangleTree& tree, int place, Marks& marks) const {
  const auto& c = tree.corners_[at(place)];
  const Vec3& up = cylinder_.upward;
  const std::array<double, 3> y = {up.dot(c[0]), up.dot(c[1]), up.dot(c[2])};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(y[(i + 1) % 3] <= y[i] && y[(i + 2) % 3] > y[i])) continue;
    int& mark = marks.vertex[at(tree.vertices_[at(place)][i])];
    if (mark == marks.stamp) return false;
    mark = marks.stamp;
  }
  return true;
}

bool TriangleSheet::grow(const TriangleTree& tree, Marks& marks) {
  lean_ = 1;
  marks.triangle[at(facets_[0].place)] = marks.stamp;
  marks.facet[at(facets_[0].place)] = 0;
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const int place = facets_[f].place;
    const double facing = tree.areas_[at(place)].dot(cylinder_.axis), size = tree.sizes_[at(place)];
    if (!(facing > kSheetMinCosine * size) || facets_.size() > kMaxSheetFacets || !winds_once(tree, place, marks))
      return false;
    lean_ = std::min(lean_, facing / size);
    for (std::size_t i = 0; i < 3; ++i) {
      const int next = tree.beside_[at(place)][i];
      if (next >= 0) {
        const int facet = join(tree, next, marks);
        facets_[f].beside[i] = facet;
        continue;
      }
      const auto& c = tree.corners_[at(place)];
      if (distance_to_segment(cylinder_.seen(c[i]), cylinder_.seen(c[(i + 1) % 3])) <= cylinder_.radius) return false;
    }
  }
  return true;
}

/// How far off the axis rays may be: all else in the cylinder has to turn its back on them, and they have to cross the
/// graph. Both also when they are turned by a little more. False if that leaves too little.
bool TriangleSheet::choose_angle(const TriangleTree& tree, Marks& marks) {
  const Cylinder& c = cylinder_;
  tree.clusters_near(c.origin + c.low * c.axis, c.axis, c.high - c.low, (1 + kSheetRounding) * c.radius,
                     marks.clusters);
  double facing = -1;
  backs_ = -std::numeric_limits<double>::infinity();
  tree.each_place(marks.clusters, [&](int place) {
    if (marks.triangle[at(place)] == marks.stamp && marks.facet[at(place)] >= 0) return;
    const std::array<Vec3, 3>& corners = tree.corners_[at(place)];
    if (c.excludes(corners)) return;
    for (const Vec3& p : corners) backs_ = std::max(backs_, c.axis.dot(p - c.origin));
    const double size = tree.sizes_[at(place)], along = tree.areas_[at(place)].dot(c.axis);
    if (along > facing * size) facing = along / size;
  });
  const double angle = std::min(std::asin(-facing), M_PI / 2 - std::acos(lean_)) - kSheetMaxTurn - kSheetRounding;
  along_ = std::cos(angle);
  return angle > kSheetMinRayAngle;
}

void TriangleSheet::spread(const TriangleTree& tree, int first, int last, double length, Marks& marks) {
  facets_.clear();
  marks.triangle.resize(tree.corners_.size());
  marks.facet.resize(tree.corners_.size());
  marks.vertex.resize(at(tree.vertex_count_));
  ++marks.stamp;
  good_ = choose_axis(tree, first, last, length) && grow(tree, marks) && choose_angle(tree, marks);
  facets_.shrink_to_fit();
}

/// How far (m) a ray that begins at the height z and crosses the sheet at t, beyond its ends, may move and still meets
/// nothing. `aside2`: square of its largest distance from the axis.
double TriangleSheet::clearance(const RayLine& line, double t, double z, double aside2, double along) const {
  const Cylinder& c = cylinder_;
  const double inside =
      std::min({c.radius - std::sqrt(std::max(0.0, aside2)), z - c.low, c.high - z - along * line.length});
  // The nearer end of the ray lies off the graph by at least its distance times cos(lean of the normals + turn of it).
  const double off = t > 0 ? t - line.length : -t;
  const double margin = along * lean_ - std::sqrt(std::max(0.0, 1 - along * along) * (1 - lean_ * lean_));
  return std::min({off * std::max(0.0, margin), kSheetTurnShare * line.length, inside});
}

/// Of a ray whose line crosses a triangle of the sheet: it has to be in the cylinder from its start to its end or to
/// where it meets the triangle, and to cross it within the disc.
TriangleSheet::Meeting TriangleSheet::meet_facet(const TriangleTree& tree, const RayLine& line, int place,
                                                 double along) const {
  const Cylinder& c = cylinder_;
  const Vec3& plane = tree.areas_[at(place)];
  const double t = plane.dot(tree.corners_[at(place)][0] - line.origin) / plane.dot(line.direction);
  const bool met = t > 0 && t <= line.length;
  const double to = met ? t : line.length;
  const Vec3 from = line.origin - c.origin;
  const double z = c.axis.dot(from), z_to = z + to * along;
  const auto aside2 = [&](double s, double height) {
    return (from + s * line.direction).squaredNorm() - height * height;
  };
  double aside = std::max(from.squaredNorm() - z * z, aside2(to, z_to));
  if (!met) aside = std::max(aside, aside2(t, z + t * along));
  const bool between = std::min(z, z_to) >= c.low && std::max(z, z_to) <= c.high;

  Meeting out{.sure = between && aside <= c.radius * c.radius, .hit = {}, .place = place};
  out.roomy = between && aside <= c.roomy * c.roomy;
  out.alone = z > backs_ + kSheetRounding * line.length;
  if (!out.sure) return out;
  if (met)
    out.hit = {tree.triangle_[at(place)], t};
  else
    out.clear = std::max(0.0, clearance(line, t, z, aside, along));
  return out;
}

TriangleSheet::Meeting TriangleSheet::meet(const TriangleTree& tree, const Vec3& origin, const Vec3& direction,
                                           double length, int& facet) const {
  const double along = direction.dot(cylinder_.axis);
  if (along < along_) return {};
  const RayLine line(origin, direction, length);
  // Of a triangle that the ray comes out of, all three have this sign.
  const double sign = direction[line.z] > 0 ? -1 : 1;
  for (int step = 0; step < kMaxSheetSteps && facet >= 0; ++step) {
    const Facet& f = facets_[at(facet)];
    const auto& c = tree.corners_[at(f.place)];
    const Vec2 a = line.across(c[0]), b = line.across(c[1]), d = line.across(c[2]);
    const double u = sign * (d[0] * b[1] - d[1] * b[0]), v = sign * (a[0] * d[1] - a[1] * d[0]),
                 w = sign * (b[0] * a[1] - b[1] * a[0]);
    const double least = std::min({u, v, w});
    if (least < 0) {
      facet = f.beside[w == least ? 0 : u == least ? 1 : 2];
      continue;
    }
    if (least == 0) break;
    return meet_facet(tree, line, f.place, along);
  }
  facet = 0;
  return {};
}

}  // namespace genu
