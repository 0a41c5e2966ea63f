#include "genu/mesh_care/mesh_repair.h"

#ifdef GENU_WITH_CGAL
#include <algorithm>
#include <set>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/vertex_fans.h"
#include "genu/mesh_care/mesh_flaws.h"
#include "genu/mesh_care/mesh_shape.h"
#include "genu/mesh_care/tolerances.h"

namespace genu {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Halfedge = SurfaceMesh::Halfedge_index;
using Edge = std::pair<std::size_t, std::size_t>;

/// The free edges that belong to borders, which stay open.
std::set<Edge> border_edges(const Mesh& mesh) {
  std::set<Edge> edges;
  for (const FreeLoop& loop : free_loops(mesh)) {
    if (!loop.border) continue;
    for (std::size_t k = 0; k < loop.vertices.size(); ++k)
      edges.emplace(at(loop.vertices[k]), at(loop.vertices[(k + 1) % loop.vertices.size()]));
  }
  return edges;
}

bool to_surface_mesh(const Mesh& mesh, SurfaceMesh& out) {
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  for (const Vec3& v : mesh.vertices) points.emplace_back(v.x(), v.y(), v.z());
  for (const auto& t : mesh.triangles) polygons.emplace_back(t.begin(), t.end());
  if (!pmp::is_polygon_soup_a_polygon_mesh(polygons)) return false;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, out);
  return true;
}

Mesh from_surface_mesh(const SurfaceMesh& surface) {
  Mesh mesh;
  std::vector<int> number(surface.num_vertices() + surface.number_of_removed_vertices(), -1);
  for (const auto v : surface.vertices()) {
    if (surface.is_isolated(v)) continue;
    number[v.idx()] = static_cast<int>(mesh.vertices.size());
    const Kernel::Point_3& p = surface.point(v);
    mesh.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : surface.faces()) {
    auto& t = mesh.triangles.emplace_back();
    std::size_t k = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) t[k++] = number[v.idx()];
  }
  return mesh;
}

/// One halfedge of every loop that is no border. The soup's numbers of vertices are the surface's own.
std::vector<Halfedge> holes_of(const SurfaceMesh& surface, const std::set<Edge>& borders) {
  std::vector<Halfedge> holes;
  std::set<Halfedge> seen;
  for (const Halfedge h : surface.halfedges()) {
    if (!surface.is_border(h) || seen.count(h) > 0) continue;
    bool border = false;
    for (Halfedge g = h; seen.insert(g).second; g = surface.next(g)) {
      const std::size_t from = surface.source(g).idx(), to = surface.target(g).idx();
      border = border || borders.count({to, from}) > 0 || borders.count({from, to}) > 0;
    }
    if (!border) holes.push_back(h);
  }
  return holes;
}

void fill(SurfaceMesh& surface, const std::vector<Halfedge>& holes, RepairReport& report) {
  // Triangulating takes the cube of the edges at worst: a loop longer than this is no hole that a guess could fill.
  for (const Halfedge hole : holes) {
    const auto loop = CGAL::halfedges_around_face(hole, surface);
    if (static_cast<std::size_t>(std::distance(loop.begin(), loop.end())) > kMaxFilledEdges) {
      ++report.left_open;
      continue;
    }
    std::vector<SurfaceMesh::Face_index> faces;
    std::vector<SurfaceMesh::Vertex_index> vertices;
    pmp::triangulate_refine_and_fair_hole(surface, hole, std::back_inserter(faces), std::back_inserter(vertices));
    report.new_triangles += faces.size();
    ++(faces.empty() ? report.left_open : report.filled);
  }
}

std::size_t turn_single_piece_outward(Mesh& mesh) {
  const Orientation orientation = orientation_of(mesh);
  if (orientation.closed_pieces != 1 || orientation.inside_out != 1 || orientation.open_area > 0) return 0;
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh.triangles.size();
}

}  // namespace

bool built_with_cgal() { return true; }

RepairReport repair_mesh(Mesh& mesh) {
  RepairReport report;
  Mesh work = mesh;
  report.turned = make_winding_consistent(work, mesh_edges(work)).flipped;
  // A filling may run into what is round it: then both are taken out, and the larger hole is filled.
  for (int round = 0; round < kMaxFillRounds; ++round) {
    const std::size_t before = work.triangles.size();
    const std::set<Edge> borders = border_edges(work);
    cut_out_flaws(work);
    drop_small_fans(work);
    report.removed += before - work.triangles.size();
    if (work.empty()) {
      report.problem = "nothing is left of it without what is wrong";
      return report;
    }
    SurfaceMesh surface;
    if (!to_surface_mesh(work, surface)) {
      report.problem = "is no surface even without what is wrong";
      return report;
    }
    const std::vector<Halfedge> holes = holes_of(surface, borders);
    report.left_open = 0;
    fill(surface, holes, report);
    work = from_surface_mesh(surface);
    if (holes.empty()) break;
  }
  report.turned += turn_odd_pieces(work) + turn_single_piece_outward(work);
  mesh = std::move(work);
  return report;
}

}  // namespace genu

#else  // GENU_WITH_CGAL

namespace genu {

bool built_with_cgal() { return false; }

RepairReport repair_mesh(Mesh&) {
  return {.problem = "cannot be mended: this genu was built without CGAL (GENU_WITH_CGAL=OFF)"};
}

}  // namespace genu

#endif  // GENU_WITH_CGAL
