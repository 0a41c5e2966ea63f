#include "genu/contact/smooth_cells.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "genu/contact/tolerances.h"

namespace genu {
namespace {

/// Area vectors of the triangles round each vertex.
std::vector<Vec3> mesh_normals(const Mesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[at(t[0])], &b = mesh.vertices[at(t[1])], &c = mesh.vertices[at(t[2])];
    const Vec3 area = (b - a).cross(c - a);
    for (const int v : t) normals[at(v)] += area;
  }
  for (Vec3& n : normals) n = n.norm() > 0 ? Vec3(n.normalized()) : Vec3::UnitZ();
  return normals;
}

SmoothCells::Node between(const SmoothCells::Node& a, const SmoothCells::Node& b, const SmoothCells::Node& c,
                          const Vec3& l) {
  const Vec3 n = l[0] * a.n + l[1] * b.n + l[2] * c.n;
  return {l[0] * a.x + l[1] * b.x + l[2] * c.x, n.norm() > 0 ? Vec3(n.normalized()) : a.n,
          a.ridge || b.ridge || c.ridge};
}

}  // namespace

SmoothCells::SmoothCells(Mesh mesh, std::shared_ptr<const Surface> surface)
    : mesh_(std::move(mesh)), surface_(std::move(surface)) {
  find_edges();
  place_corners();
  for (int cell = 0; cell < cell_count(); ++cell) {
    const auto c = corners(cell);
    longest_edges_.push_back(
        std::max({(c[0]->x - c[1]->x).norm(), (c[1]->x - c[2]->x).norm(), (c[2]->x - c[0]->x).norm()}));
    mean_ += longest_edge(cell) / cell_count();
  }
}

void SmoothCells::find_edges() {
  struct Use {
    int low, high, cell, side;
  };
  std::vector<Use> uses;
  for (int cell = 0; cell < cell_count(); ++cell) {
    const auto& t = mesh_.triangles[at(cell)];
    for (int side = 0; side < 3; ++side) {
      const auto [low, high] = std::minmax(t[at(side)], t[at((side + 1) % 3)]);
      uses.push_back({low, high, cell, side});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return std::tie(a.low, a.high, a.cell, a.side) < std::tie(b.low, b.high, b.cell, b.side);
  });
  edges_.resize(mesh_.triangles.size());
  for (std::size_t k = 0; k < uses.size(); ++k) {
    if (k == 0 || uses[k].low != uses[k - 1].low || uses[k].high != uses[k - 1].high) ++edge_count_;
    edges_[at(uses[k].cell)][at(uses[k].side)] = edge_count_ - 1;
  }
  neighbours_.assign(mesh_.triangles.size(), {-1, -1, -1});
  for (std::size_t k = 0, next = 0; k < uses.size(); k = next) {
    const auto edge = [&](std::size_t i) { return edges_[at(uses[i].cell)][at(uses[i].side)]; };
    while (next < uses.size() && edge(next) == edge(k)) ++next;
    if (next != k + 2) continue;
    neighbours_[at(uses[k].cell)][at(uses[k].side)] = uses[k + 1].cell;
    neighbours_[at(uses[k + 1].cell)][at(uses[k + 1].side)] = uses[k].cell;
  }
}

void SmoothCells::place_corners() {
  const std::vector<Vec3> normals = mesh_normals(mesh_);
  corners_.resize(mesh_.vertices.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, corners_.size(), 256), [&](const auto& range) {
    for (std::size_t v = range.begin(); v != range.end(); ++v) {
      SurfacePoint foot;
      const bool known = surface_->project(mesh_.vertices[v], foot) && foot.n.dot(normals[v]) > kSameNormalCosine;
      corners_[v] = known ? Node{foot.p, foot.n} : Node{mesh_.vertices[v], normals[v]};
    }
  });
  for (const auto& t : mesh_.triangles) {
    const Vec3 &a = mesh_.vertices[at(t[0])], &b = mesh_.vertices[at(t[1])], &c = mesh_.vertices[at(t[2])];
    const Vec3 area = (b - a).cross(c - a);
    for (const int v : t)
      if (area.dot(corners_[at(v)].n) < kRidgeCosine * area.norm()) corners_[at(v)].ridge = true;
  }
}

