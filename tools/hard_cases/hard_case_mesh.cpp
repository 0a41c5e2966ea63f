#include "hard_cases/hard_case_mesh.h"

#include <algorithm>

#include "genu/assemble/build_solid.h"
#include "genu/assemble/build_surface.h"
#include "genu/core/atomic_output.h"
#include "genu/mesh_files/mesh_writer.h"
#include "genu/shape_fit/solid_mesh.h"

namespace genu {
namespace {

constexpr double kShapeReach = 0.05;  // m: of shapes without ends

/// What is asked for by name; null, or an error in `why`.
struct RecipeShape {
  std::shared_ptr<const Surface> surface;  ///< null for solids
  Mesh mesh;
};

RecipeShape cut_shape(const MeshRecipe& recipe, const Scene& shapes, std::string& why) {
  for (const SurfaceDef& def : shapes.surfaces) {
    if (def.name != recipe.shape) continue;
    RecipeShape out{within_patch(make_analytic_surface(def), def), {}};
    if (out.surface)
      out.mesh = out.surface->triangles(recipe.edge, def.placement.p, kShapeReach);
    else
      why = recipe.shape + " makes no surface";
    return out;
  }
  for (const SolidDef& def : shapes.solids)
    if (def.name == recipe.shape) return {nullptr, solid_mesh(make_solid(def), recipe.edge, why)};
  why = "there is no shape \"" + recipe.shape + "\" in shapes.toml";
  return {};
}

void spoil(const MeshRecipe::Damage& damage, const Surface* surface, Mesh& mesh) {
  if (is_local(damage.kind)) {
    mesh = damaged_near(std::move(mesh), damage.kind, damage.near, damage.size);
    return;
  }
  mesh = damaged(std::move(mesh), damage.kind, damage.size, damage.shift);
  if (damage.kind != MeshDamage::subdivide || surface == nullptr) return;
  SurfacePoint foot;
  for (Vec3& v : mesh.vertices)
    if (surface->project(v, foot)) v = foot.p;
}

}  // namespace

std::string write_recipe(const MeshRecipe& recipe, const Scene& shapes, const std::string& folder) {
  const std::string path = folder + "/" + recipe.file;
  if (!recipe.text.empty()) return write_file_atomically(path, recipe.text);
  std::string why;
  RecipeShape shape = cut_shape(recipe, shapes, why);
  if (!why.empty()) return recipe.file + ": " + why;
  for (const MeshRecipe::Damage& damage : recipe.damage) spoil(damage, shape.surface.get(), shape.mesh);
  return write_mesh(shape.mesh, path, recipe.unit, "a hard case");
}

}  // namespace genu
