// One polynomial height fitted to the vertices of one sheet round one point.
//
// The vertices are found by walking over the mesh's edges inside a ball and a cone of normals, so that the other face
// of a thin shell, or the other condyle, never takes part. Facet interiors are not on the surface and are not used.
// A vertex counts by the area it stands for, so that an irregular mesh does not bias the fit, times a kernel that
// vanishes at the fit radius, so that no vertex enters or leaves with a jump.
//
// Vertices that stand in three rows leave a cubic undetermined, the product of the rows' lines: where they all but do,
// what a polynomial of the degree cannot follow (micrometres) is multiplied a thousandfold between them (a torus of
// even triangles bulged by a millimetre). So a fit is taken only if it multiplies little.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "genu/mesh/mesh.h"
#include "genu/mesh/vertex_graph.h"
#include "genu/surface/height_polynomial.h"

namespace genu {

struct HeightFit {
  Vec3 origin = Vec3::Zero();                           ///< m
  Mat3 axes = Mat3::Identity();                         ///< columns u, v and the outward normal of the local frame
  int degree = 0;                                       ///< 0: no fit was possible
  std::array<double, kMaxCoefficients> coefficients{};  ///< of z(u, v), all in m, packed for `degree`
  double radius = 0;                                    ///< m, what the vertices were taken from
  int samples = 0;
  double residual_rms = 0;  ///< m, unbiased for white noise

  /// Height of order 2 at local (u, v), whatever the degree.
  Height height(double u, double v) const;

  /// The shape operator (1/m) in the mesh's frame, as a 3x3 tensor that is zero across, where local u and v are x's.
  Mat3 curvature(const Vec3& x) const;
};

/// What is wanted of a fit.
struct FitRequest {
  Vec3 origin = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< outward, a first guess (the frame's normal is averaged from the vertices)
  std::span<const int> seeds;   ///< vertices to follow from
  double radius = 0;            ///< m
  int degree = 3;
  bool may_adapt = true;  ///< enlarge the radius, then lower the degree, where the vertices are too few
};

/// Fits heights to a mesh; keeps its work space, so use one for each thread.
class HeightFitter {
 public:
  HeightFitter(const Mesh& mesh, const VertexGraph& graph);

  HeightFit fit(const FitRequest& request);

 private:
  void gather(const FitRequest& request, double radius);
  void average_normal(HeightFit& fit, double radius) const;
  bool solve(HeightFit& fit, int degree, double radius);
  bool determined(const HeightFit& fit, const Eigen::Ref<const MatX>& R, int degree, double radius,
                  double weight) const;

  const Mesh& mesh_;
  const VertexGraph& graph_;
  std::vector<int> stamp_;
  int now_ = 0;
  std::vector<int> gathered_;
  std::vector<double> matrix_, right_;
};

}  // namespace genu
