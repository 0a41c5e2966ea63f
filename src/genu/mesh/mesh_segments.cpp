#include "genu/mesh/mesh_segments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "genu/core/decompositions.h"
#include "genu/mesh/mesh_cut.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/mesh_weld.h"
#include "genu/mesh/polygon_cut.h"
#include "genu/mesh/solid_inertia.h"
#include "genu/mesh/tolerances.h"

namespace genu {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// The frame of the cuts: x and y across the axis.
struct Round {
  Vec3 middle, x, y, axis;

  double angle(const Vec3& p) const { return std::atan2(y.dot(p - middle), x.dot(p - middle)); }
  Vec3 outward(double angle) const { return std::cos(angle) * x + std::sin(angle) * y; }
  Vec3 tangent(double angle) const { return std::cos(angle) * y - std::sin(angle) * x; }
};

double area_of(const Mesh& mesh, const std::array<int, 3>& t) {
  const Vec3 &a = mesh.vertices[at(t[0])], &b = mesh.vertices[at(t[1])], &c = mesh.vertices[at(t[2])];
  return (b - a).cross(c - a).norm() / 2;
}

Vec3 centre_of(const Mesh& mesh, const std::array<int, 3>& t) {
  return (mesh.vertices[at(t[0])] + mesh.vertices[at(t[1])] + mesh.vertices[at(t[2])]) / 3;
}

/// |p - m|^2 = r^2 is linear in m and r^2 - |m|^2: least squares over the surface (I. Kasa 1976).
Round round_of(const Mesh& mesh, const SolidInertia& solid) {
  Round out;
  const auto main = symmetric_eigen(solid.about_centroid);
  out.x = main.vectors.col(0);
  out.axis = main.vectors.col(2);
  Eigen::Index largest = 0;
  out.axis.cwiseAbs().maxCoeff(&largest);
  if (out.axis[largest] < 0) out.axis = -out.axis;
  out.y = out.axis.cross(out.x);
  Mat3 sums = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const auto& t : mesh.triangles) {
    const Vec3 p = centre_of(mesh, t) - solid.centroid;
    const double weight = area_of(mesh, t), u = out.x.dot(p), v = out.y.dot(p);
    const Vec3 row(2 * u, 2 * v, 1);
    sums += weight * row * row.transpose();
    right += weight * (u * u + v * v) * row;
  }
  const VecX found = definite_solution(sums, right);
  out.middle = solid.centroid + found[0] * out.x + found[1] * out.y;
  return out;
}

/// From b to a the short way round.
double turn_between(double a, double b) { return std::remainder(a - b, kTurn); }

/// Where the solid begins and ends, as angles; a ring from -pi to pi.
struct Span {
  double first = -std::numbers::pi, last = std::numbers::pi;
  bool ring = true;
};

Span span_of(const Mesh& mesh, const Round& round) {
  std::vector<char> covered(kSpanBins, 0);
  const auto bin = [](double angle) {
    return static_cast<int>(std::floor((angle + std::numbers::pi) / kTurn * kSpanBins) + 2 * kSpanBins) % kSpanBins;
  };
  for (const auto& t : mesh.triangles) {
    const double from = round.angle(mesh.vertices[at(t[0])]);
    double low = 0, high = 0;
    for (const int v : {t[1], t[2]}) {
      const double turn = turn_between(round.angle(mesh.vertices[at(v)]), from);
      low = std::min(low, turn);
      high = std::max(high, turn);
    }
    for (double a = low; a < high + kTurn / kSpanBins; a += kTurn / kSpanBins / 2)
      covered[at(bin(from + std::min(a, high)))] = 1;
  }
  int longest = 0, end = 0, run = 0;
  for (int k = 0; k < 2 * kSpanBins; ++k) {
    run = covered[at(k % kSpanBins)] != 0 ? 0 : run + 1;
    if (run <= longest || run > kSpanBins) continue;
    longest = run;
    end = k;
  }
  if (longest == 0) return {};
  // The span begins behind the gap and ends before it.
  const double step = kTurn / kSpanBins, first = -std::numbers::pi + (end + 1) * step;
  return {first, first + kTurn - longest * step, false};
}

