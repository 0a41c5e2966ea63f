#include "genu/contact/curved_facets.h"

#include <algorithm>
#include <cmath>

#include "genu/contact/tolerances.h"

namespace genu {
namespace {

/// A line as the two planes that it lies in.
struct Line {
  Vec3 origin, a, b;

  Line(const Vec3& from, const Vec3& direction) : origin(from) {
    Eigen::Index least = 0;
    direction.cwiseAbs().minCoeff(&least);
    a = direction.cross(Vec3::Unit(least)).normalized();
    b = direction.cross(a);
  }
};

struct OnFacet {
  double u = 1.0 / 3, v = 1.0 / 3;
  Vec3 x, along_u, along_v;

  /// The side beyond which it lies furthest, and how far in barycentric coordinates (negative outside).
  double inside(int& side) const {
    const double w = 1 - u - v;
    side = w < u && w < v ? 1 : u < v ? 2 : 0;
    return std::min({w, u, v});
  }
};

/// Newton's method from the facet's middle. False where it does not converge; true with a place far outside of the
/// facet as soon as it is seen to be there.
bool solve(const CurvedFacets::Facet& f, const Line& line, OnFacet& here) {
  for (int step = 0; step < kMostFacetSteps; ++step) {
    const double u = here.u, v = here.v;
    here.x = f.c[0] + u * (f.c[1] + u * f.c[3] + v * f.c[4]) + v * (f.c[2] + v * f.c[5]);
    here.along_u = f.c[1] + 2 * u * f.c[3] + v * f.c[4];
    here.along_v = f.c[2] + u * f.c[4] + 2 * v * f.c[5];
    const Vec3 off = here.x - line.origin;
    const double au = line.a.dot(here.along_u), av = line.a.dot(here.along_v), bu = line.b.dot(here.along_u),
                 bv = line.b.dot(here.along_v), ra = line.a.dot(off), rb = line.b.dot(off), det = au * bv - av * bu;
    const double du = (av * rb - bv * ra) / det, dv = (bu * ra - au * rb) / det;
    if (!std::isfinite(du + dv)) return false;
    here.u += du;
    here.v += dv;
    here.x += du * here.along_u + dv * here.along_v;
    if (std::abs(du) + std::abs(dv) < kFacetStep) return true;
    int side = 0;
    if (here.inside(side) < -kFacetLeave) return true;
  }
  return false;
}

}  // namespace

const Vec3& CurvedFacets::middle(int cell, int side, Memory& memory) const {
  int& index = memory.middle[at(cells_->edge(cell, side))];
  if (index < 0) {
    constexpr int kPlace[3][2] = {{1, 0}, {1, 1}, {0, 1}};
    index = static_cast<int>(memory.middles.size());
    memory.middles.push_back(cells_->node({cell, 2, kPlace[side][0], kPlace[side][1]}, 0).x);
  }
  return memory.middles[at(index)];
}

const CurvedFacets::Facet& CurvedFacets::facet(int cell, Memory& memory) const {
  if (memory.place.empty()) {
    memory.place.assign(at(cells_->cell_count()), -1);
    memory.middle.assign(at(cells_->edge_count()), -1);
  }
  int& index = memory.place[at(cell)];
  if (index < 0) {
    index = static_cast<int>(memory.facets.size());
    const Vec3 x0 = cells_->corner(cell, 0), x1 = cells_->corner(cell, 1), x2 = cells_->corner(cell, 2);
    const Vec3 x01 = middle(cell, 0, memory), x12 = middle(cell, 1, memory), x20 = middle(cell, 2, memory);
    memory.facets.push_back({{x0, 4 * x01 - 3 * x0 - x1, 4 * x20 - 3 * x0 - x2, 2 * (x0 + x1) - 4 * x01,
                              4 * (x0 - x01 - x20 + x12), 2 * (x0 + x2) - 4 * x20}});
  }
  return memory.facets[at(index)];
}

bool CurvedFacets::meet(const Vec3& origin, const Vec3& direction, int from, Memory& memory, Meeting& out) const {
  const Line line(origin, direction);
  int before = -1;
  for (int walked = 0, cell = from; walked < kMostFacetsWalked; ++walked) {
    OnFacet here;
    if (!solve(facet(cell, memory), line, here)) return false;
    int side = 0;
    const double inside = here.inside(side);
    const int next = inside < -kFacetEdge ? cells_->neighbour(cell, side) : -1;
    if (next < 0 || next == before) {
      if (inside < -kFacetOver) return false;
      out.facet = cell;
      out.distance = direction.dot(here.x - origin);
      out.normal = here.along_u.cross(here.along_v).normalized();
      return true;
    }
    before = cell;
    cell = next;
  }
  return false;
}

}  // namespace genu
