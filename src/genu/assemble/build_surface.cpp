#include "genu/assemble/build_surface.h"

#include "genu/assemble/surface_fits.h"
#include "genu/assemble/tolerances.h"
#include "genu/shape_fit/chart_mesh.h"
#include "genu/surface/analytic.h"
#include "genu/surface/front_distance.h"
#include "genu/surface/patch.h"

namespace genu {
namespace {

std::vector<PolynomialTerm> polynomial_terms(const SurfaceDef& def) {
  std::vector<PolynomialTerm> terms;
  terms.reserve(def.terms.size());
  for (const SurfaceDef::Term& t : def.terms) terms.push_back({t.i, t.j, t.c});
  return terms;
}

/// Along which of its own axes a shape has no end.
std::array<bool, 3> endless_axes(SurfaceDef::Shape shape) {
  using Shape = SurfaceDef::Shape;
  const bool sheet = shape == Shape::plane || shape == Shape::polynomial;
  const bool tube = shape == Shape::cylinder || shape == Shape::cylindrical_polynomial;
  return {sheet, sheet, tube};
}

}  // namespace

std::unique_ptr<Surface> make_analytic_surface(const SurfaceDef& def) {
  using Shape = SurfaceDef::Shape;
  switch (def.shape) {
    case Shape::plane:
      return make_plane(def.placement, def.inside);
    case Shape::sphere:
      return make_sphere(def.placement, def.radius, def.inside);
    case Shape::ellipsoid:
      return make_ellipsoid(def.placement, def.radii, def.inside);
    case Shape::cylinder:
      return make_cylinder(def.placement, def.radius, def.inside);
    case Shape::torus:
      return make_torus(def.placement, def.major_radius, def.minor_radius, def.inside);
    case Shape::polynomial:
      return make_polynomial(def.placement, polynomial_terms(def), def.inside);
    case Shape::cylindrical_polynomial:
      return make_cylindrical_polynomial(def.placement, polynomial_terms(def), def.inside);
    case Shape::mesh:
      break;
  }
  return nullptr;
}

std::shared_ptr<const Surface> within_patch(std::shared_ptr<const Surface> surface, const SurfaceDef& def) {
  if (!surface || !def.patch) return surface;
  std::function<Mesh(double)> own_mesh;
  // Past its patch a polynomial of high degree is anything: it is not cut into triangles there.
  std::function<double(const Vec3&)> front;
  if (const auto known = known_patch(def)) {
    own_mesh = [k = *known, terms = polynomial_terms(def)](double edge) {
      return chart_mesh(k.chart, k.patch, terms, k.inside, edge);
    };
    front = FrontDistance(known->chart, known->patch, polynomial_terms(def), known->inside);
  }
  std::shared_ptr<const Surface> part = make_patch(
      std::move(surface), def.placement, {def.patch->box, def.patch->theta}, endless_axes(def.shape), own_mesh, front);
  if (part->triangles(kPatchProbeEdge, def.placement.p, kPatchProbeReach).triangles.empty()) return nullptr;
  return part;
}

}  // namespace genu