/// The winding of the surface about the axis tells whether the axis runs through the solid: its sections then reach
/// r = 0. A line of intersection that crosses r = 0 is one of a triangle that the axis meets.
struct SectionSums {
  double area = 0, r = 0, z = 0, rr = 0, zz = 0, rz = 0;
  bool meets_axis = false;
};

/// Adds the polygon's part of the edge from a to b, in (r, z): Green's theorem.
void add_edge(const Vec2& a, const Vec2& b, SectionSums& sums) {
  const double twice = a.x() * b.y() - b.x() * a.y();
  sums.area += twice / 2;
  sums.r += twice * (a.x() + b.x()) / 6;
  sums.z += twice * (a.y() + b.y()) / 6;
  sums.rr += twice * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x()) / 12;
  sums.zz += twice * (a.y() * a.y() + a.y() * b.y() + b.y() * b.y()) / 12;
  sums.rz += twice * (2 * a.x() * a.y() + a.x() * b.y() + b.x() * a.y() + 2 * b.x() * b.y()) / 24;
}

/// Where the half-plane at `angle` cuts the triangles.
SectionSums sums_at(const Mesh& mesh, const Round& round, double angle) {
  const Vec3 normal = round.tangent(angle), outward = round.outward(angle);
  SectionSums out;
  for (const auto& t : mesh.triangles) {
    Vec2 from, to;
    int ends = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = mesh.vertices[at(t[k])] - round.middle, b = mesh.vertices[at(t[(k + 1) % 3])] - round.middle;
      const double side_a = normal.dot(a), side_b = normal.dot(b);
      if ((side_a < 0) == (side_b < 0)) continue;
      const Vec3 p = a + side_a / (side_a - side_b) * (b - a);
      (side_a < 0 ? from : to) = Vec2(outward.dot(p), round.axis.dot(p));
      ++ends;
    }
    if (ends != 2 || (from.x() < 0 && to.x() < 0)) continue;
    out.meets_axis = out.meets_axis || from.x() <= 0 || to.x() <= 0;
    add_edge(from, to, out);
  }
  return out;
}

/// The face at `angle`.
MeshSection section_at(const Mesh& mesh, const Round& round, double angle) {
  const SectionSums sums = sums_at(mesh, round, angle);
  MeshSection out;
  out.tangent = round.tangent(angle);
  out.area = sums.area;
  const Vec2 centre = Vec2(sums.r, sums.z) / sums.area;
  const Vec3 outward = round.outward(angle);
  out.centre = round.middle + centre.x() * outward + centre.y() * round.axis;
  Mat2 spread;
  spread << sums.rr - sums.area * centre.x() * centre.x(), 0, sums.rz - sums.area * centre.x() * centre.y(),
      sums.zz - sums.area * centre.y() * centre.y();
  const auto main = symmetric_eigen(spread);  // the lower triangle is read; rising
  out.about_y = main.values[0];
  out.about_z = main.values[1];
  out.y = main.vectors(0, 1) * outward + main.vectors(1, 1) * round.axis;
  if (out.y.dot(outward) < 0) out.y = -out.y;
  out.z = out.tangent.cross(out.y);
  return out;
}

/// The centreline: its points' angles, and the distance along it.
struct Centreline {
  std::vector<double> angle, along;

  double angle_at(double distance) const {
    const auto next = std::upper_bound(along.begin() + 1, along.end() - 1, distance);
    const auto k = static_cast<std::size_t>(next - along.begin());
    const double share = (distance - along[k - 1]) / (along[k] - along[k - 1]);
    return angle[k - 1] + share * (angle[k] - angle[k - 1]);
  }
};

