#include "genu/contact/smooth_layer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "genu/contact/clipped_triangle.h"
#include "genu/contact/tolerances.h"

namespace genu {
namespace {

constexpr double kRichardson[2] = {-1.0 / 3, 4.0 / 3};

std::vector<Ray> rays_from_cells(const SmoothCells& cells, double lead) {
  std::vector<Ray> rays;
  for (int cell = 0; cell < cells.cell_count(); ++cell) {
    const SmoothCells::Node m = cells.middle(cell);
    rays.push_back({m.x + lead * m.n, -m.n});
  }
  return rays;
}

std::vector<double> cell_radii(const SmoothCells& cells, double length) {
  std::vector<double> radii;
  for (int cell = 0; cell < cells.cell_count(); ++cell) radii.push_back(cells.radius(cell, cells.middle(cell), length));
  return radii;
}

double mean_edge(const TriangleTree& tree) {
  double area = 0;
  for (int t = 0; t < tree.size(); ++t) area += tree.area_vector(t).norm();
  return std::sqrt(area / std::max(1, tree.size()));
}

Vec6 line_of(const SmoothNode& node) {
  Vec6 line;
  line << -node.n, -node.x.cross(node.n);
  return line;
}

/// Factor of damping on the pressure at a node; 1 without damping.
double damped(const LayerMotion& motion, const SmoothNode& node) {
  return motion.damping == 0 ? 1 : motion.factor(node.p_rate.dot(motion.twist) / node.slope);
}

}  // namespace

SmoothLayer::SmoothLayer(std::shared_ptr<const SmoothCells> casting, std::shared_ptr<const Surface> other,
                         std::shared_ptr<const TriangleTree> target, double search_depth, const LayerLaw& law,
                         LayerThickness thickness)
    : casting_(std::move(casting)),
      other_(std::move(other)),
      target_(std::move(target)),
      search_depth_(search_depth),
      lead_(kLayerLead * casting_->mean_edge()),
      trust_(kSmoothTrust * mean_edge(*target_)),
      law_(law),
      thickness_(std::move(thickness)),
      rays_(rays_from_cells(*casting_, lead_), target_, lead_ + search_depth, LayerRays::Grouping::single,
            cell_radii(*casting_, std::max(lead_, search_depth))) {}

std::vector<Ray> SmoothLayer::cell_rays() const { return rays_from_cells(*casting_, 0); }

bool SmoothLayer::follow(const Pose& X_TC, const SmoothCells::Node& node, double from, Depth& out) const {
  const Vec3 direction = -(X_TC.R * node.n);
  Vec3 m;
  double depth = from;
  if (!other_->meet(X_TC * node.x, direction, depth, m)) return false;
  if (!(m.dot(direction) > kMinRayCosine) || !(std::abs(depth - from) < trust_)) return false;
  out.met = true;
  out.depth = depth;
  out.w = X_TC.R.transpose() * (m / -m.dot(direction));
  return true;
}

SmoothLayer::Depth SmoothLayer::measure(const Pose& X_TC, const SmoothCells::Node& node, int hint) const {
  const Vec3 direction = -(X_TC.R * node.n), outside = X_TC * node.x - lead_ * direction;
  const TriangleTree::Hit hit = target_->leaving(outside, direction, lead_ + search_depth_, hint);
  Depth out;
  if (!hit) return out;
  // A line that enters the other body below the surface starts outside of it: it passes through.
  if (hit.distance > lead_ && target_->entering(outside + lead_ * direction, direction, hit.distance - lead_))
    return out;
  out.triangle = hit.triangle;
  out.flat = hit.distance - lead_;
  if (thickness_.target) add_thickness(X_TC, node, out);
  if (follow(X_TC, node, out.flat, out)) return out;
  const Vec3& m = target_->area_vector(hit.triangle);
  out.met = true;
  out.depth = out.flat;
  out.w = X_TC.R.transpose() * (m / -m.dot(direction));
  return out;
}

/// The thickness measured at the triangle and point of the hit.
void SmoothLayer::add_thickness(const Pose& X_TC, const SmoothCells::Node& node, Depth& out) const {
  const Vec3 direction = -(X_TC.R * node.n), y = X_TC * node.x + out.flat * direction;
  const Vec3& m = target_->area_vector(out.triangle);
  out.thickness = thickness_.target->at(out.triangle, y);
  const Vec3 w = m / -m.dot(direction);
  out.u = X_TC.R.transpose() * thickness_rate(thickness_.target->gradient(out.triangle), direction, w);
}

double SmoothLayer::own_thickness(const SmoothCells::Place& place) const {
  if (!thickness_.casting) return thickness_.constant;
  const std::array<double, 3> share = SmoothCells::shares(place);
  const std::array<int, 3>& corners = casting_->vertices(place.cell);
  double own = 0;  // added first: of two terms, on an edge, both cells get the same bits
  for (int k = 0; k < 3; ++k) own += share[at(k)] * thickness_.casting->at_vertex(corners[at(k)]);
  return thickness_.constant + own;
}

/// Where the surrounding corners of the cell have met the other surface, from the interpolated depth; else as for a
/// corner.
SmoothLayer::Depth SmoothLayer::measure_inside(const Pose& X_TC, const SmoothCells::Place& place,
                                               const SmoothCells::Node& node, int hint, Memory& memory) const {
  if (thickness_.target) return measure(X_TC, node, hint);  // its triangle is needed
  const std::array<double, 3> share = SmoothCells::shares(place);
  double between = 0;
  for (int k = 0; k < 3; ++k) {
    if (share[at(k)] == 0) continue;
    const SmoothNode& corner = this->node(X_TC, SmoothCells::corner(place, k), memory);
    if (!corner.met) return measure(X_TC, node, hint);
    between += share[at(k)] * corner.depth;
  }
  Depth out;
  return follow(X_TC, node, between, out) ? out : measure(X_TC, node, hint);
}

SmoothNode& SmoothLayer::node(const Pose& X_TC, const SmoothCells::Place& place, Memory& memory) const {
  SmoothNodes& known = memory.nodes;
  int& index = known.place[at(casting_->number(place))];
  if (index < 0) {
    index = static_cast<int>(known.nodes.size());
    const SmoothCells::Node fresh = casting_->node(place, std::max(lead_, search_depth_));
    known.nodes.emplace_back();
    known.nodes.back().x = fresh.x;
    known.nodes.back().n = fresh.n;
    known.nodes.back().ridge = fresh.ridge;
    known.nodes.back().own_thickness = own_thickness(place);
  }
  if (known.nodes[at(index)].pose == known.pose) return known.nodes[at(index)];
  const SmoothCells::Node line{known.nodes[at(index)].x, known.nodes[at(index)].n};
  const int hint = known.nodes[at(index)].triangle;
  Depth d = SmoothCells::is_corner(place) ? measure(X_TC, line, hint) : measure_inside(X_TC, place, line, hint, memory);
  SmoothNode& node = known.nodes[at(index)];  // not earlier: corners may be new
  node.pose = known.pose;
  node.met = d.met;
  if (!d.met) return node;
  const Vec3 exit = node.x - d.depth * node.n;
  if (node.ridge) {
    // A normal between those of two faces leans off both: the distance across the target is what overlaps.
    const double lean = d.w.norm();
    d.depth /= lean;
    d.w /= lean;
  }
  node.triangle = d.triangle;
  node.depth = d.depth;
  node.thickness = node.own_thickness + d.thickness;
  const LayerLaw::Pressure pressure = law_.at(d.depth, node.thickness);
  node.p = pressure.p;
  node.slope = pressure.slope;
  node.p_rate << d.w, exit.cross(d.w);
  if (thickness_.target) {
    Vec6 thicker;
    thicker << d.u, (node.x - d.flat * node.n).cross(d.u);
    node.p_rate -= d.depth / node.thickness * thicker;
  }
  node.p_rate *= pressure.slope;
  node.listed = node.passed = false;
  node.load = node.area = 0;
  node.load_rate.setZero();
  return node;
}

bool SmoothLayer::worth_it(const Pose& X_TC, int cell, int divisions, Memory& memory) const {
  const double least = -kCellBump * casting_->longest_edge(cell);
  for (const auto& [i, j] : {std::pair{0, 0}, {divisions, 0}, {0, divisions}}) {
    const SmoothNode& corner = node(X_TC, {cell, divisions, i, j}, memory);
    if (corner.met && corner.depth > least) return true;
  }
  return false;
}

void SmoothLayer::add_triangle(const std::array<SmoothNode*, 3>& nodes, bool fine, Memory& memory, double& load) const {
  const auto& [a, b, c] = nodes;
  const double area = 0.5 * (b->x - a->x).cross(c->x - a->x).norm(), weight = kRichardson[fine ? 1 : 0];
  ClippedIntegrals part;
  if (a->met && b->met && c->met) {
    if (!clipped_integrals(area, {a->p, b->p, c->p}, part)) return;
  } else {
    // At the edge of the other surface: each corner counts for a third if it meets that surface.
    for (Eigen::Index i = 0; i < 3; ++i) {
      const SmoothNode& node = *nodes[static_cast<std::size_t>(i)];
      if (node.met && node.p > 0) part.mass(i, i) = part.share[i] = area / 3;
    }
    if (part.share.isZero(0)) return;
  }
  double deepest = 0;
  for (const SmoothNode* node : nodes)
    if (node->met) deepest = std::max(deepest, node->depth);
  for (Eigen::Index i = 0; i < 3; ++i) {
    SmoothNode& node = *nodes[static_cast<std::size_t>(i)];
    if (!node.met) continue;
    if (!node.listed) memory.nodes.carrying.push_back(static_cast<int>(&node - memory.nodes.nodes.data()));
    node.listed = true;
    node.passed = node.passed || (fine && node.depth < deepest);
    node.area += weight * part.share[i];
    for (Eigen::Index j = 0; j < 3; ++j) {
      const SmoothNode& other = *nodes[static_cast<std::size_t>(j)];
      if (part.mass(i, j) == 0) continue;
      load += part.mass(i, j) * other.p;
      node.load += weight * part.mass(i, j) * other.p;
      node.load_rate += weight * part.mass(i, j) * other.p_rate;
    }
  }
}

void SmoothLayer::add_cell(const Pose& X_TC, int cell, int n, Memory& memory, LayerSum& out) const {
  if (!worth_it(X_TC, cell, n, memory)) return;
  // Reserves all of the cell's nodes at once: pointers to them are held below.
  std::vector<SmoothNode>& nodes = memory.nodes.nodes;
  const std::size_t most = nodes.size() + at((n + 1) * (n + 2) / 2);
  if (most > nodes.capacity()) nodes.reserve(2 * most);
  const auto find = [&](int i, int j) {
    SmoothNode& found = node(X_TC, {cell, n, i, j}, memory);
    found.cell = cell;
    return &found;
  };
  double loads[2] = {0, 0};
  for (const int stride : {2, 1}) {
    const bool fine = stride == 1;
    for (int j = 0; j < n; j += stride)
      for (int i = 0; i + j < n; i += stride) {
        SmoothNode *b = find(i + stride, j), *c = find(i, j + stride);
        add_triangle({find(i, j), b, c}, fine, memory, loads[fine]);
        if (i + j + 2 * stride <= n) add_triangle({b, find(i + stride, j + stride), c}, fine, memory, loads[fine]);
      }
  }
  out.load += kRichardson[0] * loads[0] + kRichardson[1] * loads[1];
  out.error += std::abs(loads[1] - loads[0]) * kRichardson[1];
}

/// The caller sets `out.wrench` and `out.tangent`. `out.error` is the error removed by extrapolation.
void SmoothLayer::sum(const Pose& X_TC, Memory& memory, int level, LayerSum& out) const {
  const int divisions = 2 << std::clamp(level, 0, kMaxLayerLevel);
  SmoothNodes& known = memory.nodes;
  if (known.divisions != divisions) {
    known.divisions = divisions;
    known.place.assign(at(casting_->node_count(divisions)), -1);
    known.nodes.clear();
  }
  ++known.pose;
  known.carrying.clear();
  bool stopped = false;
  rays_.each_near(X_TC, memory, [&](int cell) {
    stopped = stopped || asked_to_stop(memory.cancelled);
    if (!stopped) add_cell(X_TC, cell, divisions, memory, out);
  });
}

void SmoothLayer::add(const Pose& X_TC, Memory& memory, LayerSum& out, int level, const LayerMotion& motion) const {
  LayerSum here;
  sum(X_TC, memory, level, here);
  for (const int index : memory.nodes.carrying) {
    const SmoothNode& node = memory.nodes.nodes[at(index)];
    const Vec6 line = line_of(node);
    const double factor = damped(motion, node);
    out.wrench += factor * node.load * line;
    if (factor != 1) out.damped -= (factor - 1) * node.load * line.dot(motion.twist);
    out.tangent += line * node.load_rate.transpose();
  }
  out.load += here.load;
  if (here.load > 0) out.error += kErrorLeft * here.error * here.error / here.load;
}

namespace {

/// Moves `here` by ds, or up to the surface's edge; false where that fails.
bool go_inside(const Surface& surface, const Vec2& ds, SurfacePoint& here) {
  SurfacePoint there;
  if (!surface.retract(here, ds, there)) return false;
  const double past = surface.edge_distance(there.p);
  if (past < 0) {
    const double inside = surface.edge_distance(here.p);
    if (!(inside > 0) || !surface.retract(here, inside / (inside - past) * ds, there)) return false;
    if (surface.edge_distance(there.p) < 0) return false;
  }
  here = there;
  return true;
}

}  // namespace

LayerPoint SmoothLayer::deepest_from(const Pose& X_TC, const SmoothNode& node, double spacing) const {
  LayerPoint best{node.x, node.n, 0, 0, node.depth, node.p, node.depth / node.thickness, node.cell};
  SurfacePoint here;
  if (!casting_->surface().project(node.x, here)) return best;
  double h = 0.5 * spacing;
  for (int step = 0; step < kMaxDeepestSteps; ++step, h = std::max(0.5 * h, 0.05 * spacing)) {
    // The quadratic through six points around it.
    double d[6], target_thickness = 0;
    const Vec2 places[6] = {{0, 0}, {h, 0}, {-h, 0}, {0, h}, {0, -h}, {h, h}};
    for (int k = 0; k < 6; ++k) {
      SurfacePoint there = here;
      if (k > 0 && !casting_->surface().retract(here, places[k], there)) return best;
      const Depth depth = measure(X_TC, {there.p, there.n}, node.triangle);
      if (!depth.met) return best;
      d[k] = depth.depth;
      if (k == 0) target_thickness = depth.thickness;
    }
    if (d[0] > best.depth) {
      const double own = thickness_.casting ? thickness_.casting->within(node.cell, here.p) : 0;
      const double thick = thickness_.constant + own + target_thickness;
      best = {here.p, here.n, 0, 0, d[0], law_.at(d[0], thick).p, d[0] / thick, node.cell};
    }
    const double hh = h * h, mixed = (d[5] - d[1] - d[3] + d[0]) / hh;
    const Vec2 gradient((d[1] - d[2]) / (2 * h), (d[3] - d[4]) / (2 * h));
    Mat2 hessian;
    hessian << (d[1] - 2 * d[0] + d[2]) / hh, mixed, mixed, (d[3] - 2 * d[0] + d[4]) / hh;
    if (!(hessian.determinant() > 0 && hessian.trace() < 0)) return best;
    Vec2 ds = -hessian.inverse() * gradient;
    ds *= std::min(1.0, kDeepestReach * spacing / std::max(ds.norm(), 1e-300));
    if (!go_inside(casting_->surface(), ds, here)) return best;
  }
  return best;
}

void SmoothLayer::visit(const Pose& X_TC, Memory& memory, const std::function<void(const LayerPoint&)>& visit,
                        int level, const LayerMotion& motion) const {
  LayerSum unused;
  sum(X_TC, memory, level, unused);
  for (const int index : memory.nodes.carrying) {
    const SmoothNode& node = memory.nodes.nodes[at(index)];
    const double depth = std::max(node.depth, 0.0);
    const double factor = damped(motion, node);
    visit({node.x, node.n, node.area, factor * node.load, depth, factor * std::max(node.p, 0.0), depth / node.thickness,
           node.cell, thickness_.guessed(node.cell, node.triangle)});
    if (!node.passed && node.depth > 0)
      visit(deepest_from(X_TC, node, casting_->longest_edge(node.cell) / memory.nodes.divisions));
  }
}

}  // namespace genu
