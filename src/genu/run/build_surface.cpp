#include "genu/run/build_surface.h"

#include "genu/geometry/analytic.h"

namespace genu {
namespace {

std::vector<PolynomialTerm> polynomial_terms(const SurfaceDef& def) {
  std::vector<PolynomialTerm> terms;
  terms.reserve(def.terms.size());
  for (const SurfaceDef::Term& t : def.terms) terms.push_back({t.i, t.j, t.c});
  return terms;
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

}  // namespace genu
