#include "genu/surface/blend_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "genu/mesh/mesh_order.h"
#include "genu/surface/creases.h"
#include "genu/surface/fit_choice.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

/// Outward normal, tangents and shape operator where f has this gradient and Hessian.
void set_derivatives(const Vec3& gradient, const Mat3& hessian, SurfacePoint& out) {
  const double slope = gradient.norm();
  out.n = gradient / slope;
  out.T = tangent_basis(out.n);
  out.S.noalias() = -(out.T.transpose() * (hessian * out.T)) / slope;
  out.S(1, 0) = out.S(0, 1) = 0.5 * (out.S(0, 1) + out.S(1, 0));
}

/// What is wrong with the mesh, or an empty text.
std::string fault_of(const Mesh& mesh) {
  const int count = static_cast<int>(mesh.vertices.size());
  if (mesh.empty()) return "the mesh has no triangles";
  for (const Vec3& v : mesh.vertices) {
    if (!v.allFinite()) return "the mesh has a vertex that is not finite";
  }
  for (const auto& t : mesh.triangles) {
    for (int v : t) {
      if (v < 0 || v >= count) return "the mesh has a triangle that names a vertex it does not have";
    }
  }
  return {};
}

/// A radius below an edge would ask for nodes without vertices near them, and for any number of those.
bool check_options(const BlendOptions& options, double median_edge, const std::string& name, Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& key, const std::string& found, const std::string& rule) {
    diagnostics.add(error_at({}, Code::out_of_range, name + key, found, rule));
  };
  const double radius = options.fit_radius.value_or(median_edge);
  const int degree = options.degree.value_or(kMinDegree);
  const bool radius_ok = std::isfinite(radius) && radius >= median_edge;
  const bool degree_ok = degree >= kMinDegree && degree <= kMaxDegree;
  if (!radius_ok) {
    refuse(".fit_radius", fmt::format("{:g} mm", 1e3 * radius),
           fmt::format("must be at least the mesh's median edge, {:.3g} mm", 1e3 * median_edge));
  }
  if (!degree_ok) refuse(".degree", fmt::format("{}", degree), "must be 2, 3 or 4");
  return radius_ok && degree_ok;
}

/// Drops the seeds where no fit was possible: scraps of mesh. Returns their number.
std::size_t drop_failures(std::vector<NodeSeed>& seeds, std::vector<HeightFit>& fits) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (fits[i].degree == 0) continue;
    fits[kept] = fits[i];
    seeds[kept++] = seeds[i];
  }
  const std::size_t dropped = fits.size() - kept;
  fits.resize(kept);
  seeds.resize(kept);
  return dropped;
}

/// Pairs of sheets that a crease parts, and on which side of it the solid is: by where nodes of one lie to the tangent
/// planes of the other.
std::vector<BlendField::Crease> creases_between(const std::vector<int>& sheets, const std::vector<int>& faces,
                                                const std::vector<Vec3>& positions, const std::vector<Vec3>& normals,
                                                const NodeLinks& near) {
  std::map<std::pair<int, int>, double> above;
  for (int i = 0; i < static_cast<int>(positions.size()); ++i)
    for (const int j : near.of(i)) {
      if (sheets[i] == sheets[j] || faces[i] == faces[j] || faces[i] < 0 || faces[j] < 0) continue;
      if (normals[i].dot(normals[j]) < kFacesAway) continue;
      above[std::minmax(sheets[i], sheets[j])] += normals[i].dot(positions[j] - positions[i]);
    }
  std::vector<BlendField::Crease> out;
  for (const auto& [pair, sum] : above) out.push_back({pair.first, pair.second, sum < 0});
  return out;
}

}  // namespace

