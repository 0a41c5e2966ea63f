// A piece of a mesh that lies over a disc like a graph: every line near its axis and about along it crosses the piece
// exactly once, and is found by walking from triangle to triangle.
#pragma once

#include <array>
#include <vector>

#include "genu/mesh/triangle_tree.h"

namespace genu {

/// The piece is spread over all edges from a triangle on its axis until it leaves a cylinder about that. It is taken
/// only if
///   - no normal leans off the axis by more than 50 deg and no edge within the cylinder is free or shared by more than
///     two triangles, so that the piece, seen along the axis, covers the disc evenly;
///   - round no vertex it winds twice, so that it covers the disc once: it is a graph, of slopes as bounded as its
///     normals are, and a line crosses it once that is off the axis by less than what these leave of 90 deg;
///   - everything else in the cylinder turns its back on rays that are off the axis by 20 deg or more (how much,
///     choose_angle() finds): these come out of this piece or of none.
class TriangleSheet {
 public:
  /// What spread() marks triangles and vertices with; kept from one to the next.
  struct Marks {
    std::vector<int> triangle, vertex;  ///< the stamp of the spreading that came by last
    std::vector<int> facet;             ///< of a triangle with the stamp
    int stamp = 0;
    ClustersNear clusters;
  };

  /// Round the triangles [first, last) of the tree's order, for rays of `length` (m).
  void spread(const TriangleTree& tree, int first, int last, double length, Marks& marks);
  /// Whether it could be taken.
  bool good() const { return good_; }

  struct Meeting {
    bool sure = false;      ///< false: what the ray meets is not known; for instance it passes through an edge exactly
    TriangleTree::Hit hit;  ///< what TriangleTree::leaving finds
    int place = -1;         ///< of the triangle that the ray's line crosses, in the tree
    double clear = 0;       ///< m: where nothing is met, the motion of the ray that leaves that so
    bool alone = false;     ///< whether the ray crosses nothing else of the mesh before `hit`, surely
    bool roomy = false;     ///< whether the ray is well inside of what the sheet is good for
  };
  /// `facet`: where to begin (0 at first), and where the walk ended.
  Meeting meet(const TriangleTree& tree, const Vec3& origin, const Vec3& direction, double length, int& facet) const;

 private:
  struct Facet {
    int place;                  // in the tree
    std::array<int, 3> beside;  // the facet across the edge from corner i to the next; -1 beyond the sheet
  };
  struct Cylinder {
    Vec3 origin = Vec3::Zero(), axis = Vec3::UnitZ(), across = Vec3::UnitX(), upward = Vec3::UnitY();
    double radius = 0, low = 0, high = 0;  // m
    double roomy = 0;                      // m: of the radius, well inside

    Vec2 seen(const Vec3& p) const { return {across.dot(p - origin), upward.dot(p - origin)}; }
    bool passes_by(const std::array<Vec3, 3>& corners) const;
    bool excludes(const std::array<Vec3, 3>& corners) const;
  };

  double clearance(const RayLine& line, double t, double z, double aside2, double along) const;
  Meeting meet_facet(const TriangleTree& tree, const RayLine& line, int place, double along) const;
  bool choose_axis(const TriangleTree& tree, int first, int last, double length);
  bool grow(const TriangleTree& tree, Marks& marks);
  int join(const TriangleTree& tree, int place, Marks& marks);
  bool winds_once(const TriangleTree& tree, int place, Marks& marks) const;
  bool choose_angle(const TriangleTree& tree, Marks& marks);

  bool good_ = false;
  Cylinder cylinder_;
  double lean_ = 1;   // the cosine of the largest angle between a normal and the axis
  double along_ = 1;  // the cosine of the largest between a ray and the axis
  double backs_ = 0;  // m along the axis: everything else in the cylinder lies below
  std::vector<Facet> facets_;
};

}  // namespace genu
