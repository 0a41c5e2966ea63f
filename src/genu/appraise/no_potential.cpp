#include "genu/appraise/no_potential.h"

#include <algorithm>

#include <fmt/format.h>

namespace genu {
namespace {

constexpr std::size_t kLayersNamed = 3;  // in a sentence

std::string reason(const PlacedScene& scene, const LoadDef& load) {
  const bool wrench = load.kind == LoadDef::Kind::wrench;
  if (wrench && load.frame == LoadDef::Frame::body) return "it turns with " + scene.bodies[at(load.body)].name;
  if (wrench && load.moment.norm() > 0) return "a moment that is constant in the world";
  const bool own = load.kind == LoadDef::Kind::coordinate && load.scale && load.scale->coordinate == load.coordinate;
  if (load.scale && load.scale->kind == ScaleDef::Kind::over_coordinate && !own)
    return "it is scaled over a coordinate";
  return {};
}

/// "medial", "medial, lateral and 40 more".
std::string layers_of_triangles(const PlacedScene& scene) {
  std::string out;
  std::size_t count = 0;
  for (const LayerDef& layer : scene.layers)
    if (layer.quadrature == LayerDef::Quadrature::triangles && ++count <= kLayersNamed)
      out += (out.empty() ? "" : ", ") + layer.pair.name;
  return count <= kLayersNamed ? out : fmt::format("{} and {} more", out, count - kLayersNamed);
}

}  // namespace

std::vector<std::string> without_potential(const PlacedScene& scene) {
  std::vector<std::string> out;
  for (const LoadDef& load : scene.loads)
    if (const std::string why = reason(scene, load); !why.empty())
      out.push_back("load " + load.name + " (" + why + ")");
  if (const std::string layers = layers_of_triangles(scene); !layers.empty())
    out.push_back("the triangles of cartilage " + layers + " (their stiffness is symmetric only up to the size of a " +
                  "triangle; quadrature = \"smooth\" has a potential)");
  return out;
}

}  // namespace genu
