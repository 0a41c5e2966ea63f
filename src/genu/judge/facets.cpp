#include "genu/judge/facets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "genu/judge/tolerances.h"
#include "genu/judge/winding.h"

namespace genu::judge {
namespace {

/// The point of a triangle nearest to x, and its feature: -1 inside, k on the edge from corner k, 3 + k at corner k.
struct OnTriangle {
  Vec3 p;
  int feature = -1;
};

OnTriangle nearest_on(const std::array<Vec3, 3>& c, const Vec3& x) {
  const Vec3 n = (c[1] - c[0]).cross(c[2] - c[0]);
  bool inside = n.squaredNorm() > 0;
  for (std::size_t k = 0; k < 3 && inside; ++k) {
    const Vec3 side = c[(k + 1) % 3] - c[k];
    inside = n.cross(side).dot(x - c[k]) >= 0;
  }
  if (inside) return {x - n.dot(x - c[0]) / n.squaredNorm() * n, -1};
  OnTriangle best{c[0], 3};
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vec3 &a = c[at(k)], &b = c[at((k + 1) % 3)];
    const double t = std::clamp((x - a).dot(b - a) / std::max((b - a).squaredNorm(), 1e-300), 0.0, 1.0);
    const Vec3 p = a + t * (b - a);
    if ((x - p).squaredNorm() >= least) continue;
    least = (x - p).squaredNorm();
    best = {p, t == 0 ? 3 + k : t == 1 ? 3 + (k + 1) % 3 : k};
  }
  return best;
}

}  // namespace

std::size_t Facets::Hash::operator()(const Cell& c) const {
  std::size_t h = 0;
  for (const int i : c) h = h * 1000003u + static_cast<std::size_t>(i + 100000);
  return h;
}

Facets::Facets(const Mesh& mesh, const SurfaceDef& def) : def_(&def), triangles_(mesh.triangles) {
  for (const Vec3& v : mesh.vertices) vertices_.push_back(def.placement * v);
  align_winding(vertices_, triangles_);
  if (def.inside)
    for (auto& t : triangles_) std::swap(t[1], t[2]);
  else
    turn_closed_outward(vertices_, triangles_);
  for (const auto& [a, b, c] : triangles_)
    areas_.push_back(0.5 * (vertices_[at(b)] - vertices_[at(a)]).cross(vertices_[at(c)] - vertices_[at(a)]));
  double sum = 0;
  for (const auto& t : triangles_)
    for (std::size_t k = 0; k < 3; ++k) sum += (vertices_[at(t[k])] - vertices_[at(t[(k + 1) % 3])]).norm();
  edge_ = sum / (3 * std::max(1.0, static_cast<double>(triangles_.size())));
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  if (!vertices_.empty()) low = high = vertices_[0];
  for (const Vec3& v : vertices_) low = low.cwiseMin(v), high = high.cwiseMax(v);
  cell_ = std::max({edge_, (high - low).maxCoeff() / kMostCellsAcross, 1e-9});
  const Vec3 margin = Vec3::Constant(2 * kCellMargin * cell_);
  first_cell_ = cell_of(low - margin);
  const Cell last = cell_of(high + margin);
  for (std::size_t i = 0; i < 3; ++i) cells_across_[i] = last[i] - first_cell_[i] + 1;
  occupied_.assign(at(cells_across_[0]) * at(cells_across_[1]) * at(cells_across_[2]), false);
  index();
  find_normals();
}

Facets::Cell Facets::cell_of(const Vec3& x) const {
  return {static_cast<int>(std::floor(x.x() / cell_)), static_cast<int>(std::floor(x.y() / cell_)),
          static_cast<int>(std::floor(x.z() / cell_))};
}

/// Index of a cell among all in the box of the mesh; empty beside it.
std::optional<std::size_t> Facets::number(const Cell& cell) const {
  std::size_t out = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int k = cell[i] - first_cell_[i];
    if (k < 0 || k >= cells_across_[i]) return std::nullopt;
    out = out * at(cells_across_[i]) + at(k);
  }
  return out;
}

