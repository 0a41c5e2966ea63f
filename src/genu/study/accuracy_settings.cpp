#include "genu/study/accuracy_settings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/assemble/build_surface.h"
#include "genu/contact/proximity.h"
#include "genu/core/units.h"
#include "genu/mesh/mesh_coarsen.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/model/build_model.h"
#include "genu/scene/tolerances.h"
#include "genu/study/tolerances.h"
#include "genu/surface/blend_surface.h"
#include "genu/surface/facet_surface.h"

namespace genu {
namespace {

bool is_mesh(const Prepared& p, std::size_t surface) {
  return p.scene.surfaces[surface].shape == SurfaceDef::Shape::mesh;
}

bool any_mesh(const Prepared& p) {
  for (std::size_t i = 0; i < p.surfaces.size(); ++i)
    if (is_mesh(p, i)) return true;
  return false;
}

bool any_fit(const Prepared& p) {
  return std::any_of(p.notes.begin(), p.notes.end(), [](const SurfaceNote& n) { return n.blend != nullptr; });
}

bool changes_surfaces(const AccuracySetting& s) { return s.edge_factor > 0 || s.degree > 0 || s.radius_factor > 0; }

/// The surface under a setting, without its patch.
std::shared_ptr<const Surface> rebuilt(const Prepared& p, std::size_t surface, const AccuracySetting& setting) {
  const SurfaceDef& def = p.scene.surfaces[surface];
  const SurfaceNote& note = p.notes[surface];
  if (is_mesh(p, surface) && note.blend == nullptr) {
    auto facets = std::make_shared<FacetSurface>(mesh_of(p, surface, setting));
    facets->set_doubtful({p.surfaces[surface]->doubtful().begin(), p.surfaces[surface]->doubtful().end()});
    return facets;
  }
  BlendOptions options{def.fit_radius, def.degree};
  if (setting.degree > 0) options.degree = setting.degree;
  if (setting.radius_factor > 0 && note.blend)
    options.fit_radius = setting.radius_factor * note.blend->facts().fit_radius;
  Diagnostics unused;
  auto surface_made = BlendSurface::build(mesh_of(p, surface, setting), options, def.name, unused);
  if (surface_made && note.blend)
    surface_made->set_doubtful({note.blend->doubtful().begin(), note.blend->doubtful().end()});
  return surface_made;
}

void change_layers(const AccuracySetting& setting, SceneTables& scene) {
  for (LayerDef& layer : scene.layers)
    if (setting.layer_tolerance > 0 && layer.quadrature == LayerDef::Quadrature::smooth)
      layer.tolerance = setting.layer_tolerance;
}

/// Layers in the place of rigid contacts, one ray from every triangle.
void make_layers(const Prepared& p, double modulus, SceneTables& scene) {
  for (const ContactDef& pair : scene.contacts) {
    LayerDef layer;
    layer.pair = pair;
    layer.modulus = modulus;
    layer.poisson = kTrialPoisson;
    layer.thickness = kTrialThickness;
    layer.search_depth = kTrialThickness;
    layer.quadrature = LayerDef::Quadrature::triangles;
    layer.cast_from = p.surfaces[at(pair.surface_a)]->is_unbounded() ? pair.surface_b : pair.surface_a;
    scene.layers.push_back(layer);
  }
  scene.contacts.clear();
}

}  // namespace

const char* to_string(AccuracySetting::Knob knob) {
  switch (knob) {
    case AccuracySetting::Knob::own:
      return "as it is";
    case AccuracySetting::Knob::mesh:
      return "edge and degree";
    case AccuracySetting::Knob::radius:
      return "fit radius";
    case AccuracySetting::Knob::tolerance:
      return "solver tolerance";
    case AccuracySetting::Knob::increments:
      return "increments";
    case AccuracySetting::Knob::layer:
      return "layer tolerance";
    case AccuracySetting::Knob::model:
      return "contact model";
  }
  return "";
}

double mesh_unit(const Prepared& p) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& surface : p.surfaces)
    if (!surface->is_unbounded()) smallest = std::min(smallest, box_diagonal(*surface, p.model.scales.length));
  return std::isfinite(smallest) ? smallest / 20 : 0;
}

bool has_closed_forms_alone(const Prepared& p) { return !any_mesh(p); }

