#include "genu/appraise/no_potential.h"

namespace genu {
namespace {

std::string reason(const PlacedScene& scene, const LoadDef& load) {
  const bool wrench = load.kind == LoadDef::Kind::wrench;
  if (wrench && load.frame == LoadDef::Frame::body) return "it turns with " + scene.bodies[at(load.body)].name;
  if (wrench && load.moment.norm() > 0) return "a moment that is constant in the world";
  const bool own = load.kind == LoadDef::Kind::coordinate && load.scale && load.scale->coordinate == load.coordinate;
  if (load.scale && load.scale->kind == ScaleDef::Kind::over_coordinate && !own)
    return "it is scaled over a coordinate";
  return {};
}

}  // namespace

std::vector<std::string> without_potential(const PlacedScene& scene) {
  std::vector<std::string> out;
  for (const LoadDef& load : scene.loads)
    if (const std::string why = reason(scene, load); !why.empty())
      out.push_back("load " + load.name + " (" + why + ")");
  for (const LayerDef& layer : scene.layers)
    if (layer.quadrature == LayerDef::Quadrature::triangles)
      out.push_back("the triangles of cartilage " + layer.pair.name + " (their stiffness is symmetric only up to the " +
                    "size of a triangle; quadrature = \"smooth\" has a potential)");
  return out;
}

}  // namespace genu