void Facets::index() {
  std::vector<Clearance::Box> boxes;
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
    const auto& c = triangles_[at(t)];
    const Vec3 &a = vertices_[at(c[0])], &b = vertices_[at(c[1])], &d = vertices_[at(c[2])];
    const Vec3 middle = centroid(t);
    balls_.emplace_back(middle, std::max({(a - middle).norm(), (b - middle).norm(), (d - middle).norm()}));
    // A little larger: a ray that passes along the faces of cells meets the triangle in either.
    const double margin = kCellMargin * cell_;
    boxes.push_back({a.cwiseMin(b).cwiseMin(d).array() - margin, a.cwiseMax(b).cwiseMax(d).array() + margin});
    const Cell low = cell_of(boxes.back().low), high = cell_of(boxes.back().high);
    for (int i = low[0]; i <= high[0]; ++i)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int k = low[2]; k <= high[2]; ++k) {
          cells_[{i, j, k}].push_back(t);
          occupied_[*number({i, j, k})] = true;
        }
  }
  clearance_ = Clearance(boxes);
  const int reach = static_cast<int>(std::ceil(kOverlapReach * edge_ / cell_));
  for (const auto& [cell, triangles] : cells_)
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j)
        for (int k = -reach; k <= reach; ++k) near_cells_.insert({cell[0] + i, cell[1] + j, cell[2] + k});
}

/// Normals at edges and corners that separate inside from outside (Baerentzen and Aanaes 2005): angle-weighted sums.
void Facets::find_normals() {
  vertex_normals_.assign(vertices_.size(), Vec3::Zero());
  edge_normals_.resize(triangles_.size());
  border_edge_.resize(triangles_.size());
  border_vertex_.assign(vertices_.size(), false);
  std::map<std::pair<int, int>, std::pair<Vec3, int>> edges;
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
    const auto& c = triangles_[at(t)];
    const Vec3 n = area(t).normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 one = vertices_[at(c[(k + 1) % 3])] - vertices_[at(c[k])];
      const Vec3 other = vertices_[at(c[(k + 2) % 3])] - vertices_[at(c[k])];
      vertex_normals_[at(c[k])] += std::atan2(one.cross(other).norm(), one.dot(other)) * n;
      auto& [sum, count] = edges.try_emplace(std::minmax(c[k], c[(k + 1) % 3]), Vec3::Zero(), 0).first->second;
      sum += n;
      ++count;
    }
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
      const auto& [sum, count] = edges.at(std::minmax(a, b));
      edge_normals_[t][k] = sum;
      border_edge_[t][k] = count == 1;
      if (count != 1) continue;
      border_vertex_[at(a)] = border_vertex_[at(b)] = true;
      rim_.add({vertices_[at(a)], vertices_[at(b)], area(static_cast<int>(t))});
    }
}

Vec3 Facets::centroid(int triangle) const {
  const auto& c = triangles_[at(triangle)];
  return (vertices_[at(c[0])] + vertices_[at(c[1])] + vertices_[at(c[2])]) / 3;
}

template <typename Visit>
void Facets::each_near(const Vec3& low, const Vec3& high, Visit visit) const {
  const Cell from = cell_of(low), to = cell_of(high);
  for (int i = from[0]; i <= to[0]; ++i)
    for (int j = from[1]; j <= to[1]; ++j)
      for (int k = from[2]; k <= to[2]; ++k)
        if (const auto found = cells_.find({i, j, k}); found != cells_.end())
          for (const int t : found->second) visit(t);
}

std::optional<Facets::Nearest> Facets::nearest(const Vec3& x, double reach) const {
  Nearest best;
  int feature = -1;
  // Rings of cells, until the nearest found is closer than any cell not visited.
  for (double r = std::min(cell_, reach);; r = std::min(2 * r, reach)) {
    double least = std::numeric_limits<double>::infinity();
    each_near(x.array() - r, x.array() + r, [&](int t) {
      if ((x - balls_[at(t)].first).norm() - balls_[at(t)].second >= least) return;
      const auto& c = triangles_[at(t)];
      const OnTriangle on = nearest_on({vertices_[at(c[0])], vertices_[at(c[1])], vertices_[at(c[2])]}, x);
      const double d = (x - on.p).norm();
      if (d >= least) return;
      least = d;
      feature = on.feature;
      best = {d, on.p, t, false};
    });
    if (least <= r) break;
    if (r >= reach) return std::nullopt;
  }
  const auto& c = triangles_[at(best.triangle)];
  Vec3 n = area(best.triangle);
  if (feature >= 3) {
    n = vertex_normals_[at(c[at(feature - 3)])];
    best.at_border = border_vertex_[at(c[at(feature - 3)])];
  } else if (feature >= 0) {
    n = edge_normals_[at(best.triangle)][at(feature)];
    best.at_border = border_edge_[at(best.triangle)][at(feature)];
  }
  if (n.dot(x - best.p) < 0) best.distance = -best.distance;
  return best;
}