std::unique_ptr<BlendSurface> BlendSurface::build(Mesh mesh, const BlendOptions& options, const std::string& name,
                                                  Diagnostics& diagnostics) {
  const auto error = [&](const std::string& rule) {
    diagnostics.add(error_at({}, Code::mesh_unusable, name, {}, rule));
    return nullptr;
  };
  if (const std::string fault = fault_of(mesh); !fault.empty()) return error(fault);
  sort_canonically(mesh);
  const VertexGraph graph = graph_with_creases(mesh);
  if (!(graph.area > 0 && graph.median_edge > 0)) return error("the mesh has no area");
  if (!check_options(options, graph.median_edge, name, diagnostics)) return nullptr;

  FitChoice choice = choose_fit(mesh, graph, options.fit_radius, options.degree);
  BlendFacts facts;
  facts.degree = choice.degree;
  facts.fit_radius = choice.radius;
  facts.blend_radius = kBlendRadius * choice.radius;
  facts.node_spacing = kNodeSpacing * choice.radius;
  facts.median_edge = graph.median_edge;
  facts.noise = choice.noise;
  facts.uncertainty = choice.uncertainty;
  facts.why = std::move(choice.why);

  std::vector<NodeSeed> seeds = sample_nodes(mesh, graph, facts.node_spacing);
  std::vector<HeightFit> fits = fit_nodes(mesh, graph, seeds, choice.radius, choice.least_radius, facts.degree);
  const std::size_t dropped = drop_failures(seeds, fits);
  if (fits.empty()) return error("the mesh has too few vertices for a polynomial fit");
  if (dropped > 0) {
    diagnostics.add(
        warning_at({}, Code::mesh_unusable, name, {},
                   fmt::format("{} of {} places have too few vertices for a fit; the surface has no points there",
                               dropped, dropped + fits.size())));
  }
  return std::unique_ptr<BlendSurface>(new BlendSurface(std::move(mesh), std::move(facts), graph, seeds, fits));
}

BlendSurface::BlendSurface(Mesh mesh, BlendFacts facts, const VertexGraph& graph, const std::vector<NodeSeed>& seeds,
                           const std::vector<HeightFit>& fits)
    : mesh_(std::move(mesh)), facts_(std::move(facts)), boundary_(mesh_, graph, kEdgeCap * facts_.blend_radius) {
  std::vector<Vec3> positions, normals;
  std::vector<int> faces;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    positions.push_back(fits[i].origin);
    normals.push_back(fits[i].axes.col(2));
    node_component_.push_back(seeds[i].component);
    faces.push_back(seeds[i].face);
  }
  const NodeLinks near = link_nodes(positions, kNodeReach * facts_.blend_radius);
  std::vector<int> sheets = label_sheets(positions, normals, faces, near, facts_.blend_radius);
  std::vector<BlendField::Crease> creases;
  if (!graph.face.empty()) creases = creases_between(sheets, faces, positions, normals, near);
  facts_.node_count = static_cast<int>(fits.size());
  facts_.sheet_count = 1 + *std::max_element(sheets.begin(), sheets.end());
  node_links_ = near.kept([&](int i, int j) {
    return sheets[i] == sheets[j] && (positions[i] - positions[j]).norm() < kLinkReach * facts_.node_spacing;
  });
  field_ = BlendField(fits, std::move(sheets), facts_.degree, facts_.blend_radius, creases);
  place_nodes(fits, graph);
}

void BlendSurface::place_nodes(const std::vector<HeightFit>& fits, const VertexGraph& graph) {
  node_positions_.resize(fits.size());
  node_normals_.resize(fits.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, fits.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      SurfacePoint point;
      const bool ok = project(fits[i].origin, point);
      node_positions_[i] = ok ? point.p : fits[i].origin;
      node_normals_[i] = ok ? point.n : Vec3(fits[i].axes.col(2));
    }
  });
  node_areas_.assign(fits.size(), 0.0);
  for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
    const int node = graph.component[v] < 0 ? -1 : field_.nearest_node(mesh_.vertices[v]);
    if (node >= 0) node_areas_[node] += graph.areas[v];
  }
}