Centreline centreline_of(const Mesh& mesh, const Round& round, const Span& span, std::string& problem) {
  Centreline out;
  Vec3 before = Vec3::Zero();
  for (int k = 0; k <= kCentrelinePoints; ++k) {
    // Half a step inside of both ends; a ring has its first point again.
    const double share = span.ring ? 1.0 * k / kCentrelinePoints : (k + 0.5) / (kCentrelinePoints + 1);
    const double angle = span.first + share * (span.last - span.first);
    const SectionSums sums = sums_at(mesh, round, angle);
    if (sums.meets_axis) problem = "does not run round a middle: an axis through the middle meets it";
    if (!(sums.area > 0) || !problem.empty()) continue;
    const Vec3 centre = round.middle + sums.r / sums.area * round.outward(angle) + sums.z / sums.area * round.axis;
    out.along.push_back(out.along.empty() ? 0 : out.along.back() + (centre - before).norm());
    out.angle.push_back(angle);
    before = centre;
  }
  if (problem.empty() && out.angle.size() < 3) problem = "has no sections round its middle: is it closed?";
  return out;
}

/// The part in front of a plane through the axis, open where it is cut.
Mesh in_front(const Mesh& mesh, const Round& round, const Vec3& normal) {
  const auto side = [&](const Vec3& p) { return normal.dot(p - round.middle); };
  return cut_mesh(mesh, side, [&](const Vec3& a, const Vec3& b) -> Vec3 {
    const double in = side(a), out = side(b);
    return (in * b - out * a) / (in - out);
  });
}

/// Closes it by faces across `normal`. Says in `problem` what cannot be closed.
Mesh closed(Mesh mesh, const Vec3& normal, std::string& problem) {
  std::vector<Fan> fans;
  for (std::vector<int> loop : boundary_loops(mesh, mesh_edges(mesh))) {
    Vec3 twice_area = Vec3::Zero();
    const Vec3 first = mesh.vertices[at(loop[0])];
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
      twice_area += (mesh.vertices[at(loop[k])] - first).cross(mesh.vertices[at(loop[k + 1])] - first);
    // With the surface on the left the loop turns about the normal; one the other way is a hole in the face.
    if (normal.dot(twice_area) < 0) problem = "is hollow where it is to be cut";
    std::reverse(loop.begin(), loop.end());
    add_polygon(loop, mesh, fans);
  }
  if (cut_concave(mesh, fans) > 0 && problem.empty()) problem = "has a section that crosses itself";
  return mesh;
}

/// A triangle's part of the surface: what faces up or down is touched by bones, the wall is not.
enum class Side : unsigned char { above, below, wall };

/// The triangles of one side, with all vertices.
Mesh part_of(const Mesh& mesh, const std::vector<Side>& sides, Side side) {
  Mesh out;
  out.vertices = mesh.vertices;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
    if (sides[k] == side) out.triangles.push_back(mesh.triangles[k]);
  return out;
}

/// Turns scraps of a side over to the side that borders on most of their edges. Of those that bones touch only the
/// largest connected part is none; of the wall, which has parts within and without, all that is no hole in a side.
void turn_scraps(const Mesh& mesh, const std::vector<MeshEdge>& edges, Side side, std::vector<Side>& sides) {
  const Components parts = connected_components(part_of(mesh, sides, side));
  std::vector<int> part(sides.size(), -1);
  for (std::size_t k = 0, n = 0; k < sides.size(); ++k)
    if (sides[k] == side) part[k] = parts.of_triangle[n++];
  std::vector<long> sizes(at(parts.count), 0);
  for (const int p : parts.of_triangle) ++sizes[at(p)];
  const auto largest = std::max_element(sizes.begin(), sizes.end()) - sizes.begin();
  std::vector<std::array<int, 3>> beside(at(parts.count), {0, 0, 0});  // edges to each side
  std::vector<char> open(at(parts.count), 0);
  for (const MeshEdge& e : edges)
    for (std::size_t i = 0; i < 2; ++i) {
      const int p = e.t[i] < 0 ? -1 : part[at(e.t[i])];
      if (p < 0) continue;
      if (e.count != 2)
        open[at(p)] = 1;
      else if (const Side other = sides[at(e.t[1 - i])]; other != side)
        ++beside[at(p)][static_cast<std::size_t>(other)];
    }
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (part[k] < 0) continue;
    const auto& [above, below, wall] = beside[at(part[k])];
    const bool hole = open[at(part[k])] == 0 && (above == 0 || below == 0);
    if (side == Side::wall ? !hole : part[k] == largest) continue;
    sides[k] = wall >= std::max(above, below) ? Side::wall : above > below ? Side::above : Side::below;
  }
}

