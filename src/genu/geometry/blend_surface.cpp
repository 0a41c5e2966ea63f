#include "genu/geometry/blend_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "genu/geometry/fit_choice.h"

namespace genu {
namespace {

constexpr double kBlendRadius = 0.7;     // of the fit radius
constexpr double kSpacing = 0.25;        // of the fit radius
constexpr double kNodeReach = 1.4;       // of the blend radius: nodes that one point of the surface may see together
constexpr double kLinkReach = 2;         // of the spacing
constexpr int kMaxIterations = 20;
constexpr double kLongestStep = 0.5;     // of the blend radius
constexpr double kSettled = 1e-11;       // of the blend radius: a step this short leaves the derivatives as they are
constexpr double kNearlySettled = 1e-3;  // of the blend radius: a step this short promises convergence in the next
constexpr double kLeastSlope = 0.3;      // |grad f| is 1 on a true distance

/// Outward normal, tangents and shape operator where f has this gradient and Hessian.
void set_derivatives(const Vec3& gradient, const Mat3& hessian, SurfacePoint& out) {
  const double slope = gradient.norm();
  out.n = gradient / slope;
  out.T = tangent_basis(out.n);
  out.S.noalias() = -(out.T.transpose() * (hessian * out.T)) / slope;
  out.S(1, 0) = out.S(0, 1) = 0.5 * (out.S(0, 1) + out.S(1, 0));
}

bool check_options(const BlendOptions& options, const std::string& name, Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& key, const std::string& found, const std::string& rule) {
    diagnostics.add({Diagnostic::Severity::error, "", 0, 0, name + key, found, rule});
  };
  bool ok = true;
  if (options.fit_radius && !(*options.fit_radius > 0 && std::isfinite(*options.fit_radius))) {
    refuse(".fit_radius", std::to_string(*options.fit_radius), "must be > 0 m");
    ok = false;
  }
  if (options.degree && (*options.degree < kMinDegree || *options.degree > kMaxDegree)) {
    refuse(".degree", std::to_string(*options.degree), "must be 2, 3 or 4");
    ok = false;
  }
  return ok;
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

}  // namespace

std::unique_ptr<BlendSurface> BlendSurface::build(Mesh mesh, const BlendOptions& options, const std::string& name,
                                                  Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& rule) {
    diagnostics.add({Diagnostic::Severity::error, "", 0, 0, name, "", rule});
    return nullptr;
  };
  if (!check_options(options, name, diagnostics)) return nullptr;
  if (const std::string fault = fault_of(mesh); !fault.empty()) return refuse(fault);
  const VertexGraph graph = vertex_graph(mesh);
  if (!(graph.area > 0)) return refuse("the mesh has no area");

  const FitChoice choice = choose_fit(mesh, graph, options.fit_radius, options.degree);
  BlendFacts facts;
  facts.degree = choice.degree;
  facts.fit_radius = choice.radius;
  facts.blend_radius = kBlendRadius * choice.radius;
  facts.node_spacing = kSpacing * choice.radius;
  facts.median_edge = graph.median_edge;
  facts.noise_rms = choice.noise_rms;
  facts.why = choice.why;

  std::vector<NodeSeed> seeds = sample_nodes(mesh, graph, facts.node_spacing);
  std::vector<HeightFit> fits = fit_nodes(mesh, graph, seeds, facts.fit_radius, facts.degree);
  std::vector<int> components;
  std::vector<Vec3> positions, normals;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (fits[i].degree == 0) continue;  // a scrap of mesh too small for any fit
    fits[kept] = fits[i];
    seeds[kept++] = seeds[i];
    positions.push_back(fits[i].origin);
    normals.push_back(fits[i].axes.col(2));
    components.push_back(seeds[i].component);
  }
  fits.resize(kept);
  seeds.resize(kept);
  if (fits.empty()) return refuse("the mesh has too few vertices for a polynomial fit");
  const NodeLinks near = link_nodes(positions, kNodeReach * facts.blend_radius);
  const std::vector<int> sheets = label_sheets(positions, normals, components, near, facts.blend_radius);
  facts.node_count = static_cast<int>(kept);
  facts.sheet_count = 1 + *std::max_element(sheets.begin(), sheets.end());
  return std::unique_ptr<BlendSurface>(
      new BlendSurface(std::move(mesh), std::move(facts), graph, std::move(seeds), fits, sheets, near));
}

BlendSurface::BlendSurface(Mesh mesh, BlendFacts facts, const VertexGraph& graph, std::vector<NodeSeed> seeds,
                           const std::vector<HeightFit>& fits, const std::vector<int>& sheets, const NodeLinks& near)
    : mesh_(std::move(mesh)),
      facts_(std::move(facts)),
      field_(fits, sheets, facts_.degree, facts_.blend_radius),
      boundary_(mesh_, graph, kEdgeCap * facts_.blend_radius) {
  for (const NodeSeed& seed : seeds) node_component_.push_back(seed.component);
  const double reach = kLinkReach * facts_.node_spacing;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    for (int j : near.of(static_cast<int>(i))) {
      if (sheets[j] != sheets[i] || (fits[j].origin - fits[i].origin).squaredNorm() > reach * reach) continue;
      node_links_.adjacent.push_back(j);
    }
    node_links_.first.push_back(static_cast<int>(node_links_.adjacent.size()));
  }
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

bool BlendSurface::project(const Vec3& x, SurfacePoint& out) const {
  const double radius = facts_.blend_radius, longest = kLongestStep * radius;
  double f;
  Vec3 gradient;
  Mat3 hessian;
  out.p = x;
  bool final_round = false;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    if (!(final_round ? implicit(out.p, f, gradient, hessian) : implicit(out.p, f, gradient))) return false;
    const double square = gradient.squaredNorm();
    if (!(square > kLeastSlope * kLeastSlope)) return false;
    const double step = std::abs(f) / std::sqrt(square);
    const double floor = kSettled * radius + 4 * std::numeric_limits<double>::epsilon() * out.p.cwiseAbs().maxCoeff();
    out.p -= (f / square * std::min(1.0, longest / std::max(step, 1e-300))) * gradient;
    if (final_round && step <= floor) {
      set_derivatives(gradient, hessian, out);
      return true;
    }
    final_round = step < kNearlySettled * radius;
  }
  return false;
}

std::optional<double> BlendSurface::gap(const Vec3& x) const {
  double f;
  Vec3 gradient;
  if (!implicit(x, f, gradient)) return std::nullopt;
  const double slope = gradient.norm();
  if (!(slope > kLeastSlope)) return std::nullopt;
  return f / slope;
}

double BlendSurface::edge_distance(const Vec3& p) const {
  if (boundary_.empty()) return std::numeric_limits<double>::infinity();
  const int node = field_.nearest_node(p);
  // Out of every node's reach is far past the edge.
  return node < 0 ? -edge_cap() : boundary_.signed_distance(p, node_component_[node]);
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
