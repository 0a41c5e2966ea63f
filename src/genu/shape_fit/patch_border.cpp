#include "genu/shape_fit/patch_border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "genu/core/decompositions.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/shape_fit/chart_choice.h"
#include "genu/shape_fit/tolerances.h"

namespace genu {
namespace {

using BorderSide = std::vector<Vec3>;
using Sides = std::array<BorderSide, 4>;
using Pair = std::array<const BorderSide*, 2>;  // opposite sides

/// The angle by which a loop turns at its point k.
double turning_angle(const std::vector<Vec3>& loop, std::size_t k) {
  const std::size_t n = loop.size();
  const Vec3 in = loop[k] - loop[(k + n - 1) % n], out = loop[(k + 1) % n] - loop[k];
  return std::atan2(in.cross(out).norm(), in.dot(out));
}

/// The loop parted at its four sharpest corners; empty where there are not just four.
std::optional<Sides> four_sides(const std::vector<Vec3>& loop) {
  std::vector<std::size_t> corners;
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (turning_angle(loop, k) > kCornerTurn) corners.push_back(k);
  if (corners.size() != 4) return std::nullopt;
  Sides sides;
  for (std::size_t s = 0; s < 4; ++s) {
    const std::size_t last = s < 3 ? corners[s + 1] : corners[0] + loop.size();
    for (std::size_t k = corners[s]; k <= last; ++k) sides[s].push_back(loop[k % loop.size()]);
    if (sides[s].size() < kMinSidePoints) return std::nullopt;
  }
  return sides;
}

Vec3 mean(const BorderSide& side) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : side) sum += p;
  return sum / static_cast<double>(side.size());
}

/// The largest distance of a side's points from the plane through their mean.
double scatter(const BorderSide& side, const Vec3& normal) {
  const Vec3 middle = mean(side);
  double worst = 0;
  for (const Vec3& p : side) worst = std::max(worst, std::abs(normal.dot(p - middle)));
  return worst;
}

/// The unit normal of the planes that some sides lie in, parallel ones; empty where they do not, or are as good as
/// straight and do not tell.
std::optional<Vec3> common_normal(const Pair& sides, double allowed) {
  Mat3 spread = Mat3::Zero();
  std::size_t count = 0;
  for (const BorderSide* side : sides) {
    const Vec3 middle = mean(*side);
    for (const Vec3& p : *side) spread += (p - middle) * (p - middle).transpose(), ++count;
  }
  const SymmetricEigen<3> solved = symmetric_eigen(spread);
  const Vec3 n = solved.vectors.col(0);
  const double off = std::max(scatter(*sides[0], n), scatter(*sides[1], n));
  const double depth = std::sqrt(solved.values[1] / static_cast<double>(count));
  if (!(off <= allowed) || !(depth > std::max(kMinSideDepth, kPlaneDepthRatio * off))) return std::nullopt;
  return n;
}

/// The point that lines in a plane meet in, least squares; longer lines count for more, as they are better known.
class Meeting {
 public:
  /// The line through points whose second moment about their mean `middle` is `moment`.
  void add(const Vec2& middle, const Mat2& moment) {
    const SymmetricEigen<2> solved = symmetric_eigen(moment);
    const Vec2 n = solved.vectors.col(0);
    A_ += solved.values[1] * n * n.transpose();
    b_ += solved.values[1] * n.dot(middle) * n;
  }

  std::optional<Vec2> point() const {
    const Vec2 spread = symmetric_eigenvalues(A_);
    if (!(spread[0] > kMinSpread * spread[1])) return std::nullopt;
    return Vec2(definite_solution(A_, b_));
  }

 private:
  Mat2 A_ = Mat2::Zero();
  Vec2 b_ = Vec2::Zero();
};

void add_side(Meeting& lines, const BorderSide& side, const SurfaceChart& from) {
  const Vec2 middle = from.to_own(mean(side)).head<2>();
  Mat2 moment = Mat2::Zero();
  for (const Vec3& p : side) {
    const Vec2 d = from.to_own(p).head<2>() - middle;
    moment += d * d.transpose();
  }
  lines.add(middle, moment);
}

/// Where the axis is in the frame `from`, whose z it is along: in the planes of the ends, and, where the arcs' points
/// stand opposite each other as those of a grid do, in the planes of all such pairs. Ends half a turn apart need them.
std::optional<Vec2> axis_place(const Pair& arcs, const Pair& ends, const SurfaceChart& from, bool opposite) {
  Meeting lines;
  for (const BorderSide* end : ends) add_side(lines, *end, from);
  const std::size_t n = arcs[0]->size();
  if (opposite && arcs[1]->size() != n) return std::nullopt;
  for (std::size_t k = 1; opposite && k + 1 < n; ++k) add_side(lines, {(*arcs[0])[k], (*arcs[1])[n - 1 - k]}, from);
  return lines.point();
}