std::vector<AccuracySetting> accuracy_settings(const Prepared& p) {
  using Knob = AccuracySetting::Knob;
  std::vector<AccuracySetting> out(1);
  const auto add = [&](AccuracySetting s, Knob knob) {
    s.knob = knob;
    out.push_back(s);
  };
  const bool meshes = any_mesh(p), fits = any_fit(p) || (!meshes && !p.scene.contacts.empty());
  std::vector<double> edges;
  if (meshes)
    edges = {1, 1.5, 2, 3};
  else if (mesh_unit(p) > 0)
    edges = {kFinestTrialEdge, 0.25, 0.35, 0.5, 0.7, 1};
  for (const double edge : edges)
    for (const int degree : fits ? std::vector<int>{2, 3, 4} : std::vector<int>{0})
      if (fits || edge > 1) add({.edge_factor = edge, .degree = degree}, Knob::mesh);
  if (any_fit(p))
    for (const double radius : {0.8, 1.25}) add({.radius_factor = radius}, Knob::radius);
  for (const double tolerance : {kLoosestSolverTolerance, SolverDef{}.tolerance})
    if (tolerance != p.scene.solver.tolerance) add({.tolerance = tolerance}, Knob::tolerance);
  for (const double times : {0.25, 0.5, 2.0}) {
    const auto whole = [&](const StepPlan& step) {
      return step.increments * times >= 1 && std::fmod(step.increments * times, 1.0) == 0;
    };
    if (std::all_of(p.steps.begin(), p.steps.end(), whole)) add({.increments = times}, Knob::increments);
  }
  const auto smooth = [](const LayerDef& l) { return l.quadrature == LayerDef::Quadrature::smooth; };
  if (std::any_of(p.scene.layers.begin(), p.scene.layers.end(), smooth))
    for (const double tolerance : {1e-2, 1e-3}) add({.layer_tolerance = tolerance}, Knob::layer);
  if (!p.scene.contacts.empty())
    for (const double modulus : {10e6, 1e9}) add({.modulus = modulus}, Knob::model);
  return out;
}

std::string describe(const Prepared& p, const AccuracySetting& s) {
  std::vector<std::string> words;
  if (s.edge_factor > 0 && !any_mesh(p))
    words.push_back(fmt::format("edge {:.2f} mm", to::kMillimetre * s.edge_factor * mesh_unit(p)));
  else if (s.edge_factor > 0) {
    double edge = 0;
    for (std::size_t i = 0; i < p.notes.size(); ++i)
      if (p.notes[i].mesh) edge = std::max(edge, p.notes[i].mesh->edge_length[2]);
    words.push_back(fmt::format("edge {:.2f} mm", to::kMillimetre * s.edge_factor * edge));
  }
  if (s.degree > 0) words.push_back(fmt::format("degree {}", s.degree));
  if (s.radius_factor > 0) words.push_back(fmt::format("fit radius x {:g}", s.radius_factor));
  if (s.tolerance > 0) words.push_back(fmt::format("tolerance {:.0e}", s.tolerance));
  if (s.increments > 0) words.push_back(fmt::format("increments x {:g}", s.increments));
  if (s.modulus > 0) words.push_back(fmt::format("layer of {:g} MPa", s.modulus / units::kMegapascal));
  if (s.layer_tolerance > 0) words.push_back(fmt::format("layer tolerance {:.0e}", s.layer_tolerance));
  if (words.empty()) return "as it is";
  std::string text = words[0];
  for (std::size_t i = 1; i < words.size(); ++i) text += ", " + words[i];
  return text;
}

bool changes_mesh(const Prepared& p, std::size_t surface, const AccuracySetting& s) {
  if (is_mesh(p, surface)) return s.edge_factor > 1;
  return s.edge_factor > 0 && !p.surfaces[surface]->is_unbounded() && !any_mesh(p);
}

Mesh mesh_of(const Prepared& p, std::size_t surface, const AccuracySetting& s) {
  if (!is_mesh(p, surface))
    return p.surfaces[surface]->triangles(s.edge_factor * mesh_unit(p), joint_centre(p.model), 0);
  Mesh mesh =
      p.notes[surface].blend ? p.notes[surface].blend->mesh() : p.surfaces[surface]->triangles(1, Vec3::Zero(), 1);
  return s.edge_factor > 1 ? coarsened(mesh, s.edge_factor) : mesh;
}

std::optional<Prepared> with_setting(const Prepared& p, const AccuracySetting& setting) {
  Prepared out;
  out.scene = p.scene;
  change_layers(setting, out.scene);
  if (setting.tolerance > 0) out.scene.solver.tolerance = setting.tolerance;
  if (setting.modulus > 0) make_layers(p, setting.modulus, out.scene);
  out.notes = p.notes;
  out.bones = p.bones;
  out.surfaces = p.surfaces;
  for (std::size_t i = 0; changes_surfaces(setting) && i < p.surfaces.size(); ++i) {
    if (!changes_mesh(p, i, setting) && p.notes[i].blend == nullptr) continue;
    auto made = rebuilt(p, i, setting);
    if (made && is_mesh(p, i)) made = within_patch(made, p.scene.surfaces[i]);
    if (!made) return std::nullopt;
    out.surfaces[i] = std::move(made);
  }
  Diagnostics unused;
  auto model = build_model(out.scene, out.surfaces, unused, out.bones);
  if (!model || unused.has_errors()) return std::nullopt;
  out.model = std::move(*model);
  out.model.meter = std::make_shared<EffectMeter>();
  out.steps = p.steps;
  if (setting.increments > 0)
    for (StepPlan& step : out.steps)
      step.increments = std::max(1, static_cast<int>(std::lround(step.increments * setting.increments)));
  return out;
}

}  // namespace genu
