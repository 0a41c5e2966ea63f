#include "genu/assemble/prepare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "genu/assemble/build_surface.h"
#include "genu/assemble/changed_scene.h"
#include "genu/assemble/facing.h"
#include "genu/assemble/mesh_diagnostics.h"
#include "genu/assemble/mesh_surface.h"
#include "genu/assemble/read_bones.h"
#include "genu/assemble/read_solids.h"
#include "genu/assemble/tolerances.h"
#include "genu/assemble/unlikely_lengths.h"
#include "genu/core/timer.h"
#include "genu/core/units.h"
#include "genu/mesh/tolerances.h"
#include "genu/model/build_model.h"
#include "genu/model/contact_field.h"
#include "genu/scene/centre_bodies.h"
#include "genu/surface/blend_surface.h"

namespace genu {
namespace {

/// m: what lies across a closed form at its thinnest; +infinity where it is a socket, has no back, or is a mesh.
double thickness_of(const SurfaceDef& def) {
  switch (def.inside ? SurfaceDef::Shape::plane : def.shape) {
    case SurfaceDef::Shape::sphere:
    case SurfaceDef::Shape::cylinder:
      return 2 * def.radius;
    case SurfaceDef::Shape::ellipsoid:
      return 2 * def.radii.minCoeff();
    case SurfaceDef::Shape::torus:
      return 2 * def.minor_radius;
    default:
      return std::numeric_limits<double>::infinity();
  }
}

/// What crosses a body between the places where it is looked at goes unseen.
void warn_thin(const Prepared& p, Diagnostics& out) {
  const double spacing = sample_spacing(p.model);
  std::set<int> told;
  for (const ContactDef& c : p.scene.contacts)
    for (const int k : {c.surface_a, c.surface_b}) {
      const SurfaceDef& def = p.scene.surfaces[at(k)];
      const double thick = thickness_of(def);
      if (thick >= spacing || !told.insert(k).second) continue;
      out.add(warning_at({p.scene.file, def.where}, Code::no_surface, "surface." + def.name, {},
                         fmt::format("is {:.3g} mm thick, and surfaces are looked at every {:.3g} mm: that nothing "
                                     "crosses it is not certain",
                                     to::kMillimetre * thick, to::kMillimetre * spacing)));
    }
}

/// Errors of a stage that does not know the scene get the place in the scene that named the file.
void add_at(const PlacedScene& scene, const SurfaceDef& def, const Diagnostics& found, Diagnostics& out) {
  Diagnostics of_file;
  for (Diagnostic d : found.items()) {
    if (d.key != def.file.text() + ".fit_radius") {
      of_file.add(d);
      continue;
    }
    d.file = scene.file;
    d.line = def.fit_radius_where.line;
    d.column = def.fit_radius_where.column;
    d.key = "surface." + def.name + ".fit_radius";
    out.add(d);
  }
  add_at_key(scene, "surface." + def.name + ".file", def.file, of_file, out);
}

/// Whether nothing but the triangles of a surface is asked for: then it is not made smooth.
bool triangles_alone(const PlacedScene& scene, std::size_t surface) {
  const auto uses = [&](const ContactDef& c) {
    return c.surface_a == static_cast<int>(surface) || c.surface_b == static_cast<int>(surface);
  };
  const auto wraps = [&](const auto& defs) {
    return std::any_of(defs.begin(), defs.end(), [&](const auto& def) {
      return std::any_of(def.wraps.begin(), def.wraps.end(),
                         [&](const WrapDef& w) { return w.surface == static_cast<int>(surface); });
    });
  };
  return !wraps(scene.ligaments) && !wraps(scene.loads) &&
         std::none_of(scene.contacts.begin(), scene.contacts.end(), uses) &&
         std::none_of(
             scene.layers.begin(), scene.layers.end(),
             [&](const LayerDef& l) { return l.quadrature == LayerDef::Quadrature::smooth && uses(l.pair); }) &&
         std::any_of(scene.layers.begin(), scene.layers.end(), [&](const LayerDef& l) { return uses(l.pair); });
}

std::shared_ptr<const Surface> build_mesh_surface(const PlacedScene& scene, std::size_t k, MeshLibrary& meshes,
                                                  SurfaceNote& note, double& read_seconds, Diagnostics& out) {
  MeshSurface built = mesh_surface(scene.surfaces[k], triangles_alone(scene, k), meshes, read_seconds);
  add_at(scene, scene.surfaces[k], built.found, out);
  note.text = std::move(built.text);
  note.space = std::move(built.space);
  note.mesh = built.report;
  note.steps = built.steps;
  note.blend = built.blend;
  if (built.facets) return built.facets;
  return built.blend;
}

/// What is left of a surface within its patch has to be something, and what polynomials become there no larger than a
/// joint.
void check_patch(const PlacedScene& scene, const SurfaceDef& def, const Surface* part, Diagnostics& out) {
  std::string rule = "holds no part of the surface: its ranges are in the surface's own frame";
  if (part != nullptr) {
    if (def.terms.empty()) return;
    const double size = box_diagonal(*part, kPatchProbeEdge);
    if (size <= kMaxDiagonal) return;
    rule = fmt::format(
        "holds a surface of {:.3g} m, at most {:g} m make a joint: check its ranges and the terms, which "
        "are in the file's units",
        size, kMaxDiagonal);
  }
  out.add(error_at({scene.file, def.patch->where}, Code::no_surface, "surface." + def.name + ".patch", {}, rule));
}

}  // namespace

std::vector<std::shared_ptr<const Surface>> build_surfaces(const PlacedScene& scene, MeshLibrary& meshes,
                                                           std::vector<SurfaceNote>& notes,
                                                           std::vector<std::pair<std::string, double>>& seconds,
                                                           Diagnostics& out) {
  std::vector<std::shared_ptr<const Surface>> surfaces;
  double read = 0;
  const Timer timer;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const SurfaceDef& def = scene.surfaces[i];
    SurfaceNote note{def.name, "closed form", std::nullopt, nullptr, {}, {}};
    if (def.shape == SurfaceDef::Shape::mesh)
      surfaces.push_back(build_mesh_surface(scene, i, meshes, note, read, out));
    else
      surfaces.push_back(make_analytic_surface(def));
    if (!surfaces.back() && def.shape != SurfaceDef::Shape::mesh)
      out.add(error_at({scene.file, def.where}, Code::no_surface, "surface." + def.name, {},
                       "has sizes that make no surface"));
    if (surfaces.back() && def.patch) {
      note.text += "; limited to a patch";
      surfaces.back() = within_patch(surfaces.back(), def);
      check_patch(scene, def, surfaces.back().get(), out);
    }
    notes.push_back(std::move(note));
  }
  seconds.emplace_back("reading meshes", read);
  seconds.emplace_back("building surfaces", timer.seconds() - read);
  return surfaces;
}