/// The chart about the axis through `place`, and the patch between the sides; empty where they are not its lines.
std::optional<BorderChart> round_axis(const Pair& arcs, const Pair& ends, const SurfaceChart& from, const Vec2& place,
                                      double allowed) {
  BorderChart found{{true, from.X_BS}, {}};
  found.chart.X_BS.p = from.X_BS * Vec3(place.x(), place.y(), 0);
  const double u = found.chart.coordinates((*arcs[0])[arcs[0]->size() / 2]).u;
  found.chart.X_BS.R = found.chart.X_BS.R * Eigen::AngleAxisd(u, Vec3::UnitZ()).toRotationMatrix();
  const ChartPoint e0 = found.chart.coordinates(mean(*ends[0])), e1 = found.chart.coordinates(mean(*ends[1])),
                   a0 = found.chart.coordinates(mean(*arcs[0])), a1 = found.chart.coordinates(mean(*arcs[1]));
  if (!(e0.u * e1.u < 0) || !(std::abs(a0.v - a1.v) > allowed)) return std::nullopt;
  found.patch = {std::min(e0.u, e1.u), std::max(e0.u, e1.u), std::min(a0.v, a1.v), std::max(a0.v, a1.v)};
  centre_on(found.patch, found.chart);
  for (const BorderSide* end : ends)
    for (const Vec3& p : *end) {
      const ChartPoint c = found.chart.coordinates(p);
      if (!(c.h * std::abs(std::abs(c.u) - found.patch.u1) <= 2 * allowed)) return std::nullopt;
    }
  return found;
}

std::optional<BorderChart> cylindrical(const Pair& arcs, const Pair& ends, double allowed) {
  const auto normal = common_normal(arcs, allowed);
  if (!normal) return std::nullopt;
  // From a point of the border: the distance to the body's origin costs no digits.
  const Vec3 z = largest_positive(*normal), x = z.unitOrthogonal();
  SurfaceChart from;
  from.X_BS.p = mean(*ends[0]);
  from.X_BS.R << x, z.cross(x), z;
  for (const bool opposite : {true, false}) {
    const auto place = axis_place(arcs, ends, from, opposite);
    if (!place) continue;
    if (auto found = round_axis(arcs, ends, from, *place, allowed)) return found;
  }
  return std::nullopt;
}

/// The chart whose lines of equal x hold `a` and whose lines of equal y hold `b`; x along the longer side.
std::optional<BorderChart> cartesian(const Pair& a, const Pair& b, const Vec3& outward, double allowed) {
  const auto na = common_normal(a, allowed), nb = common_normal(b, allowed);
  if (!na || !nb) return std::nullopt;
  const double half_a = 0.5 * std::abs(na->dot(mean(*a[1]) - mean(*a[0]))),
               half_b = 0.5 * std::abs(nb->dot(mean(*b[1]) - mean(*b[0])));
  if (half_b > half_a) return cartesian(b, a, outward, allowed);
  if (!(half_b > allowed) || !(std::abs(na->dot(*nb)) * half_b <= allowed)) return std::nullopt;
  BorderChart found{{false, {}}, {-half_a, half_a, -half_b, half_b}};
  const Vec3 x = largest_positive(*na), across = *nb - nb->dot(x) * x;
  Vec3 y = across.normalized();
  if (x.cross(y).dot(outward) < 0) y = -y;
  found.chart.X_BS.R << x, y, x.cross(y);
  const Vec3 near = mean(*a[0]);
  found.chart.X_BS.p =
      near + 0.5 * x.dot(mean(*a[1]) - near) * x + (0.5 * y.dot(mean(*b[0]) + mean(*b[1])) - y.dot(near)) * y;
  return found;
}

ChartBox round_where_it_is(const BorderChart& border) {
  const auto nearest = [](double half, double step) {
    const double whole = std::round(half / step);
    return std::abs(half / step - whole) < kRoundedStep ? whole * step : half;
  };
  const double a = nearest(border.patch.u1, border.chart.cylindrical ? kRoundAngle : kRoundLength),
               b = nearest(border.patch.v1, kRoundLength);
  return {-a, a, -b, b};
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
  const Pair a{&(*sides)[0], &(*sides)[2]}, b{&(*sides)[1], &(*sides)[3]};
  auto found = cylindrical(a, b, allowed);
  if (!found) found = cylindrical(b, a, allowed);
  if (!found) found = cartesian(a, b, plane_frame(oriented_points(sheet)).R.col(2), allowed);
  if (found) found->patch = round_where_it_is(*found);
  return found;
}

}  // namespace genu
