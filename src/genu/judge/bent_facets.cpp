#include "genu/judge/bent_facets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include <Eigen/QR>

#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

constexpr int kQuadric = 6;  // 1, u, v, u^2, u v, v^2

/// Two axes across a unit vector.
Eigen::Matrix<double, 3, 2> across(const Vec3& n) {
  Eigen::Index least = 0;
  n.cwiseAbs().minCoeff(&least);
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = n.cross(Vec3::Unit(least)).normalized();
  axes.col(1) = n.cross(axes.col(0));
  return axes;
}

}  // namespace

BentFacets::BentFacets(const Facets& facets, double fit_radius)
    : facets_(facets),
      narrow_(std::max(kQuadricReach * facets.edge(), fit_radius)),
      wide_(std::max(kWideQuadricReach * facets.edge(), kWiderFit * fit_radius)),
      vertices_(facets.vertices()),
      normals_(vertices_.size(), Vec3::UnitZ()),
      moved_(vertices_.size(), 0.0) {
  find_neighbours();
  find_creases();
  for (int v = 0; v < static_cast<int>(vertices_.size()); ++v) {
    if (neighbours_[at(v)].empty() || sharp_[at(v)]) continue;
    const Fit found = fit(v, narrow_);
    moved_[at(v)] = found.moved;
    normals_[at(v)] = found.n;
    vertices_[at(v)] += found.moved * facets.normal_at(v).normalized();
  }
  for (int t = 0; t < static_cast<int>(facets.triangles().size()); ++t) triangles_.push_back(bent(t));
  for (int t = 0; t < static_cast<int>(facets.triangles().size()); ++t)
    most_ = std::max(most_, over(t, facets.centroid(t)).off.norm());
  for (const double moved : moved_) most_ = std::max(most_, std::abs(moved));
  most_ = std::min(most_, kMostBend * facets.edge());
}

void BentFacets::find_neighbours() {
  neighbours_.resize(vertices_.size());
  for (const auto& t : facets_.triangles())
    for (std::size_t k = 0; k < 3; ++k) {
      neighbours_[at(t[k])].push_back(t[(k + 1) % 3]);
      neighbours_[at(t[k])].push_back(t[(k + 2) % 3]);
    }
  for (auto& list : neighbours_) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

void BentFacets::find_creases() {
  sharp_.assign(vertices_.size(), 0);
  for (int t = 0; t < static_cast<int>(facets_.triangles().size()); ++t)
    for (const int v : facets_.triangles()[at(t)])
      if (facets_.normal_at(v).normalized().dot(facets_.area(t).normalized()) < kCreaseCosine) sharp_[at(v)] = 1;
}

/// Vertices that edges lead to within `reach`, or until they are enough for a fit; of this face of a thin body,
/// up to creases.
std::vector<int> BentFacets::near_to(int vertex, double reach) const {
  std::vector<int> out{vertex};
  std::unordered_set<int> seen{vertex};
  const Vec3& middle = facets_.vertices()[at(vertex)];
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (sharp_[at(out[k])]) continue;
    for (const int v : neighbours_[at(out[k])]) {
      const bool near = (facets_.vertices()[at(v)] - middle).norm() <= reach || out.size() < kEnoughForQuadric;
      if (!near || !seen.insert(v).second) continue;
      if (facets_.normal_at(v).dot(facets_.normal_at(vertex)) > 0) out.push_back(v);
    }
  }
  return out;
}

/// By least squares, weights falling to a tenth at the farthest one. Of a lone vertex its own normal.
BentFacets::Fit BentFacets::fit(int vertex, double reach) const {
  const Vec3& middle = facets_.vertices()[at(vertex)];
  const Vec3 axis = facets_.normal_at(vertex).normalized();
  if (!axis.allFinite()) return {};
  const std::vector<int> near = near_to(vertex, reach);
  if (near.size() < kQuadric) return {0, axis};
  const Eigen::Matrix<double, 3, 2> sides = across(axis);
  double farthest = 0;
  for (const int v : near) farthest = std::max(farthest, (facets_.vertices()[at(v)] - middle).norm());
  MatX rows(static_cast<Eigen::Index>(near.size()), kQuadric);
  VecX heights(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Vec3 away = (facets_.vertices()[at(near[static_cast<std::size_t>(i)])] - middle) / farthest;
    const double u = sides.col(0).dot(away), v = sides.col(1).dot(away), weight = 1 - 0.9 * away.squaredNorm();
    rows.row(i) << 1, u, v, u * u, u * v, v * v;
    rows.row(i) *= weight;
    heights[i] = weight * axis.dot(away);
  }
  const VecX c = rows.colPivHouseholderQr().solve(heights);
  if (!c.allFinite()) return {0, axis};
  return {farthest * c[0], (axis - c[1] * sides.col(0) - c[2] * sides.col(1)).normalized()};
}

BentFacets::Triangle BentFacets::bent(int triangle) const {
  const auto& corners = facets_.triangles()[at(triangle)];
  const Vec3& area = facets_.area(triangle);
  Triangle out;
  if (area.squaredNorm() > 0) out.scaled = area / (2 * area.squaredNorm());
  for (std::size_t k = 0; k < 3; ++k) {
    out.along[k] = vertices_[at(corners[k])] - facets_.vertices()[at(corners[k])];
    out.normals[k] = sharp_[at(corners[k])] != 0 ? Vec3(area.normalized()) : normals_[at(corners[k])];
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Vec3 side = vertices_[at(corners[i])] - vertices_[at(corners[j])];
    out.bend[k] = 0.5 * (out.normals[i].dot(side) * out.normals[i] - out.normals[j].dot(side) * out.normals[j]);
  }
  return out;
}

BentFacets::Point BentFacets::over(int triangle, const Vec3& p) const {
  const auto& corners = facets_.triangles()[at(triangle)];
  const Triangle& t = triangles_[at(triangle)];
  const Vec3 to_0 = facets_.vertices()[at(corners[0])] - p, to_1 = facets_.vertices()[at(corners[1])] - p,
             to_2 = facets_.vertices()[at(corners[2])] - p;
  const double a = to_1.cross(to_2).dot(t.scaled), b = to_2.cross(to_0).dot(t.scaled), c = 1 - a - b;
  return {a * t.along[0] + b * t.along[1] + c * t.along[2] + b * c * t.bend[0] + c * a * t.bend[1] + a * b * t.bend[2],
          (a * t.normals[0] + b * t.normals[1] + c * t.normals[2]).normalized()};
}

double BentFacets::doubt(const Vec3& x, double radius) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (int t = 0; t < static_cast<int>(facets_.triangles().size()); ++t)
    nearest = std::min(nearest, (facets_.centroid(t) - x).norm());
  radius = std::max(radius, 2 * nearest);  // where triangles are larger than elsewhere
  double squares = 0, count = 0, bend = 0;
  for (int v = 0; v < static_cast<int>(vertices_.size()); ++v) {
    if ((facets_.vertices()[at(v)] - x).norm() > radius || neighbours_[at(v)].empty() || sharp_[at(v)]) continue;
    const double apart = fit(v, wide_).moved - moved_[at(v)];
    squares += apart * apart;
    ++count;
  }
  for (int t = 0; t < static_cast<int>(facets_.triangles().size()); ++t)
    if (const Vec3 middle = facets_.centroid(t); (middle - x).norm() <= radius)
      bend = std::max(bend, 0.25 * over(t, middle).off.norm());
  return std::sqrt(squares / std::max(1.0, count)) + bend;
}

}  // namespace genu::judge
