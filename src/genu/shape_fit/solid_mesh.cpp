#include "genu/shape_fit/solid_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include <fmt/format.h>

#include "genu/mesh/mesh_coarsen.h"
#include "genu/mesh/mesh_part.h"
#include "genu/mesh_care/mesh_crossings.h"
#include "genu/shape_fit/tolerances.h"
#include "genu/surface/surface.h"
#include "genu/surface/tessellate.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

/// The corners of a cube are numbered by their bits, x being 1, y 2, z 4. Six tetrahedra share the diagonal 0-7: one
/// for each order in which the three bits can be set.
constexpr int kTetrahedra[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};

class Marching {
 public:
  Marching(const std::function<double(const Vec3&)>& f, const BoundingBox& box, double cell) : cell_(cell) {
    const Vec3 cells = ((box.high - box.low) / cell).array().ceil();
    for (int k = 0; k < 3; ++k) count_[at(k)] = static_cast<std::int64_t>(cells[k]) + 1;
    // The grid stands about the middle of the box, so that what is symmetric stays so.
    origin_ = 0.5 * (box.low + box.high) - 0.5 * cell * cells;
    values_.reserve(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]));
    for (std::int64_t k = 0; k < count_[2]; ++k)
      for (std::int64_t j = 0; j < count_[1]; ++j)
        for (std::int64_t i = 0; i < count_[0]; ++i) values_.push_back(f(node({i, j, k})));
  }

  Mesh march() {
    for (std::int64_t k = 0; k + 1 < count_[2]; ++k)
      for (std::int64_t j = 0; j + 1 < count_[1]; ++j)
        for (std::int64_t i = 0; i + 1 < count_[0]; ++i) cube({i, j, k});
    return std::move(mesh_);
  }

 private:
  using Place = std::array<std::int64_t, 3>;

  std::int64_t index(const Place& p) const { return (p[2] * count_[1] + p[1]) * count_[0] + p[0]; }
  Vec3 node(const Place& p) const {
    return origin_ + cell_ * Vec3(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
  }
  static Place corner(const Place& p, int bits) {
    return {p[0] + (bits & 1), p[1] + ((bits >> 1) & 1), p[2] + (bits >> 2)};
  }
  double value(const Place& p) const { return values_[static_cast<std::size_t>(index(p))]; }

  void cube(const Place& p) {
    for (const auto& tetrahedron : kTetrahedra) {
      std::array<Place, 4> in, out;
      std::size_t inside = 0, outside = 0;
      std::array<int, 4> order{};  // which corners, those inside first
      for (int c = 0; c < 4; ++c)
        if (value(corner(p, tetrahedron[c])) < 0) order[inside++] = c;
      for (int c = 0; c < 4; ++c)
        if (!(value(corner(p, tetrahedron[c])) < 0)) order[inside + outside++] = c;
      if (inside == 0 || outside == 0) continue;
      for (std::size_t c = 0; c < 4; ++c) (c < inside ? in[c] : out[c - inside]) = corner(p, tetrahedron[order[c]]);
      // The order is an odd permutation of a right-handed tetrahedron where an odd number of pairs is exchanged.
      int exchanged = 0;
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a + 1; b < 4; ++b) exchanged += order[a] > order[b] ? 1 : 0;
      cut(in, out, inside, exchanged % 2 == 1);
    }
  }

  void cut(const std::array<Place, 4>& in, const std::array<Place, 4>& out, std::size_t inside, bool odd) {
    if (inside == 1) {
      triangle(vertex(in[0], out[0]), vertex(in[0], out[1]), vertex(in[0], out[2]), odd);
    } else if (inside == 3) {
      triangle(vertex(in[0], out[0]), vertex(in[1], out[0]), vertex(in[2], out[0]), odd);
    } else {
      const int a = vertex(in[0], out[0]), b = vertex(in[0], out[1]), c = vertex(in[1], out[1]),
                d = vertex(in[1], out[0]);
      triangle(a, b, c, odd);
      triangle(a, c, d, odd);
    }
  }

  void triangle(int a, int b, int c, bool odd) {
    if (odd)
      mesh_.triangles.push_back({a, c, b});
    else
      mesh_.triangles.push_back({a, b, c});
  }

  int vertex(const Place& in, const Place& out) {
    const auto i = static_cast<std::uint64_t>(index(in)), o = static_cast<std::uint64_t>(index(out));
    const auto [entry, fresh] =
        known_.try_emplace((std::min(i, o) << 32) | std::max(i, o), static_cast<int>(mesh_.vertices.size()));
    if (!fresh) return entry->second;
    const double a = value(in), b = value(out);
    const double t = std::clamp(a / (a - b), kFromEnds, 1 - kFromEnds);
    mesh_.vertices.emplace_back((1 - t) * node(in) + t * node(out));
    return entry->second;
  }

  double cell_;
  Vec3 origin_;
  std::array<std::int64_t, 3> count_{};
  std::vector<double> values_;
  std::unordered_map<std::uint64_t, int> known_;  // by the two nodes; only looked up, never walked
  Mesh mesh_;
};