std::array<const SmoothCells::Node*, 3> SmoothCells::corners(int cell) const {
  const auto& t = mesh_.triangles[at(cell)];
  return {&corners_[at(t[0])], &corners_[at(t[1])], &corners_[at(t[2])]};
}

const Vec3& SmoothCells::corner(int cell, int k) const { return corners_[at(mesh_.triangles[at(cell)][at(k)])].x; }

int SmoothCells::neighbour(int cell, int side) const { return neighbours_[at(cell)][at(side)]; }

int SmoothCells::edge(int cell, int side) const { return edges_[at(cell)][at(side)]; }

int SmoothCells::node_count(int divisions) const {
  return static_cast<int>(corners_.size()) + edge_count_ * (divisions - 1) +
         cell_count() * ((divisions - 1) * (divisions - 2) / 2);
}

int SmoothCells::number(const Place& p) const {
  const auto& t = mesh_.triangles[at(p.cell)];
  const int n = p.divisions, rest = n - p.i - p.j;
  const auto on_edge = [&](int side, int steps) {
    const bool forward = t[at(side)] < t[at((side + 1) % 3)];
    return static_cast<int>(corners_.size()) + edges_[at(p.cell)][at(side)] * (n - 1) + (forward ? steps : n - steps) -
           1;
  };
  if (rest == n) return t[0];
  if (p.i == n) return t[1];
  if (p.j == n) return t[2];
  if (p.j == 0) return on_edge(0, p.i);
  if (rest == 0) return on_edge(1, p.j);
  if (p.i == 0) return on_edge(2, rest);
  const int inside = (p.j - 1) * (n - 1) - (p.j - 1) * p.j / 2 + p.i - 1;  // rows of n - 1 - j
  return static_cast<int>(corners_.size()) + edge_count_ * (n - 1) + p.cell * ((n - 1) * (n - 2) / 2) + inside;
}

SmoothCells::Node SmoothCells::node(const Place& p, double length) const {
  const auto c = corners(p.cell);
  const auto share = shares(p);
  const Vec3 l(share[0], share[1], share[2]);
  if (l.maxCoeff() == 1) return l[0] == 1 ? *c[0] : l[1] == 1 ? *c[1] : *c[2];
  const auto& t = mesh_.triangles[at(p.cell)];
  Node flat;
  double room = longest_edge(p.cell);
  Eigen::Index opposite = 0;
  if (l.minCoeff(&opposite) == 0) {
    // On an edge: from its lower vertex to the higher one, so that both cells compute the same bits.
    int a = (static_cast<int>(opposite) + 1) % 3, b = (static_cast<int>(opposite) + 2) % 3;
    if (t[at(a)] > t[at(b)]) std::swap(a, b);
    flat = between(*c[at(a)], *c[at(b)], *c[at(b)], {l[a], l[b], 0});
    room = (c[at(a)]->x - c[at(b)]->x).norm();
  } else {
    flat = between(*c[0], *c[1], *c[2], l);
  }
  SurfacePoint foot;
  if (!surface_->project(flat.x, foot)) return flat;
  const double off = (foot.p - flat.x).norm() + length * (foot.n - flat.n).norm();
  return off <= kCellBulge * kCellSlack * room ? Node{foot.p, foot.n} : flat;
}

SmoothCells::Node SmoothCells::middle(int cell) const {
  const auto c = corners(cell);
  return between(*c[0], *c[1], *c[2], Vec3::Constant(1.0 / 3));
}

double SmoothCells::radius(int cell, const Node& middle, double length) const {
  double off = 0, turn = 0;
  for (const Node* c : corners(cell)) {
    off = std::max(off, (c->x - middle.x).norm());
    turn = std::max(turn, (c->n - middle.n).norm());
  }
  return off + length * turn + kCellSlack * longest_edge(cell);
}

}  // namespace genu
