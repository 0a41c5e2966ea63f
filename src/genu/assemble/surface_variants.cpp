#include "genu/assemble/surface_variants.h"

#include <algorithm>

#include "genu/assemble/build_surface.h"
#include "genu/mesh/mesh_coarsen.h"
#include "genu/mesh_care/noise_field.h"
#include "genu/model/build_model.h"
#include "genu/surface/blend_surface.h"

namespace genu {
namespace {

std::shared_ptr<const Surface> vary(const BlendSurface& surface, const SurfaceDef& def, const MeshNoise& noise,
                                    const SurfaceVariant& variant, std::uint64_t surface_number) {
  const BlendFacts& facts = surface.facts();
  BlendOptions options{facts.fit_radius * variant.radius_factor, variant.degree > 0 ? variant.degree : facts.degree};
  Mesh mesh = surface.mesh();
  if (variant.seed > 0) mesh = perturbed(mesh, noise, variant.seed + (surface_number << 32));
  if (variant.edge_factor > 1) {
    mesh = coarsened(mesh, variant.edge_factor);
    options = {def.fit_radius, def.degree};
  }
  const double edge = vertex_graph(mesh).median_edge;
  if (options.fit_radius) options.fit_radius = std::max(*options.fit_radius, edge);
  Diagnostics unused;  // what is wrong with a variant is its own matter: it is left out
  auto varied = BlendSurface::build(std::move(mesh), options, def.name, unused);
  if (varied) varied->set_doubtful({surface.doubtful().begin(), surface.doubtful().end()});
  return varied;
}

}  // namespace

const std::vector<SurfaceVariant>& surface_variants() {
  using enum ErrorCause;
  static const std::vector<SurfaceVariant> all = {
      {fit, "fit radius x 0.8", 3, 0.8},
      {fit, "fit radius x 1.25", 3, 1.25},
      {fit, "degree 2, fit radius x 0.85", 2, 0.85},
      {fit, "degree 4, fit radius x 1.1", 4, 1.1},
      {noise, "noise drawn once", 0, 1, 1},
      {noise, "noise drawn twice", 0, 1, 2},
      {noise, "noise drawn thrice", 0, 1, 3},
      {mesh, "edges x 1.5", 0, 1, 0, 1.5},
  };
  return all;
}

bool has_meshes(const Prepared& prepared) {
  return std::any_of(prepared.notes.begin(), prepared.notes.end(), [](const auto& n) { return n.blend != nullptr; });
}

std::vector<MeshNoise> mesh_noises(const Prepared& prepared) {
  std::vector<MeshNoise> out(prepared.notes.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    if (const auto& blend = prepared.notes[i].blend) out[i] = blend->facts().noise;
  return out;
}

std::optional<Prepared> vary(const Prepared& prepared, const std::vector<MeshNoise>& noises,
                             const SurfaceVariant& variant) {
  Prepared out;
  out.scene = prepared.scene;
  out.steps = prepared.steps;
  out.notes = prepared.notes;
  for (std::size_t i = 0; i < prepared.surfaces.size(); ++i) {
    const SurfaceDef& def = prepared.scene.surfaces[i];
    out.surfaces.push_back(prepared.surfaces[i]);
    if (const auto& blend = prepared.notes[i].blend)
      out.surfaces.back() = within_patch(vary(*blend, def, noises[i], variant, i), def);
    if (!out.surfaces.back()) return std::nullopt;
  }
  Diagnostics unused;
  out.bones = prepared.bones;
  auto model = build_model(out.scene, out.surfaces, unused, out.bones);
  if (!model || unused.has_errors()) return std::nullopt;
  out.model = std::move(*model);
  return out;
}

}  // namespace genu
