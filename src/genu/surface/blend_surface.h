// A triangle mesh as one smooth surface: a globally C2 implicit blend of local polynomial fits.
//
// Fits of degree d to exact vertices give position, normal and curvature of orders d + 1, d and d - 1 in the mesh's
// edge length, and a sheet has no seams: contact points travel over it as over a sphere. It exists in a band round
// the mesh, about half a blend radius thick to either side and past its edges (edge_distance tells).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/mesh/boundary_edges.h"
#include "genu/surface/blend_field.h"
#include "genu/surface/blend_nodes.h"
#include "genu/surface/fit_uncertainty.h"
#include "genu/surface/surface.h"
#include "genu/surface/tolerances.h"

namespace genu {

/// What is left empty is chosen from the mesh (fit_choice.h).
struct BlendOptions {
  std::optional<double> fit_radius;  ///< m, at least the mesh's median edge
  std::optional<int> degree;         ///< 2, 3 or 4
};

/// What was chosen, and why: for the report.
struct BlendFacts {
  int degree = 0;
  double fit_radius = 0;    ///< m
  double blend_radius = 0;  ///< m
  double node_spacing = 0;  ///< m
  int node_count = 0;
  int sheet_count = 0;
  double median_edge = 0;      ///< m
  MeshNoise noise;             ///< of the mesh's vertices about the surface; 0 where none is seen
  FitUncertainty uncertainty;  ///< what it does to the surface; rms over it
  std::string why;
};

class BlendSurface final : public Surface {
 public:
  /// Null, with an error in `diagnostics` under `name`, where the mesh or an option cannot be used.
  [[nodiscard]] static std::unique_ptr<BlendSurface> build(Mesh mesh, const BlendOptions& options,
                                                           const std::string& name, Diagnostics& diagnostics);

  /// Follows grad f to f = 0 by Newton's method. False outside the band.
  bool project(const Vec3& x, SurfacePoint& out) const override { return settle(x, false, out); }
  bool retract(const SurfacePoint& from, const Vec2& ds, SurfacePoint& out) const override;
  /// One evaluation of f.
  bool retract_roughly(const SurfacePoint& from, const Vec2& ds, SurfacePoint& out) const override;
  /// f/|grad f|: exact on the surface, second order off it.
  std::optional<double> gap(const Vec3& x) const override;
  bool meet(const Vec3& origin, const Vec3& direction, double& t, Vec3& normal) const override;
  /// Of the level surface of f through x.
  bool bending(const Vec3& x, const Vec3& t, Bending& out) const override;
  /// The distance of its nodes: each is a piece of the blend.
  double smooth_length() const override { return facts_.node_spacing; }
  /// Exact up to edge_cap(), which is returned beyond.
  double edge_distance(const Vec3& p) const override;
  Mesh triangles(double edge, const Vec3& centre, double reach) const override;
  /// The nodes, whatever the spacing: they lie on the surface and stand about node_spacing apart.
  SampleSet samples(double spacing, const Vec3& centre, double reach) const override;
  std::span<const DoubtfulPlace> doubtful() const override { return doubtful_; }
  bool is_global() const override { return false; }

  /// The implicit function (see blend_field.h): false outside the band.
  bool implicit(const Vec3& x, double& f) const { return field_.value(x, f); }
  bool implicit(const Vec3& x, double& f, Vec3& gradient) const { return field_.value(x, f, gradient); }
  bool implicit(const Vec3& x, double& f, Vec3& gradient, Mat3& hessian) const {
    return field_.value(x, f, gradient, hessian);
  }

  /// Where the mesh was wrong; their reach becomes the blend radius.
  void set_doubtful(std::vector<DoubtfulPlace> places);

  const BlendFacts& facts() const { return facts_; }
  const Mesh& mesh() const { return mesh_; }
  double edge_cap() const { return kEdgeCap * facts_.blend_radius; }

  /// The nodes, put onto the surface: an even sample of it, `node_spacing` apart.
  const std::vector<Vec3>& node_positions() const { return node_positions_; }
  const std::vector<Vec3>& node_normals() const { return node_normals_; }  ///< outward unit normals there
  /// Nodes of the same sheet within twice the spacing: a node lower than all of them is a local minimum of a gap.
  std::span<const int> node_neighbours(int node) const { return node_links_.of(node); }

  /// What another run saved by serialize().
  template <typename Archive>
  [[nodiscard]] static std::unique_ptr<BlendSurface> restored(Archive& from) {
    std::unique_ptr<BlendSurface> surface(new BlendSurface);
    surface->serialize(from);
    return surface;
  }
  template <typename Archive>
  void serialize(Archive& a) {
    a(mesh_, facts_, field_, boundary_, node_component_, node_positions_, node_normals_, node_areas_, node_links_,
      doubtful_);
  }

 private:
  BlendSurface() = default;
  BlendSurface(Mesh mesh, BlendFacts facts, const VertexGraph& graph, const std::vector<NodeSeed>& seeds,
               const std::vector<HeightFit>& fits);
  bool settle(const Vec3& x, bool near, SurfacePoint& out) const;
  void place_nodes(const std::vector<HeightFit>& fits, const VertexGraph& graph);

  Mesh mesh_;
  BlendFacts facts_;
  BlendField field_;
  BoundaryEdges boundary_;
  std::vector<int> node_component_;
  std::vector<Vec3> node_positions_, node_normals_;
  std::vector<double> node_areas_;  // m^2: each vertex gives its area to the nearest node
  NodeLinks node_links_;
  std::vector<DoubtfulPlace> doubtful_;
};

}  // namespace genu
