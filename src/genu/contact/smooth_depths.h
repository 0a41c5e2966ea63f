// Depths of a smooth surface's points in another: at nodes of the casting surface, along the inward normal.
//
// Lines from the corners of the cells go to the flat triangles of the target first, which tells whether they leave it
// and where (layer_rays.h). From there the depth is found on the smooth surface: on facets bent through its points
// (curved_facets.h) where the cells are not refined, else on the surface itself. Between corners that meet the target
// the search starts at the depth between theirs.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "genu/contact/curved_facets.h"
#include "genu/contact/layer_quadrature.h"
#include "genu/contact/layer_thickness.h"
#include "genu/contact/smooth_cells.h"

namespace genu {

class SmoothDepths {
 public:
  struct Depth {
    bool met = false;
    double depth = 0;       ///< m, negative outside
    Vec3 w = Vec3::Zero();  ///< its derivative, see add_pressure(); in casting axes
    int triangle = -1;      ///< of the target, -1: unknown
    double thickness = 0;   ///< m: measured on the target
    double flat = 0;        ///< m: depth to the target's triangles, there
    Vec3 u = Vec3::Zero();  ///< derivative of `thickness`, see thickness_rate(); in casting axes
  };

  /// `target`: the surface `other`, divided, with its triangles in `tree`. The thickness belongs to the meshes of both.
  SmoothDepths(std::shared_ptr<const SmoothCells> casting, std::shared_ptr<const SmoothCells> target,
               std::shared_ptr<const TriangleTree> tree, double search_depth, const LayerLaw& law,
               LayerThickness thickness);

  /// Turns to a pose and a lattice, and lists the cells that may be in contact.
  void begin(const Pose& X_TC, int divisions, LayerQuadrature::Memory& memory) const;
  /// Index of a node, which may be new: references to others end.
  int index(const SmoothCells::Place& place, SmoothNodes& known) const;
  /// With the values of the pose. Nodes may be new.
  SmoothNode& node(const Pose& X_TC, const SmoothCells::Place& place, int index, LayerQuadrature::Memory& memory) const;
  SmoothNode& corner(const Pose& X_TC, int cell, int k, LayerQuadrature::Memory& memory) const;

  /// On the smooth surface itself: along the normal at any point.
  Depth measure(const Pose& X_TC, const SmoothCells::Node& node, int hint) const;
  /// The same, begun at a depth (m) near by. False where none is found.
  bool follow(const Pose& X_TC, const SmoothCells::Node& node, double from, Depth& out) const;

  const SmoothCells& casting() const { return *casting_; }
  const TriangleTree& tree() const { return *tree_; }
  const LayerThickness& thickness() const { return thickness_; }
  const LayerLaw& law() const { return law_; }
  /// m: of the lines, inward and outward.
  double reach() const { return std::max(lead_, search_depth_); }

 private:
  using Memory = LayerQuadrature::Memory;
  /// The normal at a node, inward, in the target's frame.
  struct Line {
    Vec3 origin, direction;
  };

  Depth measure_corner(const Pose& X_TC, const SmoothCells::Place& place, const Line& line, Memory& memory) const;
  bool beyond_lead(const SmoothCells::Place& place, const Line& line, Memory& memory, Depth& out) const;
  bool beyond_lead_of(int cell, double limit, const Line& line, Memory& memory, Depth& out) const;
  double lead() const;
  Depth measure_inside(const Pose& X_TC, const SmoothCells::Place& place, const Line& line, int hint,
                       Memory& memory) const;
  bool cast(const Line& line, int hint, Depth& out) const;
  void bend(const Pose& X_TC, const Line& line, Memory& memory, Depth& out) const;
  bool follow(const Pose& X_TC, const Line& line, double from, Depth& out) const;
  bool follow_facets(const Pose& X_TC, const Line& line, double from, Memory& memory, Depth& out) const;
  bool accept(const Pose& X_TC, const Line& line, double from, double depth, const Vec3& m, Depth& out) const;
  void accept_flat(const Pose& X_TC, const Line& line, Depth& out) const;
  void add_thickness(const Pose& X_TC, const Line& line, Depth& out) const;
  static Line line_from(const Pose& X_TC, const Vec3& x, const Vec3& n) { return {X_TC * x, -(X_TC.R * n)}; }
  double own_thickness(const SmoothCells::Place& place) const;
  void set(Depth d, SmoothNode& node) const;

  std::shared_ptr<const SmoothCells> casting_;
  std::shared_ptr<const SmoothCells> target_;
  std::shared_ptr<const TriangleTree> tree_;
  double search_depth_, edge_, lead_, trust_;  // m; `edge_`: mean of the target
  LayerLaw law_;
  LayerThickness thickness_;
  CurvedFacets facets_;
  LayerRays rays_;                       // from the corners
  std::vector<int> first_cell_, cells_;  // at each corner v: cells_[first_cell_[v]] and on
};

}  // namespace genu