namespace {

/// Two planes touch over an area or not at all: no point of contact can stand for that. A layer between them is sound
/// as long as that area has an end.
void refuse_flat_pairs(const Prepared& p, Diagnostics& out) {
  const auto flat = [&](int surface) {
    return p.scene.surfaces[static_cast<std::size_t>(surface)].shape == SurfaceDef::Shape::plane;
  };
  const auto endless = [&](int surface) {
    const auto& built = p.surfaces[static_cast<std::size_t>(surface)];
    return flat(surface) && built && built->is_unbounded();
  };
  const auto refuse = [&](const ContactDef& c, const char* rule) {
    out.add(error_at({p.scene.file, c.where}, Code::no_surface, "contact." + c.name + ".surfaces", {}, rule));
  };
  for (const ContactDef& c : p.scene.contacts)
    if (flat(c.surface_a) && flat(c.surface_b))
      refuse(c, "two planes never touch at a point: give one of them a curved surface, however slightly");
  for (const LayerDef& layer : p.scene.layers)
    if (endless(layer.pair.surface_a) && endless(layer.pair.surface_b))
      refuse(layer.pair,
             "two planes without end press over an area without end: limit one of them by a `patch` with x "
             "and y");
}

/// Two files that name two frames, and a scene that turns neither: one of the bones stands back to front.
void warn_spaces(const Prepared& p, Diagnostics& out) {
  const auto look = [&](const ContactDef& c) {
    const SurfaceDef &a = p.scene.surfaces[at(c.surface_a)], &b = p.scene.surfaces[at(c.surface_b)];
    const std::string &of_a = p.notes[at(c.surface_a)].space, &of_b = p.notes[at(c.surface_b)].space;
    if (of_a.empty() || of_b.empty() || of_a == of_b || a.placement.R != b.placement.R) return;
    out.add(warning_at({p.scene.file, c.where}, Code::layout, "contact." + c.name + ".surfaces", {},
                       fmt::format("are in two frames by their files' own headers: {} says SPACE={}, {} SPACE={}; "
                                   "export both in one frame",
                                   a.file.text(), of_a, b.file.text(), of_b)));
  };
  for (const ContactDef& c : p.scene.contacts) look(c);
  for (const LayerDef& layer : p.scene.layers) look(layer.pair);
}

/// Sheets do not tell their outward sides: whether those of a contact can touch is seen at the start alone.
void warn_facing(Prepared& p, Diagnostics& out) {
  std::vector<bool> open;
  for (const SurfaceNote& note : p.notes) open.push_back(note.mesh && note.mesh->boundary_loops > 0);
  p.facing = facing_problems(p.scene, p.model, open);
  for (const std::string& sentence : p.facing) out.warning(Code::layout, p.scene.file, sentence);
}

/// m: across the largest mesh; 0 where there is none.
double size_of_meshes(const std::vector<SurfaceNote>& notes) {
  double size = 0;
  for (const SurfaceNote& note : notes)
    if (note.mesh) size = std::max(size, note.mesh->box.diagonal());
  return size;
}

/// What cannot be read is an error when the surface is built.
std::optional<Vec3> middle_of_mesh(MeshLibrary& meshes, const SurfaceDef& def) {
  Diagnostics ignored;
  const auto mesh = meshes.read(def.file, def.file_unit, ignored);
  if (!mesh) return std::nullopt;
  const BoundingBox box = bounding_box(*mesh);
  return 0.5 * (box.low + box.high);
}

}  // namespace

