#include "genu/new_scene/bone_view.h"

#include <algorithm>
#include <cmath>

#include "genu/mesh/mesh_topology.h"
#include "genu/new_scene/tolerances.h"

namespace genu {
namespace {

/// Light from above, to the left of the viewer, and some from the viewer; both sides of a sheet are lit alike.
double light_on(const Vec3& normal, const ViewAxes& axes) {
  const Vec3 lamp = (-0.4 * axes.right + 0.55 * axes.up + 0.75 * axes.toward).normalized();
  const double facing = normal.dot(axes.toward), sign = facing < 0 ? -1 : 1;
  return std::clamp(0.22 + 0.5 * std::max(0.0, sign * normal.dot(lamp)) + 0.28 * sign * facing, 0.0, 1.0);
}

struct Corner {
  double x, y, height, light;  ///< pixels to the right and down; m; 0 .. 1
};

void draw_triangle(const std::array<Corner, 3>& c, std::int16_t mesh, BoneView& view) {
  const double area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
  if (area == 0) return;
  const auto [x0, x1] = std::minmax({c[0].x, c[1].x, c[2].x});
  const auto [y0, y1] = std::minmax({c[0].y, c[1].y, c[2].y});
  const int left = std::max(0, static_cast<int>(std::ceil(std::max(x0 - 0.5, -1.0)))),
            top = std::max(0, static_cast<int>(std::ceil(std::max(y0 - 0.5, -1.0))));
  for (int y = top; y < view.height && y + 0.5 <= y1; ++y)
    for (int x = left; x < view.width && x + 0.5 <= x1; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double w1 = ((px - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (py - c[0].y)) / area;
      const double w2 = ((c[1].x - c[0].x) * (py - c[0].y) - (px - c[0].x) * (c[1].y - c[0].y)) / area;
      const double w0 = 1 - w1 - w2;
      if (w0 < 0 || w1 < 0 || w2 < 0) continue;
      const std::size_t i = at(y) * at(view.width) + at(x);
      const auto height = static_cast<float>(w0 * c[0].height + w1 * c[1].height + w2 * c[2].height);
      if (height <= view.near[i]) continue;
      view.near[i] = height;
      view.light[i] = static_cast<float>(w0 * c[0].light + w1 * c[1].light + w2 * c[2].light);
      view.mesh[i] = mesh;
    }
}

/// Darker where something nearer, or nothing, is beside a pixel: outlines.
void draw_edges(BoneView& view) {
  std::vector<float> light = view.light;
  const int w = view.width;
  for (int y = 1; y + 1 < view.height; ++y)
    for (int x = 1; x + 1 < w; ++x) {
      const int i = y * w + x;
      if (view.mesh[at(i)] < 0) continue;
      double deepest = 0;
      for (const int k : {i - 1, i + 1, i - w, i + w})
        deepest = std::max(deepest, static_cast<double>(view.near[at(i)]) - static_cast<double>(view.near[at(k)]));
      if (deepest > kEdgeDrop) light[at(i)] *= 0.45F;
    }
  view.light = std::move(light);
}

}  // namespace

bool BoneView::shows(const ViewAxes& axes, const Vec3& p, double by) const {
  const Vec2 flat = axes.flat(p);
  const double x = (flat.x() - corner.x()) / pixel, y = (corner.y() - flat.y()) / pixel;
  if (!(x >= 0 && y >= 0 && x < width && y < height)) return true;
  const std::size_t i = static_cast<std::size_t>(y) * at(width) + static_cast<std::size_t>(x);
  return axes.toward.dot(p) + by >= static_cast<double>(near[i]);
}

BoneView view_of(std::span<const Mesh* const> meshes, const ViewAxes& axes, const Vec2& low, const Vec2& high,
                 double pixel) {
  BoneView view;
  view.width = std::max(1, static_cast<int>(std::ceil((high.x() - low.x()) / pixel)));
  view.height = std::max(1, static_cast<int>(std::ceil((high.y() - low.y()) / pixel)));
  view.pixel = pixel;
  view.corner = {low.x(), high.y()};
  const std::size_t size = at(view.width) * at(view.height);
  view.mesh.assign(size, -1);
  view.light.assign(size, 1);
  view.near.assign(size, -std::numeric_limits<float>::infinity());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const std::vector<Vec3> normals = vertex_normals(*meshes[m]);
    std::vector<Corner> corners;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const Vec3& p = meshes[m]->vertices[i];
      const Vec2 flat = axes.flat(p);
      corners.push_back({(flat.x() - view.corner.x()) / pixel, (view.corner.y() - flat.y()) / pixel, axes.toward.dot(p),
                         light_on(normals[i], axes)});
    }
    for (const auto& t : meshes[m]->triangles)
      draw_triangle({corners[at(t[0])], corners[at(t[1])], corners[at(t[2])]}, static_cast<std::int16_t>(m), view);
  }
  draw_edges(view);
  return view;
}

}  // namespace genu
