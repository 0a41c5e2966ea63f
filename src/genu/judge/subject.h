// The subject of a judgement: a scene with its meshes and its ligaments' slack lengths, computed once for all poses.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/judge/bent_facets.h"
#include "genu/judge/facets.h"
#include "genu/judge/joints.h"
#include "genu/judge/shape.h"
#include "genu/judge/tension.h"
#include "genu/scene/scene.h"

namespace genu::judge {

/// A surface: a closed form or triangles.
struct Side {
  int index = -1;                          ///< in Scene::surfaces
  std::shared_ptr<const Facets> facets;    ///< null for a closed form
  std::shared_ptr<const BentFacets> bent;  ///< of a mesh in a layer between smooth surfaces
  std::optional<Shape> shape;              ///< empty for a mesh
};

struct Mass {
  double m = 0;                 ///< kg
  Vec3 centre = Vec3::Zero();   ///< m, in the body
  Mat3 inertia = Mat3::Zero();  ///< kg m^2, about the centre, axes of the body
};

struct Subject {
  Scene scene;
  std::vector<Side> sides;                   ///< of Scene::surfaces
  std::vector<std::vector<Sample>> samples;  ///< of Scene::surfaces: bounded closed forms
  std::vector<std::vector<Sample>> pieces;   ///< the same, also beside the patch
  int sampled = 0;                           ///< samples along each side, about
  std::vector<TensionLaw> laws;
  std::vector<Mass> masses;  ///< of Scene::bodies
  double size = 0;           ///< m: of the scene, for tolerances: the largest distance of its points from their mean
  /// N: the largest load or weight, or the force at 1 % strain of the stiffest ligament. Residuals refer to it where
  /// almost no force acts.
  double force_scale = 0;
  double springs = 0;      ///< N/m: of all ligaments, converts the last digit of a place into a force
  double least_force = 0;  ///< N: rounding of lengths in ligaments about to become taut
};

/// Reads the meshes of the scene. `samples`: along each side of a closed form. Empty, with the reasons in `out`, where
/// a mesh cannot be read.
[[nodiscard]] std::shared_ptr<const Subject> make_subject(const Scene& scene, int samples, Diagnostics& out);

/// Mass, centre and inertia of a closed mesh of uniform density, from tetrahedra between its triangles and a point.
Mass mass_of(const Mesh& mesh, const Pose& placement, double density);

}  // namespace genu::judge
