// The triangles of a mesh, each bent through six points of the smooth surface: its corners and the places over the
// middles of its edges. Neighbours share the curve between them, so that a line which passes through the surface meets
// one of them. They follow the smooth surface to the third order in the edge length, and a line meets them in a tenth
// of the time.
#pragma once

#include <memory>
#include <vector>

#include "genu/contact/smooth_cells.h"

namespace genu {

class CurvedFacets {
 public:
  /// x(u, v) = c[0] + c[1] u + c[2] v + c[3] u^2 + c[4] u v + c[5] v^2, with the corners at (0, 0), (1, 0), (0, 1).
  struct Facet {
    std::array<Vec3, 6> c;
  };
  /// Facets that one thread has met.
  struct Memory {
    std::vector<int> place;  ///< of each cell: index into `facets`, -1: not yet
    std::vector<Facet> facets;
    std::vector<int> middle;  ///< of each edge: index into `middles`, -1: not yet
    std::vector<Vec3> middles;
  };
  struct Meeting {
    int facet = -1;
    double distance = 0;          ///< m, along the line
    Vec3 normal = Vec3::UnitZ();  ///< unit, outward
  };

  explicit CurvedFacets(std::shared_ptr<const SmoothCells> cells) : cells_(std::move(cells)) {}

  /// Where a line (unit direction) meets the facets, walking from one near by. False where the walk leads over the rim
  /// or does not end.
  bool meet(const Vec3& origin, const Vec3& direction, int from, Memory& memory, Meeting& out) const;

 private:
  const Facet& facet(int cell, Memory& memory) const;
  const Vec3& middle(int cell, int side, Memory& memory) const;

  std::shared_ptr<const SmoothCells> cells_;
};

}  // namespace genu
