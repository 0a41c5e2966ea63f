#include "genu/mesh_care/mesh_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <Eigen/Geometry>

#include "genu/core/decompositions.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh_care/tolerances.h"
#include "genu/surface/creases.h"
#include "genu/surface/fit_choice.h"
#include "genu/surface/local_fit.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

double sorted_quantile(const std::vector<double>& sorted, double q) {
  return sorted[static_cast<std::size_t>(std::lround(q * static_cast<double>(sorted.size() - 1)))];
}

/// The two principal curvatures from the tensor that is zero across; positive bulges outward.
std::array<double, 2> principal(const Mat3& tensor) {
  Vec3 values = symmetric_eigen(Mat3(-0.5 * (tensor + tensor.transpose()))).values;
  std::sort(values.data(), values.data() + 3, [](double a, double b) { return std::abs(a) < std::abs(b); });
  return {values[1], values[2]};
}

void measure_curvature(const Mesh& mesh, const VertexGraph& graph, int degree, MeshShape& shape) {
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / kMaxShapeFits);
  const std::size_t count = (mesh.vertices.size() + step - 1) / step;
  std::vector<std::array<double, 2>> found(count);
  std::vector<char> valid(count, 0);
  tbb::enumerable_thread_specific<HeightFitter> fitters([&] { return HeightFitter(mesh, graph); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16), [&](const auto& range) {
    HeightFitter& fitter = fitters.local();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const int v = static_cast<int>(i * step);
      if (graph.component[at(v)] < 0) continue;
      FitRequest request{mesh.vertices[at(v)], graph.normals[at(v)], std::span(&v, 1), shape.fit_radius, degree, false};
      HeightFit fit = fitter.fit(request);
      if (fit.degree == 0) continue;
      // As a scene's surface does: narrower where the surface turns out to be sharp.
      const double narrow = kMaxOfCurvature / std::max(fit.curvature(fit.origin).norm(), 1e-300);
      request.radius = std::max(3 * graph.median_edge, narrow);
      if (request.radius < shape.fit_radius)
        if (const HeightFit narrower = fitter.fit(request); narrower.degree > 0) fit = narrower;
      found[i] = principal(fit.curvature(fit.origin));
      valid[i] = 1;
    }
  });
  std::vector<double> both, larger;
  for (std::size_t i = 0; i < count; ++i) {
    if (valid[i] == 0) continue;
    both.insert(both.end(), found[i].begin(), found[i].end());
    larger.push_back(std::abs(found[i][1]));
  }
  shape.fits = static_cast<int>(larger.size());
  if (larger.empty()) return;
  std::sort(both.begin(), both.end());
  std::sort(larger.begin(), larger.end());
  shape.curvature = {sorted_quantile(both, 0.01), sorted_quantile(both, 0.5), sorted_quantile(both, 0.99)};
  shape.sharpest = sorted_quantile(larger, 0.95);
}

/// Distance from p along d to the first triangle that faces along d; infinity without one.
double first_back_face(const Mesh& mesh, const Vec3& p, const Vec3& d, double beyond) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[at(t[0])];
    const Vec3 u = mesh.vertices[at(t[1])] - a, v = mesh.vertices[at(t[2])] - a, q = d.cross(v);
    const double determinant = u.dot(q);
    // The ray leaves through faces whose normal is along it: u x v . d > 0, which is -u . (d x v).
    if (!(-determinant > 0)) continue;
    const Vec3 s = p - a;
    const double b = s.dot(q) / determinant;
    if (b < 0 || b > 1) continue;
    const Vec3 r = s.cross(u);
    const double c = d.dot(r) / determinant;
    if (c < 0 || b + c > 1) continue;
    const double along = v.dot(r) / determinant;
    if (along > beyond && along < least) least = along;
  }
  return least;
}

void measure_thickness(const Mesh& mesh, const VertexGraph& graph, MeshShape& shape) {
  const double affordable = kThicknessRayTests / static_cast<double>(mesh.triangles.size());
  const std::size_t rays = std::clamp<std::size_t>(static_cast<std::size_t>(affordable), 20, kMaxThicknessRays);
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / rays);
  const std::size_t count = (mesh.vertices.size() + step - 1) / step;
  std::vector<double> found(count, std::numeric_limits<double>::infinity());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const std::size_t v = i * step;
      if (graph.normals[v].isZero()) continue;
      found[i] = first_back_face(mesh, mesh.vertices[v], -graph.normals[v], 1e-6 * graph.median_edge);
    }
  });
  std::erase_if(found, [](double x) { return !std::isfinite(x); });
  shape.thickness_rays = static_cast<int>(found.size());
  if (found.empty()) return;
  std::sort(found.begin(), found.end());
  shape.thickness = {sorted_quantile(found, 0.05), sorted_quantile(found, 0.5), sorted_quantile(found, 0.95)};
}

struct Pieces {
  Components parts;
  std::vector<char> open;
  std::vector<double> volume;  ///< m^3, of the closed ones
};

Pieces pieces_with_volume(const Mesh& mesh) {
  Pieces out{connected_components(mesh), {}, {}};
  out.open.assign(at(out.parts.count), 0);
  out.volume.assign(at(out.parts.count), 0.0);
  for (const MeshEdge& e : mesh_edges(mesh))
    if (e.count != 2) out.open[at(out.parts.of_triangle[at(e.t[0])])] = 1;
  const Vec3 origin = bounding_box(mesh).low;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const Vec3 a = mesh.vertices[at(t[0])] - origin, b = mesh.vertices[at(t[1])] - origin,
               c = mesh.vertices[at(t[2])] - origin;
    out.volume[at(out.parts.of_triangle[i])] += a.dot(b.cross(c)) / 6;
  }
  return out;
}

}  // namespace

MeshShape shape_of(const Mesh& mesh) {
  MeshShape shape;
  const VertexGraph graph = graph_with_creases(mesh);
  if (!(graph.area > 0 && graph.median_edge > 0)) return shape;
  const FitChoice choice = choose_fit(mesh, graph, std::nullopt, std::nullopt);
  shape.noise = choice.noise.rms;
  shape.steps = graph.steps;
  shape.fit_radius = choice.radius;
  measure_curvature(mesh, graph, choice.degree, shape);
  measure_thickness(mesh, graph, shape);
  return shape;
}

Orientation orientation_of(const Mesh& mesh) {
  const Pieces pieces = pieces_with_volume(mesh);
  Orientation out;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (pieces.open[at(pieces.parts.of_triangle[i])] == 0) continue;
    const auto& t = mesh.triangles[i];
    const Vec3& a = mesh.vertices[at(t[0])];
    const Vec3 area = 0.5 * (mesh.vertices[at(t[1])] - a).cross(mesh.vertices[at(t[2])] - a);
    out.facing += area;
    out.open_area += area.norm();
  }
  for (std::size_t k = 0; k < pieces.volume.size(); ++k) {
    if (pieces.open[k] != 0) continue;
    ++out.closed_pieces;
    if (pieces.volume[k] < 0) ++out.inside_out;
  }
  if (out.open_area > 0) out.facing /= out.open_area;
  return out;
}

std::size_t turn_odd_pieces(Mesh& mesh) {
  const Orientation orientation = orientation_of(mesh);
  if (orientation.inside_out == 0 || orientation.inside_out == orientation.closed_pieces) return 0;
  const Pieces pieces = pieces_with_volume(mesh);
  std::size_t turned = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::size_t k = at(pieces.parts.of_triangle[i]);
    if (pieces.open[k] != 0 || !(pieces.volume[k] < 0)) continue;
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    ++turned;
  }
  return turned;
}

}  // namespace genu