std::optional<Prepared> prepare(const SceneSource& source, Diagnostics& out) {
  const Timer timer;
  auto meshes = std::make_shared<MeshLibrary>();
  auto scene = read_changed_scene(source, meshes->files(), out);
  if (!scene) return std::nullopt;
  const double reading = timer.seconds();
  auto prepared = prepare(std::move(*scene), std::move(meshes), out);
  if (prepared) prepared->seconds.front().second += reading;
  return prepared;
}

std::optional<Prepared> prepare(Scene scene, std::shared_ptr<MeshLibrary> meshes, Diagnostics& out) {
  Prepared p;
  const Timer timer;
  p.source = std::move(scene);
  p.meshes = std::move(meshes);
  const auto origins = choose_origins(p.source, [&](const SurfaceDef& def) { return middle_of_mesh(*p.meshes, def); });
  p.scene = place(p.source, origins);
  p.seconds.emplace_back("reading scene", timer.seconds());
  p.surfaces = build_surfaces(p.scene, *p.meshes, p.notes, p.seconds, out);
  refuse_flat_pairs(p, out);
  p.bones = read_bones(p.scene, *p.meshes, out);
  p.bodies = read_solids(p.source, *p.meshes, out);
  p.scene = place(p.source, origins);
  if (out.has_errors()) return std::nullopt;
  const Timer building;
  auto model = build_model(p.scene, p.surfaces, out, p.bones);
  if (!model || out.has_errors()) return std::nullopt;
  p.model = std::move(*model);
  warn_unlikely_lengths(p.scene, p.model.reference_poses, size_of_meshes(p.notes), out);
  warn_thin(p, out);
  warn_facing(p, out);
  warn_spaces(p, out);
  p.model.meter = std::make_shared<EffectMeter>();
  p.steps = plan_steps(p.scene);
  p.seconds.emplace_back("building model", building.seconds());
  return p;
}

RunSummary begin_summary(const Prepared& prepared) {
  RunSummary s;
  s.scene_file = prepared.scene.file;
  s.title = prepared.scene.title;
  s.changed = prepared.scene.changed;
  s.version = GENU_VERSION;
  s.rigid_pairs = static_cast<int>(prepared.scene.contacts.size());
  s.length_scale = prepared.model.scales.length;
  s.force_scale = prepared.model.scales.force;
  s.seconds = prepared.seconds;
  for (const SurfaceNote& note : prepared.notes) s.surfaces.push_back({note.name, note.text});
  s.bodies = prepared.bodies;
  return s;
}

}  // namespace genu
