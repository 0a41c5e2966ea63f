// Position, normal and curvature of the blend converge with the orders of its degree, on regular and on bad meshes.
//
// GENU_ACCURACY_TABLE=FILE writes the tables there as well (tools/accuracy-table).
#include <array>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "accuracy_table.h"
#include "blend_shapes.h"
#include "genu/surface/blend_surface.h"

namespace genu {
namespace {

using test::KnownShape;
using test::MeshFault;

constexpr double kShortOfOrder = 0.3;
constexpr double kFitRadius = 3.2;  // edges

struct BlendErrors {
  double position = 0, normal = 0, curvature = 0;  ///< m, rad, 1/m, rms
};

/// Where the blend is looked at, in parameters of the shape.
enum class Region { inside, along_the_edge };

BlendErrors measure(const KnownShape& shape, const BlendSurface& surface, double fit_radius, Region region) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> draw(0, 1);
  BlendErrors sum;
  int count = 0;
  while (count < 2000) {
    const double s = draw(random), t = draw(random);
    const Vec3 x = shape.map(s, t);
    const double edge = surface.edge_distance(x);
    const bool at_edge = edge < fit_radius;
    if (!shape.closed && (edge < 0 || at_edge != (region == Region::along_the_edge))) continue;
    SurfacePoint point;
    EXPECT_TRUE(surface.project(x, point));
    const KnownShape::Value v = shape.value(point.p);
    sum.position += std::pow(v.f / v.gradient.norm(), 2);
    sum.normal += (point.n - v.gradient.normalized()).squaredNorm();
    sum.curvature += (point.T * point.S * point.T.transpose() - shape.curvature(point.p)).squaredNorm();
    ++count;
  }
  return {std::sqrt(sum.position / count), std::sqrt(sum.normal / count), std::sqrt(sum.curvature / count)};
}

double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = std::log(x[i]), b = std::log(y[i]);
    sx += a, sy += b, sxx += a * a, sxy += a * b;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// One line of a table: the errors on the finest mesh and the orders over all edges.
std::string study(const std::string& name, const KnownShape& shape, int degree, MeshFault fault, Region region) {
  const std::vector<double> edges{1.4e-3, 1e-3, 0.7e-3, 0.5e-3};
  std::vector<double> position, normal, curvature;
  for (double edge : edges) {
    BlendOptions options;
    options.fit_radius = kFitRadius * edge;
    options.degree = degree;
    Diagnostics diagnostics;
    const auto surface =
        BlendSurface::build(test::irregular_mesh(shape, edge, fault), options, shape.name, diagnostics);
    EXPECT_TRUE(surface && diagnostics.items().empty()) << name;
    if (!surface) return {};
    const BlendErrors e = measure(shape, *surface, *options.fit_radius, region);
    position.push_back(e.position);
    normal.push_back(e.normal);
    curvature.push_back(e.curvature);
  }
  const std::array<double, 3> order{slope(edges, position), slope(edges, normal), slope(edges, curvature)};
  for (int k = 0; k < 3; ++k)
    EXPECT_GE(order[static_cast<std::size_t>(k)], degree + 1 - k - kShortOfOrder)
        << name << ", degree " << degree << ": "
        << std::array{"position", "normal", "curvature"}[static_cast<std::size_t>(k)];
  return fmt::format("| {} | {} | {:.1e} | {:.1e} | {:.1e} | {:.1f} | {:.1f} | {:.1f} |\n", name, degree,
                     1e3 * position.back(), normal.back(), curvature.back(), order[0], order[1], order[2]);
}

const std::string kTableHead =
    "| mesh | degree | position mm | normal rad | curvature 1/m | order: position | normal | curvature |\n"
    "|---|---:|---:|---:|---:|---:|---:|---:|\n";

KnownShape bowl() {
  return test::height_shape("bowl", 12e-3, {{{2, 0}, 20}, {{0, 2}, 30}, {{2, 1}, 400}, {{4, 0}, 2e4}, {{1, 4}, 1e6}});
}
KnownShape saddle() {
  return test::height_shape("saddle", 12e-3,
                            {{{2, 0}, 20}, {{0, 2}, -25}, {{3, 0}, 300}, {{1, 2}, 500}, {{0, 5}, 1e6}});
}

TEST(BlendConvergence, OfShapes) {
  std::string rows;
  for (const KnownShape& shape :
       {test::torus_shape(15e-3, 7e-3), test::ellipsoid_shape({18e-3, 14e-3, 10e-3}), saddle(), bowl()}) {
    for (int degree : {2, 3, 4}) rows += study(shape.name, shape, degree, MeshFault::none, Region::inside);
  }
  test::write_down("The blend of irregular meshes: shaken vertices, diagonals drawn by lot", kTableHead + rows);
}

TEST(BlendConvergence, OfBadMeshes) {
  const KnownShape shape = bowl();
  std::string rows;
  for (int degree : {2, 3, 4})
    rows += study("bowl with slivers 40:1", shape, degree, MeshFault::slivers, Region::inside);
  for (int degree : {2, 3, 4})
    rows += study("bowl with holes of 1.5 edges", shape, degree, MeshFault::holes, Region::inside);
  for (int degree : {2, 3, 4})
    rows += study("bowl, within a fit radius of its edge", shape, degree, MeshFault::none, Region::along_the_edge);
  for (int degree : {2, 3, 4})
    rows += study("bowl 2 mm thin, two faces", shape, degree, MeshFault::two_faces, Region::inside);
  test::write_down("The blend of bad meshes", kTableHead + rows);
}

}  // namespace
}  // namespace genu
