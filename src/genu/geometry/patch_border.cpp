#include "genu/geometry/patch_border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "genu/geometry/chart_choice.h"
#include "genu/geometry/mesh_topology.h"

namespace genu {
namespace {

constexpr std::size_t kFewest = 4;   // points of a side, corners included
constexpr double kSharpest = 0.5;    // rad: a corner turns by more, a side of a mesh that follows its surface by less
constexpr double kBent = 0.01;       // an arc's depth beside its length: a flatter one does not tell its plane
constexpr double kToldBy = 1e4;      // a side's extent beside its points' scatter: the plane's angle to a ten thousandth
constexpr double kLeastAcross = 1e-6;  // m, of that extent

using Side = std::vector<Vec3>;
using Sides = std::array<Side, 4>;

/// The angle by which a loop turns at its point k.
double turn(const std::vector<Vec3>& loop, std::size_t k) {
  const std::size_t n = loop.size();
  const Vec3 in = loop[k] - loop[(k + n - 1) % n], out = loop[(k + 1) % n] - loop[k];
  return std::atan2(in.cross(out).norm(), in.dot(out));
}

/// The loop parted at its four sharpest corners; empty where there are not just four.
std::optional<Sides> four_sides(const std::vector<Vec3>& loop) {
  std::vector<std::size_t> corners;
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (turn(loop, k) > kSharpest) corners.push_back(k);
  if (corners.size() != 4) return std::nullopt;
  Sides sides;
  for (std::size_t s = 0; s < 4; ++s) {
    const std::size_t last = s < 3 ? corners[s + 1] : corners[0] + loop.size();
    for (std::size_t k = corners[s]; k <= last; ++k) sides[s].push_back(loop[k % loop.size()]);
    if (sides[s].size() < kFewest) return std::nullopt;
  }
  return sides;
}

Vec3 mean(const Side& side) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : side) sum += p;
  return sum / static_cast<double>(side.size());
}

/// The largest distance of a side's points from the plane through their mean.
double scatter(const Side& side, const Vec3& normal) {
  const Vec3 middle = mean(side);
  double worst = 0;
  for (const Vec3& p : side) worst = std::max(worst, std::abs(normal.dot(p - middle)));
  return worst;
}

/// The common normal of the planes of two arcs.
std::optional<Vec3> across(const Side& a, const Side& b, double allowed) {
  Mat3 spread = Mat3::Zero();
  for (const Side* side : {&a, &b})
    for (const Vec3& p : *side) spread += (p - mean(*side)) * (p - mean(*side)).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> solved(spread);
  if (!(solved.eigenvalues()[1] > kBent * kBent * solved.eigenvalues()[2])) return std::nullopt;
  const Vec3 z = solved.eigenvectors().col(0);
  if (!(std::max(scatter(a, z), scatter(b, z)) <= allowed)) return std::nullopt;
  return largest_positive(z);
}

/// The normal of the plane along `z` through a side.
std::optional<Vec3> along(const Side& side, const Vec3& z, double allowed) {
  const Vec3 x = z.unitOrthogonal(), y = z.cross(x), middle = mean(side);
  Mat2 spread = Mat2::Zero();
  for (const Vec3& p : side) {
    const Vec2 d(x.dot(p - middle), y.dot(p - middle));
    spread += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat2> solved(spread);
  const Vec2 n = solved.eigenvectors().col(0);
  const Vec3 normal = n.x() * x + n.y() * y;
  const double extent = std::sqrt(solved.eigenvalues()[1] / static_cast<double>(side.size()));
  const double off = scatter(side, normal);
  if (!(off <= allowed) || !(extent > std::max(kLeastAcross, kToldBy * off))) return std::nullopt;
  return normal;
}

/// The chart whose z-planes hold `arcs` and whose axis the planes of `ends` meet in.
std::optional<BorderChart> chart_of(const std::array<const Side*, 2>& arcs, const std::array<const Side*, 2>& ends,
                                    double allowed) {
  const auto z = across(*arcs[0], *arcs[1], allowed);
  if (!z) return std::nullopt;
  const auto n0 = along(*ends[0], *z, allowed), n1 = along(*ends[1], *z, allowed);
  constexpr double kParallel = 0.02;  // rad
  if (!n0 || !n1 || !(n0->cross(*n1).norm() > kParallel)) return std::nullopt;
  // About a point of the border, so that the distance to the body's origin costs no digits.
  const Vec3 near = mean(*arcs[0]), half = 0.5 * (mean(*arcs[1]) - near);
  Mat3 planes;
  planes << n0->transpose(), n1->transpose(), z->transpose();
  const Vec3 right(n0->dot(mean(*ends[0]) - near), n1->dot(mean(*ends[1]) - near), z->dot(half));
  BorderChart found;
  found.chart.cylindrical = true;
  found.chart.X_BS.p = near + planes.partialPivLu().solve(right);

  Mat3& R = found.chart.X_BS.R;
  const Vec3 toward = (*arcs[0])[arcs[0]->size() / 2] - found.chart.X_BS.p;
  const Vec3 x = toward - toward.dot(*z) * *z;
  if (!(x.norm() > allowed)) return std::nullopt;
  R.col(0) = x.normalized(), R.col(1) = z->cross(R.col(0)), R.col(2) = *z;
  const double u0 = found.chart.coordinates(mean(*ends[0])).u, u1 = found.chart.coordinates(mean(*ends[1])).u;
  const double v = std::abs(z->dot(half));
  if (!(u0 * u1 < 0) || !(v > allowed)) return std::nullopt;
  found.patch = {std::min(u0, u1), std::max(u0, u1), -v, v};
  centre_on(found.patch, found.chart);
  // Planes go on beyond the axis; a patch does not.
  for (const Side* end : ends)
    for (const Vec3& p : *end) {
      const ChartPoint c = found.chart.coordinates(p);
      if (!(c.h * std::abs(std::abs(c.u) - found.patch.u1) <= 2 * allowed)) return std::nullopt;
    }
  return found;
}

}  // namespace

double file_resolution(const Mesh& mesh) {
  double largest = 0;
  for (const Vec3& p : mesh.vertices) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest * static_cast<double>(std::numeric_limits<float>::epsilon());
}

std::optional<BorderChart> chart_of_border(const Mesh& sheet) {
  const auto loops = boundary_loops(sheet, mesh_edges(sheet));
  if (loops.size() != 1) return std::nullopt;
  std::vector<Vec3> loop;
  for (const int v : loops.front()) loop.push_back(sheet.vertices[static_cast<std::size_t>(v)]);
  const auto sides = four_sides(loop);
  if (!sides) return std::nullopt;
  const double allowed = file_resolution(sheet);
  const Sides& s = *sides;
  if (auto found = chart_of({&s[0], &s[2]}, {&s[1], &s[3]}, allowed)) return found;
  return chart_of({&s[1], &s[3]}, {&s[0], &s[2]}, allowed);
}

}  // namespace genu
