// Meshes as a picture: seen from one side without perspective, flat triangles shaded by a lamp, far ones drawn first.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "genu/core/pose.h"
#include "genu/mesh/mesh.h"

namespace genu::studies {

struct PictureMesh {
  const Mesh* mesh = nullptr;
  Pose pose;                                        ///< in the world
  std::array<double, 3> colour = {0.9, 0.87, 0.8};  ///< red, green, blue: 0 to 1, where the light is full
};

/// Of one view: which way is right and which is up, in the world; the viewer looks along up x right.
struct PictureView {
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY();  ///< unit, perpendicular
};

/// An SVG with one picture a view, side by side and to one scale, each `height` pixels high.
std::string mesh_picture(const std::vector<PictureMesh>& meshes, const std::vector<PictureView>& views, int height);

}  // namespace genu::studies