/// `near`: whether x may be on the surface already, to rounding.
bool BlendSurface::settle(const Vec3& x, bool near, SurfacePoint& out) const {
  const double radius = facts_.blend_radius, longest = kLongestBlendStep * radius;
  double f;
  Vec3 gradient;
  Mat3 hessian;
  out.p = x;
  bool final_round = near;
  for (int iteration = 0; iteration < kMaxBlendSteps; ++iteration) {
    if (!(final_round ? implicit(out.p, f, gradient, hessian) : implicit(out.p, f, gradient))) return false;
    const double square = gradient.squaredNorm();
    if (!(square > kMinBlendSlope * kMinBlendSlope)) return false;
    const double step = std::abs(f) / std::sqrt(square);
    const double floor =
        kBlendSettled * radius + 4 * std::numeric_limits<double>::epsilon() * out.p.cwiseAbs().maxCoeff();
    out.p -= (f / square * std::min(1.0, longest / std::max(step, 1e-300))) * gradient;
    if (final_round && step <= floor) {
      set_derivatives(gradient, hessian, out);
      return true;
    }
    final_round = step < kBlendNearlySettled * radius;
  }
  return false;
}

bool BlendSurface::retract(const SurfacePoint& from, const Vec2& ds, SurfacePoint& out) const {
  return settle(along_geodesic(from, ds), true, out);
}

bool BlendSurface::retract_roughly(const SurfacePoint& from, const Vec2& ds, SurfacePoint& out) const {
  const Vec3 x = along_geodesic(from, ds);
  double f;
  Vec3 gradient;
  Mat3 hessian;
  if (!implicit(x, f, gradient, hessian)) return false;
  const double square = gradient.squaredNorm();
  if (!(square > kMinBlendSlope * kMinBlendSlope)) return false;
  if (std::abs(f) > kBlendRoughly * facts_.blend_radius * std::sqrt(square)) return settle(x, false, out);
  out.p = x - f / square * gradient;
  set_derivatives(gradient, hessian, out);
  return true;
}

bool BlendSurface::bending(const Vec3& x, const Vec3& t, Bending& out) const {
  double f;
  Vec3 gradient;
  Mat3 hessian;
  if (!implicit(x, f, gradient, hessian)) return false;
  SurfacePoint point;
  set_derivatives(gradient, hessian, point);
  const Vec2 along = point.T.transpose() * t;
  out = {point.n, along.dot(point.S * along), point.S.determinant()};
  return true;
}

std::optional<double> BlendSurface::gap(const Vec3& x) const {
  double f;
  Vec3 gradient;
  if (!implicit(x, f, gradient)) return std::nullopt;
  const double slope = gradient.norm();
  if (!(slope > kMinBlendSlope)) return std::nullopt;
  return f / slope;
}

bool BlendSurface::meet(const Vec3& origin, const Vec3& direction, double& t, Vec3& normal) const {
  const double longest = kLongestBlendStep * facts_.blend_radius;
  double f;
  for (int iteration = 0; iteration < kMaxBlendSteps; ++iteration) {
    if (!implicit(origin + t * direction, f, normal)) return false;
    const double slope = normal.norm(), along = normal.dot(direction);
    if (!(slope > kMinBlendSlope) || !(std::abs(along) > kGrazingCosine * slope)) return false;
    const double step = std::clamp(-f / along, -longest, longest);
    t += step;
    if (std::abs(step) > kBlendRayMet * facts_.blend_radius) continue;
    normal /= slope;
    return true;
  }
  return false;
}

double BlendSurface::edge_distance(const Vec3& p) const {
  if (boundary_.empty()) return std::numeric_limits<double>::infinity();
  const int node = field_.nearest_node(p);
  // Out of every node's reach is far past the edge.
  return node < 0 ? -edge_cap() : boundary_.signed_distance(p, node_component_[node]);
}

void BlendSurface::set_doubtful(std::vector<DoubtfulPlace> places) {
  doubtful_ = std::move(places);
  for (DoubtfulPlace& place : doubtful_) place.reach = facts_.blend_radius;
}

SampleSet BlendSurface::samples(double, const Vec3&, double) const {
  SampleSet set;
  set.points = node_positions_;
  set.normals = node_normals_;
  set.areas = node_areas_;
  set.first_neighbour = node_links_.first;
  set.neighbours = node_links_.adjacent;
  return set;
}

Mesh BlendSurface::triangles(double, const Vec3&, double) const { return mesh_; }

}  // namespace genu