/// What refine() asks of a surface: to be projected onto. Its edges are the same length everywhere, so it is flat.
class Projection final : public Surface {
 public:
  explicit Projection(const SolidField& field) : field_(field) {}
  bool project(const Vec3& x, SurfacePoint& out) const override {
    out = {};
    out.p = x;
    return field_.project(out.p, out.n);
  }
  std::optional<double> gap(const Vec3&) const override { return {}; }
  Mesh triangles(double, const Vec3&, double) const override { return {}; }

 private:
  const SolidField& field_;
};

/// The surface in many uneven triangles, from cubes of `cell`.
Mesh uneven_mesh(const SolidField& field, double edge, double cell, std::string& why) {
  BoundingBox box = field.box();
  box.low.array() -= 1.5 * edge;
  box.high.array() += 1.5 * edge;
  const double nodes = ((box.high - box.low) / cell).array().ceil().prod();
  if (!(nodes < kMaxGridNodes)) {
    why = fmt::format("is too large for its edges: more than {:g} points would have to be looked at", kMaxGridNodes);
    return {};
  }
  Mesh mesh = marching_tetrahedra([&](const Vec3& x) { return field(x).f; }, box, cell);
  if (mesh.empty()) why = "has nothing inside that is as large as an edge";
  Vec3 normal;
  for (Vec3& v : mesh.vertices) {
    if (field.project(v, normal)) continue;
    why = "has parts whose surface cannot be found";
    return {};
  }
  return mesh;
}

/// The same with edges of about `edge`.
Mesh even_mesh(const SolidField& field, double edge, double cell, std::string& why) {
  Mesh mesh = uneven_mesh(field, edge, cell, why);
  if (!why.empty()) return {};
  const double triangle = kRowSpacing / 2 * edge * edge, whole = area_of(mesh);
  if (whole / triangle > kMaxTriangles) {
    why = fmt::format("would have about {:.0f} triangles, more than {:.0f}: give it longer edges", whole / triangle,
                      kMaxTriangles);
    return {};
  }
  const double vertices = 0.5 * whole / (kSolidStretch * kSolidStretch * triangle);
  mesh = coarsened(mesh, std::sqrt(std::max(1.0, static_cast<double>(mesh.vertices.size()) / vertices)));
  refine(mesh, Projection(field), edge);
  if (mesh.triangles.size() < kMinSolidTriangles)
    why =
        fmt::format("would be {} triangles, which are no likeness of it: give it shorter edges", mesh.triangles.size());
  return mesh;
}

}  // namespace

Mesh marching_tetrahedra(const std::function<double(const Vec3&)>& f, const BoundingBox& box, double cell) {
  return Marching(f, box, cell).march();
}

Mesh solid_mesh(const SolidField& field, double edge, std::string& why) {
  // Where the surface bends within an edge, finer cubes may still follow it.
  for (const double share : {1.0, 0.6, 0.4}) {
    std::string failed;
    Mesh mesh = even_mesh(field, edge, share * edge, failed);
    if (failed.empty() && crossing_triangles(mesh, 1).empty()) return mesh;
    if (share == 1 && !failed.empty()) {
      why = failed;
      return {};
    }
  }
  why = "has places sharper than its edges, where triangles run through each other: give it shorter edges or blends";
  return {};
}

}  // namespace genu
