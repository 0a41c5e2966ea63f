#include "genu/contact/rim.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "genu/contact/tolerances.h"
#include "genu/mesh/mesh_topology.h"

namespace genu {
namespace {

constexpr double kNoClearance = std::numeric_limits<double>::infinity();

struct BorderEdge {
  int from, to, inside;  // vertices; inside: opposite
};

/// The edges of only one triangle, by their vertices.
std::vector<BorderEdge> border_of(const Mesh& mesh) {
  std::vector<BorderEdge> border;
  for (const MeshEdge& edge : mesh_edges(mesh)) {
    if (edge.count != 1) continue;
    const auto [from, to] = edge.v;
    int inside = from;
    for (const int v : mesh.triangles[at(edge.t[0])])
      if (v != from && v != to) inside = v;
    border.push_back({from, to, inside});
  }
  return border;
}

double longest_of(const std::vector<BorderEdge>& border, const Mesh& mesh) {
  double longest = 0;
  for (const auto& [from, to, inside] : border)
    longest = std::max(longest, (mesh.vertices[at(to)] - mesh.vertices[at(from)]).norm());
  return longest;
}

}  // namespace

Rim::Rim(const Surface& own, const Surface& other, double spacing, const Vec3& centre, double reach)
    : own_(&own), other_(&other), spacing_(kRimChord * spacing) {
  if (!std::isfinite(own.edge_distance(centre))) return;
  const Mesh mesh = own.triangles(spacing_, centre, reach);
  const std::vector<BorderEdge> border = border_of(mesh);
  if (!own.is_global()) spacing_ = longest_of(border, mesh);
  std::map<int, int> numbers;
  const auto on_edge = [&](int v) { return std::abs(own.edge_distance(mesh.vertices[at(v)])) < kOnRim * spacing_; };
  const auto number = [&](int v) {
    const auto [it, fresh] = numbers.emplace(v, static_cast<int>(points_.size()));
    if (fresh) points_.push_back({mesh.vertices[at(v)]});
    return it->second;
  };
  for (const auto& [from, to, inside] : border)
    if (on_edge(from) && on_edge(to)) segments_.push_back({number(from), number(to), mesh.vertices[at(inside)]});
}

void Rim::forget() {
  for (Point& point : points_) point.clearance = -1;
}

/// The gap at the point p of the rim, +infinity where the other surface does not face it. `found` receives both points.
double Rim::gap_at(const Pose& X_os, const Vec3& p, LocalMinimum* found) const {
  LocalMinimum here;
  if (!own_->project(p, here.contact.b)) return kNoClearance;
  const Vec3 x = X_os * here.contact.b.p;
  std::optional<SurfacePoint> foot;
  const auto gap = other_->gap_and_foot(x, foot);
  if (!gap || (!foot && !other_->project(x, foot.emplace()))) return kNoClearance;
  here.contact.a = *foot;
  if (here.contact.a.n.dot(X_os.R * here.contact.b.n) > kSameWayCosine) return kNoClearance;
  if (other_->edge_distance(here.contact.a.p) < 0) return kNoClearance;
  here.gap = *gap;
  if (found != nullptr) *found = here;
  return *gap;
}

double Rim::look_at(Point& point, const Pose& X_os) const {
  const Vec3 x = X_os * point.p;
  if (point.clearance - (x - point.at).norm() > kRimDip * spacing_) return kNoClearance;
  point.at = x;
  point.clearance = other_->clear_in_front(x);
  if (point.clearance > kRimDip * spacing_) return kNoClearance;
  const auto gap = other_->gap(x);
  if (!gap) return kNoClearance;
  if (other_->knows_distance()) point.clearance = *gap;
  if (!other_->is_global()) point.clearance = kFirstOrderGap * *gap;
  return *gap;
}

/// By golden-section search, on the surface over the chord, as long as it may overlap. Where both gaps are unknown the
/// lower end is where to go.
Vec3 Rim::lowest_on(const Segment& segment, const Pose& X_os) const {
  const Vec3 &from = points_[at(segment.from)].p, &to = points_[at(segment.to)].p;
  const auto place = [&](double t) { return Vec3(from + t * (to - from)); };
  const auto gap = [&](double t) { return gap_at(X_os, place(t), nullptr); };
  constexpr double kGoldenSection = 0.6180339887498949;
  double low = 0, high = 1, a = 1 - kGoldenSection, b = kGoldenSection, gap_a = gap(a), gap_b = gap(b);
  const double chord = (to - from).norm();
  const bool from_is_lower = points_[at(segment.from)].gap < points_[at(segment.to)].gap;
  for (int i = 0; i < kRimSections; ++i) {
    const double least = std::min(gap_a, gap_b);
    if (std::isfinite(least) && least >= kRimClear * (high - low) * chord) break;
    if (std::isfinite(least) ? gap_a < gap_b : from_is_lower) {
      high = std::exchange(b, a);
      gap_b = gap_a;
      a = high - kGoldenSection * (high - low);
      gap_a = gap(a);
    } else {
      low = std::exchange(a, b);
      gap_a = gap_b;
      b = low + kGoldenSection * (high - low);
      gap_b = gap(b);
    }
  }
  return place(0.5 * (low + high));
}

void Rim::scan(const Pose& X_os, std::vector<LocalMinimum>& out) {
  for (Point& point : points_) point.gap = look_at(point, X_os);
  for (const Segment& segment : segments_) {
    const double ends = std::min(points_[at(segment.from)].gap, points_[at(segment.to)].gap);
    if (!(ends < kRimDip * spacing_)) continue;
    const Vec3 lowest = lowest_on(segment, X_os);
    LocalMinimum found;
    if (!(gap_at(X_os, lowest, &found) < 0)) continue;
    const double inside = gap_at(X_os, lowest + kRimInward * (segment.inside - lowest), nullptr);
    if (inside > found.gap) out.push_back(found);
  }
}

}  // namespace genu