/// Of each triangle.
std::vector<Side> sides_of(const Mesh& mesh, const Vec3& up) {
  std::vector<Side> out;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[at(t[0])], &b = mesh.vertices[at(t[1])], &c = mesh.vertices[at(t[2])];
    const Vec3 normal = (b - a).cross(c - a);
    const double rise = up.dot(normal), steepest = kSteepestSide * normal.norm();
    out.push_back(rise > steepest ? Side::above : rise < -steepest ? Side::below : Side::wall);
  }
  const std::vector<MeshEdge> edges = mesh_edges(mesh);
  for (const Side side : {Side::above, Side::below, Side::wall}) turn_scraps(mesh, edges, side, out);
  return out;
}

MeshPiece piece_between(const Mesh& mesh, const Round& round, double from, double to, std::string& problem) {
  MeshPiece out;
  const Vec3 behind = round.tangent(from), ahead = -round.tangent(to);
  const Mesh surface = in_front(in_front(mesh, round, behind), round, ahead);
  const std::vector<Side> sides = sides_of(surface, round.axis);
  out.above = part_of(surface, sides, Side::above);
  out.below = part_of(surface, sides, Side::below);
  drop_unused_vertices(out.above);
  drop_unused_vertices(out.below);
  out.mesh = closed(in_front(closed(in_front(mesh, round, behind), behind, problem), round, ahead), ahead, problem);
  const SolidInertia solid = solid_inertia(out.mesh);
  out.volume = solid.volume;
  out.centroid = solid.centroid;
  if (problem.empty() && (out.above.empty() || out.below.empty() || !(solid.volume > 0)))
    problem = "leaves nothing of one piece";
  return out;
}

}  // namespace

MeshSegments segment_mesh(const Mesh& mesh, int pieces) {
  MeshSegments out;
  const SolidInertia solid = solid_inertia(mesh);
  for (const MeshEdge& e : mesh_edges(mesh))
    if (e.count != 2) out.problem = "is not closed";
  if (out.problem.empty() && !(solid.volume > 0)) out.problem = "has no volume, or is inside out";
  if (!out.problem.empty()) return out;
  const Round round = round_of(mesh, solid);
  const Span span = span_of(mesh, round);
  const Centreline line = centreline_of(mesh, round, span, out.problem);
  if (!out.problem.empty()) return out;
  out.middle = round.middle;
  out.axis = round.axis;
  out.ring = span.ring;
  const double each = line.along.back() / pieces;
  std::vector<double> cuts{span.first};
  for (int k = 1; k < pieces; ++k) cuts.push_back(line.angle_at(k * each));
  cuts.push_back(span.last);
  for (int k = 0; k < pieces; ++k) {
    out.pieces.push_back(piece_between(mesh, round, cuts[at(k)], cuts[at(k + 1)], out.problem));
    out.pieces.back().length = each;
    if (span.ring || k + 1 < pieces) out.sections.push_back(section_at(mesh, round, cuts[at(k + 1)]));
    if (!out.problem.empty()) break;
  }
  return out;
}

}  // namespace genu
