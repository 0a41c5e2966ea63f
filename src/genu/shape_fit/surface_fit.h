// A polynomial surface (Wismans et al. 1980) fitted to a piece of a mesh, with the patch on which it may be trusted.
//
//   0. chart and patch of a sheet that was cut from a polynomial: its border has them (patch_border.h)
//   1. else the chart: a plane or an axis (chart_choice.h)
//   2. the patch: the largest rectangle of the chart that the piece fills (covered_box.h), a little less in round
//   numbers
//   3. the degree: cross-validation over blocks (polynomial_fit.h), lowered until the polynomial neither folds nor
//      swings out where no surface is under it
//   4. the frame of a plane: moved until the polynomial starts level from it
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/mesh/mesh.h"
#include "genu/shape_fit/polynomial_fit.h"
#include "genu/surface/surface.h"
#include "genu/surface/surface_chart.h"

namespace genu {

/// What is known before a fit.
struct KnownPatch {
  SurfaceChart chart;
  bool inside = false;
  ChartBox patch;
  int degree = 0;
};

struct SurfaceFitOptions {
  std::optional<bool> cylindrical;  ///< chosen where empty
  std::optional<Vec3> axis;         ///< where the axis of a cylindrical chart points; chosen where empty
  std::optional<int> degree;        ///< kLowestFitDegree .. kHighestFitDegree; chosen where empty
  /// Points (m) of the mesh's frame that the patch has to hold, and how far (m) it may go beyond them; without points
  /// it goes as far as the zone.
  std::vector<Vec3> keep;
  double margin = 0.006;
  bool one_face = false;           ///< known to be; else a piece that holds both faces of a shell is refused
  std::optional<KnownPatch> like;  ///< another fit's chart, patch and (where none is given) degree: taken as they are
};

/// Where a surface lies off the vertices it was fitted to, along its normals.
struct FitResidual {
  double rms = 0;             ///< m, weighted by area
  double largest = 0;         ///< m, signed: positive where the vertex is outside of the fitted surface
  Vec3 where = Vec3::Zero();  ///< m, the vertex
  int count = 0;              ///< vertices on the patch
};

struct SurfaceFit {
  SurfaceChart chart;
  bool inside = false;  ///< the outward side is toward the axis
  ChartBox patch;       ///< centred on (0, 0)
  int degree = 0;
  int wanted_degree = 0;  ///< what cross-validation asked for; 0 where the degree was given
  std::vector<PolynomialTerm> terms;
  std::vector<DegreeScore> scores;  ///< of the degrees tried; empty where the degree was given
  FitResidual residual;
  double noise = 0;              ///< m, rms, of the zone's vertices about any smooth surface (mesh_noise.h)
  double covered = 0;            ///< share of the patch that lies over the zone
  Mesh zone;                     ///< the piece that faces the chart's way
  std::vector<double> distance;  ///< m, of each vertex of `zone` to the fitted surface; NaN off the patch

  /// The whole polynomial, without the patch's edges.
  std::unique_ptr<Surface> surface() const;
};

/// Fits a polynomial to `zone`, a piece of one face of a surface. Empty, with the reason under `name` in `out`, where
/// the piece is empty, flat, too coarse, holds both faces of a shell, or bends so that no chart describes it.
[[nodiscard]] std::optional<SurfaceFit> fit_surface(const Mesh& zone, const SurfaceFitOptions& options,
                                                    const std::string& name, Diagnostics& out);

}  // namespace genu
