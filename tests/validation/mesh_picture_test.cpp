// What a picture of meshes shows.
#include "studies/mesh_picture.h"

#include <cmath>

#include <gtest/gtest.h>

namespace genu::studies {
namespace {

Mesh cube() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.vertices.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

std::size_t paths(const std::string& svg) {
  std::size_t count = 0;
  for (std::size_t at = svg.find("<path"); at != std::string::npos; at = svg.find("<path", at + 1)) ++count;
  return count;
}

TEST(MeshPicture, ShowsWhatFacesTheViewerOncePerView) {
  const Mesh mesh = cube();
  EXPECT_EQ(paths(mesh_picture({{&mesh, {}}}, {PictureView{}}, 100)), 2u) << "one side of a cube";
  const double r = std::sqrt(0.5);
  const PictureView corner{{r, 0, -r}, {0, 1, 0}};
  EXPECT_EQ(paths(mesh_picture({{&mesh, {}}}, {PictureView{}, corner}, 100)), 6u) << "one side, and two";
  EXPECT_EQ(paths(mesh_picture({}, {PictureView{}}, 100)), 0u);
}

TEST(MeshPicture, WhatIsNearerIsDrawnLater) {
  const Mesh mesh = cube();
  const PictureMesh far{&mesh, {}, {1, 0, 0}}, near{&mesh, {Mat3::Identity(), {0, 0, 5}}, {0, 0, 1}};
  const std::string svg = mesh_picture({near, far}, {PictureView{}}, 100);
  EXPECT_LT(svg.find("0000\" stroke"), svg.find("fill=\"#0000"));
  EXPECT_NE(svg.find("fill=\"#0000"), std::string::npos);
}

}  // namespace
}  // namespace genu::studies
