// A joint from the text of a scene whose surfaces all have a formula.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "genu/model/build_model.h"
#include "genu/model/state.h"
#include "genu/scene/centre_bodies.h"
#include "genu/scene/reader.h"
#include "genu/surface/analytic.h"

namespace genu::test {

inline std::shared_ptr<const Surface> formula_surface(const SurfaceDef& def) {
  using Shape = SurfaceDef::Shape;
  std::vector<PolynomialTerm> terms;
  for (const SurfaceDef::Term& t : def.terms) terms.push_back({t.i, t.j, t.c});
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
      return make_polynomial(def.placement, terms, def.inside);
    case Shape::cylindrical_polynomial:
      return make_cylindrical_polynomial(def.placement, terms, def.inside);
    case Shape::mesh:
      break;
  }
  return nullptr;
}

struct SceneModel {
  PlacedScene scene;
  JointModel model;
  Scene source;
};

/// Fails the test where the text is no good scene. A scene without a step gets one that prescribes nothing.
inline SceneModel scene_model(std::string text) {
  Diagnostics out;
  if (text.find("[[step]]") == std::string::npos) text += "\n[[step]]\nincrements = 1\n";
  auto scene = parse_scene(text, "scene.toml", out);
  if (scene) {
    std::vector<std::shared_ptr<const Surface>> surfaces;
    for (const SurfaceDef& def : scene->surfaces) surfaces.push_back(formula_surface(def));
    if (auto model = build_model(place(*scene), surfaces, out)) return {place(*scene), std::move(*model), *scene};
  }
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  return {};
}

/// What every scene here begins with: a fixed body `ground`, a moving body `bone` and the joint `j` between them.
inline std::string bone_on_ground(const std::string& reference = "{}") {
  return R"(format = 1
units = { length = "mm", angle = "rad" }
[body.ground]
fixed = true
[body.bone]
[joint.j]
type = "free"
parent = "ground"
child = "bone"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
reference = )" +
         reference + "\n";
}

inline std::string surface(const std::string& name, const std::string& body, const std::string& shape,
                           const std::string& more = "") {
  return "[surface." + name + "]\nbody = \"" + body + "\"\nshape = \"" + shape + "\"\n" + more + "\n";
}

inline std::string contact(const std::string& name, const std::string& a, const std::string& b) {
  return "[contact." + name + "]\nsurfaces = [\"" + a + "\", \"" + b + "\"]\nmodel = \"rigid\"\n";
}

/// An elastic layer of 4 mm and 5 MPa; `more` names its quadrature.
inline std::string layer(const std::string& name, const std::string& a, const std::string& b,
                         const std::string& more = "") {
  return "[contact." + name + "]\nsurfaces = [\"" + a + "\", \"" + b +
         "\"]\nmodel = \"cartilage\"\nmodulus = 5\npoisson = 0.4\nthickness = 4\n" + more + "\n";
}

/// A ligament from `point` of bone to `anchor` of ground; `more` names its law.
inline std::string ligament(const std::string& name, const std::string& point, const std::string& anchor,
                            const std::string& more) {
  return "[ligament." + name + "]\nfrom = { body = \"bone\", point = " + point +
         " }\nto = { body = \"ground\", point = " + anchor + " }\n" + more + "\n";
}

/// A two-way spring (N/mm) at its rest length `slack` (mm).
inline std::string spring(const std::string& name, const std::string& point, const std::string& anchor,
                          double stiffness, double slack) {
  return ligament(
      name, point, anchor,
      "law = \"spring\"\nstiffness = " + std::to_string(stiffness) + "\nslack_length = " + std::to_string(slack));
}

inline std::string load(const std::string& name, const std::string& more) {
  return "[load." + name + "]\nbody = \"bone\"\n" + more + "\n";
}

inline std::string step(const std::string& more) { return "[[step]]\n" + more + "\n"; }

/// What the first step of a scene asks at its beginning (t = 0) or end (t = 1).
inline Target target_of(const SceneTables& scene, double t = 0, std::size_t index = 0) {
  Target target;
  target.load_factors.assign(scene.loads.size(), 1);
  if (scene.steps.empty()) return target;
  const StepDef& s = scene.steps[index];
  for (const auto& p : s.prescribe) target.prescribed.push_back({p.coordinate, (1 - t) * p.from + t * p.to});
  for (const auto& f : s.factors) target.load_factors[static_cast<std::size_t>(f.load)] = (1 - t) * f.from + t * f.to;
  return target;
}

/// Dortmans' knee (1984), simplified: two tori on two planes and seven springs, here with loads added.
inline std::string knee(const std::string& more) {
  std::string text = R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.bone]
[joint.knee]
type = "free"
parent = "ground"
child = "bone"
rotations = ["flexion x", "adduction y", "rotation z"]
translations = ["x", "y", "z"]
reference = { y = 2.38, z = 20 }
)";
  for (const auto& [name, x] : {std::pair<std::string, std::string>{"medial", "-23"}, {"lateral", "23"}}) {
    text += surface(
        "torus_" + name, "bone", "torus",
        "origin = [" + x + ", 0, 0]\nx_axis = [0, 1, 0]\n" + "z_axis = [1, 0, 0]\nmajor_radius = 15\nminor_radius = 5");
    text += surface("plane_" + name, "ground", "plane", "origin = [" + x + ", 0, 0]");
    text += contact(name, "torus_" + name, "plane_" + name);
  }
  const auto quadratic = [&](const std::string& name, const std::string& from, const std::string& to, double k,
                             double e) {
    text +=
        ligament(name, from, to,
                 "law = \"quadratic\"\nstiffness = " + std::to_string(k) + "\nreference_strain = " + std::to_string(e));
  };
  quadratic("AAC", "[12.25, -7.84, 0.0]", "[-6.04, 4.0, -3.0]", 37200, -0.0175);
  quadratic("PAC", "[2.0, -9.0, -5.0]", "[1.93, -0.59, -3.0]", 27000, 0.0597);
  quadratic("APC", "[-8.43, 14.0, -6.75]", "[-0.4, -18.19, -15.0]", 18900, -0.008);
  quadratic("PPC", "[-8.42, 1.85, 2.08]", "[-1.63, -23.73, -8.99]", 11800, 0.015);
  quadratic("LC", "[40.04, 2.73, 6.64]", "[34.89, -11.0, -43.7]", 19400, 0.0589);
  quadratic("AMC", "[-37.75, 5.0, 2.12]", "[-23.55, 6.43, -61.78]", 43100, -0.0239);
  quadratic("PMC", "[-35.48, 0.29, 8.28]", "[-30.86, -11.48, -58.06]", 23000, 0.0625);
  return text + more;
}

}  // namespace genu::test