/// Calls visit(triangle, m along the ray, normal . ray) for every triangle that a ray passes through, some repeatedly,
/// in the cells along it, and after each cell enough(m along the ray to its end): where that is true no more are
/// needed.
template <typename Visit, typename Enough>
void Facets::each_crossed(const Vec3& origin, const Vec3& direction, double length, Visit visit, Enough enough) const {
  if (!origin.allFinite() || !direction.allFinite()) return;
  Cell cell = cell_of(origin);
  const auto next = [&](std::size_t i) {  // m along the ray to the cell's end in this direction
    const auto axis = static_cast<Eigen::Index>(i);
    if (direction[axis] == 0) return std::numeric_limits<double>::infinity();
    return ((cell[i] + (direction[axis] > 0 ? 1 : 0)) * cell_ - origin[axis]) / direction[axis];
  };
  std::array<double, 3> ends{next(0), next(1), next(2)};
  while (true) {
    if (const auto here = number(cell); here && occupied_[*here])
      for (const int t : cells_.at(cell)) cross(t, origin, direction, length, visit);
    const std::size_t i = ends[0] <= ends[1] && ends[0] <= ends[2] ? 0 : ends[1] <= ends[2] ? 1 : 2;
    if (!(ends[i] <= length) || enough(ends[i])) return;
    cell[i] += direction[static_cast<Eigen::Index>(i)] > 0 ? 1 : -1;
    ends[i] = next(i);
  }
}

template <typename Visit>
void Facets::cross(int t, const Vec3& origin, const Vec3& direction, double length, Visit visit) const {
  const auto& c = triangles_[at(t)];
  const Vec3& n = area(t);
  const double along = n.dot(direction);
  if (along == 0) return;
  const double s = n.dot(vertices_[at(c[0])] - origin) / along;
  if (s < 0 || s > length) return;
  const Vec3 p = origin + s * direction;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& a = vertices_[at(c[k])];
    if (n.cross(vertices_[at(c[(k + 1) % 3])] - a).dot(p - a) < 0) return;
  }
  visit(t, s, along);
}

std::optional<Facets::Hit> Facets::leaving(const Vec3& origin, const Vec3& direction, double length,
                                           double* first_entered) const {
  Hit out{length, -1};
  double entered = length;
  each_crossed(
      origin, direction, length,
      [&](int t, double s, double along) {
        if (along < 0)
          entered = std::min(entered, s);
        else if (s <= out.distance)
          out = {s, t};
      },
      [&](double walked) { return std::min(entered, out.distance) < walked; });
  if (first_entered != nullptr) *first_entered = entered;
  return out.triangle < 0 || entered < out.distance ? std::nullopt : std::optional(out);
}

bool Facets::enters(const Vec3& origin, const Vec3& direction, double length) const {
  bool found = false;
  each_crossed(
      origin, direction, length, [&](int, double, double along) { found = found || along < 0; },
      [&](double) { return found; });
  return found;
}

Facets::Lean Facets::lean(const Vec3& x, double radius) const {
  std::set<int> near;
  each_near(x.array() - radius, x.array() + radius, [&](int t) {
    const auto& c = triangles_[at(t)];
    if ((nearest_on({vertices_[at(c[0])], vertices_[at(c[1])], vertices_[at(c[2])]}, x).p - x).norm() <= radius)
      near.insert(t);
  });
  Lean lean;
  const auto nearest_one = nearest(x, 4 * radius);
  if (!nearest_one) return lean;
  const Vec3 facing = area(nearest_one->triangle);
  Vec3 sum = Vec3::Zero();
  for (const int t : near)
    if (area(t).dot(facing) > 0) sum += area(t);  // skips the other face of a thin body
  if (!(sum.norm() > 0)) return lean;
  lean.normal = sum.normalized();
  for (const int t : near) {
    const Vec3 n = area(t).normalized();
    if (n.dot(facing) <= 0) continue;
    lean.turn = std::max(lean.turn, std::acos(std::clamp(n.dot(lean.normal), -1.0, 1.0)));
  }
  // Between two vertices at distance e whose facets differ by the angle a, an arc bulges by e a / 8. A fit misses
  // vertices by their noise s, which turns facets by about 2 s / e, and the worst of about thirty by 5 s / e.
  lean.distance = edge_ * std::tan(std::min(lean.turn, 1.0));
  return lean;
}

bool Facets::in_patch(const Vec3& p) const {
  if (!def_->patch) return true;
  const Vec3 local = def_->placement.inverse() * p;
  for (std::size_t i = 0; i < 3; ++i)
    if (const auto& range = def_->patch->box[i]) {
      const double x = local[static_cast<Eigen::Index>(i)];
      if (x < range->first || x > range->second) return false;
    }
  if (const auto& range = def_->patch->theta) {
    double theta = std::atan2(local.y(), local.x());
    while (theta < range->first) theta += 2 * M_PI;
    while (theta > range->first + 2 * M_PI) theta -= 2 * M_PI;
    if (theta > range->second) return false;
  }
  return true;
}

}  // namespace genu::judge
