#include "genu/mesh/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "genu/surface/tessellate.h"

namespace genu {
namespace {

// A flat n x m sheet with normal +z.
Mesh sheet(int n, int m) {
  return grid_mesh({n, false}, {m, false}, [](double s, double t) { return Vec3(s, t, 0); });
}

Mesh ring(int n, int m) {
  return grid_mesh({n, true}, {m, false}, [](double s, double t) {
    const double phi = 2 * std::numbers::pi * s;
    return Vec3(std::cos(phi), std::sin(phi), t);
  });
}

TEST(MeshTopology, EdgesAgainstASetOfPairs) {
  const Mesh mesh = geodesic_mesh({3, 2, 1}, 0.3);
  std::set<std::array<int, 2>> pairs;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) pairs.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  }
  const auto edges = mesh_edges(mesh);
  ASSERT_EQ(edges.size(), pairs.size());
  std::size_t k = 0;
  for (const auto& pair : pairs) {
    EXPECT_EQ(edges[k].v, pair);
    EXPECT_EQ(edges[k].count, 2);
    EXPECT_LT(edges[k].t[0], edges[k].t[1]);
    ++k;
  }
  EXPECT_EQ(mesh.vertices.size() + mesh.triangles.size() - edges.size(), 2u);  // Euler, a closed surface
}

TEST(MeshTopology, NeighboursAreSymmetricAscendingAndComplete) {
  const Mesh mesh = sheet(5, 4);
  const auto edges = mesh_edges(mesh);
  const auto n = vertex_neighbours(mesh, edges);
  ASSERT_EQ(n.neighbours.size(), 2 * edges.size());
  std::set<std::array<int, 2>> found;
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
    const auto from = static_cast<std::size_t>(v);
    for (int k = n.offset[from]; k < n.offset[from + 1]; ++k) {
      const int w = n.neighbours[static_cast<std::size_t>(k)];
      if (k > n.offset[from]) {
        EXPECT_LT(n.neighbours[static_cast<std::size_t>(k - 1)], w);
      }
      found.insert({v, w});
    }
  }
  for (const auto& e : edges) {
    EXPECT_TRUE(found.contains({e.v[0], e.v[1]}));
    EXPECT_TRUE(found.contains({e.v[1], e.v[0]}));
  }
}

TEST(MeshTopology, BoundaryLoopsOfASheetARingAndAClosedSurface) {
  const Mesh flat = sheet(5, 4);
  const auto loops = boundary_loops(flat, mesh_edges(flat));
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].size(), 18u);
  double area = 0;  // walked with the surface on the left: counter-clockwise
  for (std::size_t k = 0; k < loops[0].size(); ++k) {
    const Vec3 &p = flat.vertices[static_cast<std::size_t>(loops[0][k])],
               &q = flat.vertices[static_cast<std::size_t>(loops[0][(k + 1) % loops[0].size()])];
    area += 0.5 * (p.x() * q.y() - p.y() * q.x());
  }
  EXPECT_NEAR(area, 1, 1e-14);
  const auto on = boundary_vertices(flat, mesh_edges(flat));
  EXPECT_EQ(std::count(on.begin(), on.end(), true), 18);

  const Mesh tube = ring(8, 3);
  EXPECT_EQ(boundary_loops(tube, mesh_edges(tube)).size(), 2u);
  const Mesh closed = geodesic_mesh({1, 1, 1}, 0.5);
  EXPECT_TRUE(boundary_loops(closed, mesh_edges(closed)).empty());
}

TEST(MeshTopology, ComponentsOfTwoSheetsThatShareAVertexOnly) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(connected_components(mesh).of_triangle, (std::vector<int>{0, 1}));
  mesh.triangles.push_back({0, 2, 3});  // shares the edge 0-2 with the first, 0-3 with the second: a bridge
  EXPECT_EQ(connected_components(mesh).of_triangle, (std::vector<int>{0, 0, 0}));
}

TEST(MeshTopology, AComponentReachesAcrossANonManifoldEdge) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  EXPECT_EQ(connected_components(mesh).count, 1);
  EXPECT_EQ(mesh_edges(mesh).front().count, 3);
}

TEST(MeshTopology, WindingFollowsTheMajorityOfEachComponent) {
  Mesh mesh = geodesic_mesh({3, 2, 1}, 0.3);
  const Mesh right = mesh;
  std::mt19937 random(7);
  std::size_t turned = 0;
  for (auto& t : mesh.triangles) {
    if (random() % 3 != 0) continue;
    std::swap(t[1], t[2]);
    ++turned;
  }
  const auto report = make_winding_consistent(mesh, mesh_edges(mesh));
  EXPECT_EQ(report.flipped, turned);
  EXPECT_TRUE(report.orientable);
  EXPECT_EQ(mesh.triangles, right.triangles);
}

TEST(MeshTopology, AMoebiusStripIsNotOrientable) {
  Mesh mesh;
  const int n = 12;
  for (int k = 0; k < n; ++k) {
    const double phi = 2 * std::numbers::pi * k / n;
    for (const double w : {-0.3, 0.3}) {
      const double r = 1 + w * std::cos(phi / 2);
      mesh.vertices.emplace_back(r * std::cos(phi), r * std::sin(phi), w * std::sin(phi / 2));
    }
  }
  for (int k = 0; k < n; ++k) {
    const int a = 2 * k, b = a + 1, c = k + 1 < n ? a + 2 : 1, d = k + 1 < n ? a + 3 : 0;
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({b, c, d});
  }
  EXPECT_FALSE(make_winding_consistent(mesh, mesh_edges(mesh)).orientable);
}

TEST(MeshTopology, VertexNormalsOfASphereAreRadial) {
  const Mesh mesh = geodesic_mesh({1, 1, 1}, 0.1);
  const auto normals = vertex_normals(mesh);
  double worst = 0;
  for (std::size_t v = 0; v < normals.size(); ++v) worst = std::max(worst, (normals[v] - mesh.vertices[v]).norm());
  EXPECT_LT(worst, 0.1 * 0.1 / 2);  // second order in the edge, with a constant for triangles of unequal shape
}

TEST(MeshTopology, MedianEdgeAndBox) {
  const Mesh mesh = sheet(10, 10);
  EXPECT_NEAR(median_edge_length(mesh, mesh_edges(mesh)), 0.1, 1e-15);
  EXPECT_NEAR(bounding_box(mesh).diagonal(), std::sqrt(2.0), 1e-15);
  EXPECT_EQ(bounding_box(Mesh{}).diagonal(), 0);
  EXPECT_EQ(median_edge_length(Mesh{}, {}), 0);
}

}  // namespace
}  // namespace genu
