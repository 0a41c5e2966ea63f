#include "genu/contact/smooth_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "genu/contact/tolerances.h"

namespace genu {
namespace {

Vec6 line_of(const SmoothNode& node) {
  Vec6 line;
  line << -node.n, -node.x.cross(node.n);
  return line;
}

/// Factor of damping on the pressure at a node; 1 without damping.
double damped(const LayerMotion& motion, const SmoothNode& node) {
  return motion.damping == 0 ? 1 : motion.factor(node.p_rate.dot(motion.twist) / node.slope);
}

/// The triangles that the sides' middles make of a cell.
constexpr std::array<int, 3> kQuarters[4] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {4, 5, 3}}, kCorners = {0, 1, 2};

void list(SmoothNode& node, SmoothNodes& known) {
  if (!node.listed) known.carrying.push_back(static_cast<int>(&node - known.nodes.data()));
  node.listed = true;
}

/// Adds the integrals to the nodes; returns the load.
double spread(const CellIntegrals& integrals, const Vec6& p, const std::array<SmoothNode*, 6>& nodes) {
  Mat6 rates;
  for (std::size_t k = 0; k < 6; ++k) rates.col(static_cast<Eigen::Index>(k)) = nodes[k]->p_rate;
  const Vec6 loads = integrals.mass * p;
  const Mat6 load_rates = rates * integrals.mass;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    nodes[k]->load += loads[i];
    nodes[k]->area += integrals.share[i];
    nodes[k]->load_rate += load_rates.col(i);
  }
  return loads.sum();
}

/// A number of the part, without a pattern among neighbours.
std::size_t mixed(const SmoothPart& part) {
  return ((static_cast<std::uint64_t>(part.cell) << 8) + static_cast<std::uint64_t>(part.number)) *
             0x9e3779b97f4a7c15u >>
         32;
}

void mark_passed(const std::array<SmoothNode*, 6>& nodes) {
  for (const auto& quarter : kQuarters) {
    double deepest = 0;
    for (const int k : quarter)
      if (nodes[at(k)]->met) deepest = std::max(deepest, nodes[at(k)]->depth);
    for (const int k : quarter) nodes[at(k)]->passed = nodes[at(k)]->passed || nodes[at(k)]->depth < deepest;
  }
}

}  // namespace

std::vector<Ray> SmoothLayer::cell_rays() const {
  std::vector<Ray> rays;
  for (int cell = 0; cell < depths_.casting().cell_count(); ++cell) {
    const SmoothCells::Node middle = depths_.casting().middle(cell);
    rays.push_back({middle.x, -middle.n});
  }
  return rays;
}

bool SmoothLayer::worth_it(const Pose& X_TC, int cell, Memory& memory) const {
  const double least = -kCellBump * depths_.casting().longest_edge(cell);
  for (int k = 0; k < 3; ++k) {
    const SmoothNode& corner = depths_.corner(X_TC, cell, k, memory);
    if (corner.met && corner.depth > least) return true;
  }
  return false;
}

std::array<SmoothCells::Place, 6> SmoothLayer::places(const SmoothPart& part, int divisions) {
  constexpr int kSteps[6][2] = {{0, 0}, {2, 0}, {0, 2}, {1, 0}, {1, 1}, {0, 1}};
  const int turn = part.turned ? -1 : 1;
  std::array<SmoothCells::Place, 6> out;
  for (std::size_t k = 0; k < 6; ++k)
    out[k] = {part.cell, divisions, part.i + turn * kSteps[k][0], part.j + turn * kSteps[k][1]};
  return out;
}

/// Index of the part's shape.
int SmoothLayer::shape(const SmoothPart& part, Memory& memory) const {
  SmoothNodes& known = memory.nodes;
  int& first = known.first_part[at(part.cell)];
  if (first < 0) {
    first = static_cast<int>(known.shape.size());
    known.shape.resize(known.shape.size() + at(known.divisions / 2) * at(known.divisions / 2), -1);
  }
  int& index = known.shape[at(first + part.number)];
  if (index >= 0) return index;
  index = static_cast<int>(known.shapes.size());
  SmoothShape& shape = known.shapes.emplace_back();
  SixPlaces x;
  const auto lattice = places(part, known.divisions);
  for (std::size_t k = 0; k < 6; ++k) {
    shape.nodes[k] = depths_.index(lattice[k], known);
    x[k] = known.nodes[at(shape.nodes[k])].x;
  }
  shape.integrals = QuadraticCell(x);
  return index;
}

SmoothLayer::Six SmoothLayer::nodes(const Pose& X_TC, const SmoothPart& part, int shape, Memory& memory) const {
  std::vector<SmoothNode>& known = memory.nodes.nodes;
  if (known.size() + 9 > known.capacity()) known.reserve(2 * known.size() + 512);  // pointers to them are held
  const auto lattice = places(part, memory.nodes.divisions);
  Six out;
  for (std::size_t k = 0; k < 6; ++k) {
    out[k] = &depths_.node(X_TC, lattice[k], memory.nodes.shapes[at(shape)].nodes[k], memory);
    out[k]->cell = part.cell;
  }
  return out;
}

/// At the edge of the other surface: each node counts for a third of a triangle if it meets that surface. The cell's
/// quarters and the cell undivided are extrapolated.
bool SmoothLayer::add_torn(const Six& nodes, Memory& memory, Total& out) const {
  const auto add = [&](const std::array<int, 3>& corners, double weight) {
    const Vec3 &a = nodes[at(corners[0])]->x, &b = nodes[at(corners[1])]->x, &c = nodes[at(corners[2])]->x;
    const double third = 0.5 * (b - a).cross(c - a).norm() / 3;
    double load = 0;
    for (const int k : corners) {
      SmoothNode& node = *nodes[at(k)];
      if (!node.met || !(node.p > 0)) continue;
      list(node, memory.nodes);
      node.area += weight * third;
      node.load += weight * third * node.p;
      node.load_rate += weight * third * node.p_rate;
      load += third * node.p;
    }
    return load;
  };
  const double coarse = add(kCorners, -1.0 / 3);
  double fine = 0;
  for (const auto& quarter : kQuarters) fine += add(quarter, 4.0 / 3);
  out.load += (4 * fine - coarse) / 3;
  out.removed += 4.0 / 3 * std::abs(fine - coarse);
  if (!(fine > 0)) return false;
  mark_passed(nodes);
  return true;
}

bool SmoothLayer::add_part(const Pose& X_TC, const SmoothPart& part, Memory& memory, Total& out) const {
  const int shape = this->shape(part, memory);
  const Six nodes = this->nodes(X_TC, part, shape, memory);
  Vec6 p;
  bool whole = true;
  for (std::size_t k = 0; k < 6; ++k) {
    whole = whole && nodes[k]->met;
    p[static_cast<Eigen::Index>(k)] = nodes[k]->p;
  }
  if (!whole) return add_torn(nodes, memory, out);
  const QuadraticCell& cell = memory.nodes.shapes[at(shape)].integrals;
  CellIntegrals some;
  double removed = 0;
  const QuadraticCell::Part positive = cell.integrate(p, some, removed);
  if (positive == QuadraticCell::Part::none) return false;
  for (SmoothNode* node : nodes) list(*node, memory.nodes);
  out.load += spread(positive == QuadraticCell::Part::whole ? cell.whole() : some, p, nodes);
  out.removed += std::abs(removed);
  mark_passed(nodes);
  return true;
}

void SmoothLayer::add_cell(const Pose& X_TC, int cell, Memory& memory, Total& out) const {
  if (!worth_it(X_TC, cell, memory)) return;
  const int divisions = memory.nodes.divisions;
  int number = 0;
  const auto add = [&](int i, int j, bool turned) {
    const SmoothPart part{cell, number++, i, j, turned};
    if (add_part(X_TC, part, memory, out)) memory.nodes.touching.push_back(part);
  };
  for (int j = 0; j < divisions; j += 2)
    for (int i = 0; i + j < divisions; i += 2) {
      add(i, j, false);
      if (i + j + 4 <= divisions) add(i + 2, j + 2, true);
    }
}

/// N: error of the load on a part by the quadratic between its nodes, from the surfaces in the middle of the part.
double SmoothLayer::interpolation_error(const Pose& X_TC, const SmoothPart& part, Memory& memory) const {
  const int index = this->shape(part, memory);
  const Six nodes = this->nodes(X_TC, part, index, memory);
  const Vec6 shares = quadratic_shares(1.0 / 3, 1.0 / 3);
  double depth = 0, thickness = 0, p = 0, touching = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    if (!nodes[k]->met) return 0;
    const double share = shares[static_cast<Eigen::Index>(k)];
    depth += share * nodes[k]->depth;
    thickness += share * nodes[k]->thickness;
    p += share * nodes[k]->p;
    touching += nodes[k]->p > 0 ? 1.0 / 6 : 0;
  }
  SmoothShape& shape = memory.nodes.shapes[at(index)];
  if (!shape.middle_known) {
    const int turn = part.turned ? -2 : 2, thirds = 3 * memory.nodes.divisions;
    shape.middle = depths_.casting().node({part.cell, thirds, 3 * part.i + turn, 3 * part.j + turn}, depths_.reach());
    shape.middle_known = true;
  }
  SmoothDepths::Depth there;
  if (!depths_.follow(X_TC, shape.middle, depth, there)) return 0;
  return kMiddleShare * touching * shape.integrals.whole().share.sum() *
         (depths_.law().at(there.depth, thickness).p - p);
}

/// N: the same of the whole load, from some of the parts. They are chosen by number, so that most are the same at the
/// next pose.
double SmoothLayer::interpolation_error(const Pose& X_TC, Memory& memory) const {
  const std::vector<SmoothPart>& touching = memory.nodes.touching;
  std::size_t stride = 1, count = 0;
  while (touching.size() > at(kErrorSamples) * stride) stride *= 2;
  double sum = 0, squares = 0;
  for (; count == 0 && !touching.empty(); stride = 1)
    for (const SmoothPart& part : touching) {
      if (mixed(part) % stride != 0) continue;
      const double error = interpolation_error(X_TC, part, memory);
      ++count;
      sum += error;
      squares += error * error;
    }
  if (touching.empty()) return 0;
  const double each = static_cast<double>(touching.size()) / static_cast<double>(count);
  // The mean counts as far as it is not the scatter of the few that were looked at.
  const double mean = each * (std::abs(sum) - std::sqrt((1 - 1 / each) * squares));
  return kInterpolationLeft * std::max(mean, std::sqrt(each * squares));
}

void SmoothLayer::sum_anew(const Pose& X_TC, Memory& memory) const {
  Total out;
  for (const int cell : memory.nodes.reached) {
    if (asked_to_stop(memory.cancelled)) return;
    add_cell(X_TC, cell, memory, out);
  }
  SmoothNodes& known = memory.nodes;
  known.load = out.load;
  const double left = out.load > out.removed ? kErrorLeft * out.removed * out.removed / out.load : out.removed;
  known.error = left + interpolation_error(X_TC, memory);
  known.known = true;
}

/// Leaves what nodes carry in the memory.
void SmoothLayer::sum(const Pose& X_TC, Memory& memory, int level) const {
  const int divisions = 2 << std::clamp(level, 0, kMaxLayerLevel);
  SmoothNodes& known = memory.nodes;
  if (known.known && known.divisions == divisions && known.at == X_TC) return;
  known.known = false;
  known.load = known.error = 0;
  depths_.begin(X_TC, divisions, memory);
  sum_anew(X_TC, memory);
}

void SmoothLayer::add(const Pose& X_TC, Memory& memory, LayerSum& out, int level, const LayerMotion& motion) const {
  sum(X_TC, memory, level);
  for (const int index : memory.nodes.carrying) {
    const SmoothNode& node = memory.nodes.nodes[at(index)];
    const Vec6 line = line_of(node);
    const double factor = damped(motion, node);
    out.wrench += factor * node.load * line;
    if (factor != 1) out.damped -= (factor - 1) * node.load * line.dot(motion.twist);
    out.tangent += line * node.load_rate.transpose();
  }
  out.load += memory.nodes.load;
  out.error += memory.nodes.error;
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
  if (!depths_.casting().surface().project(node.x, here)) return best;
  double h = 0.5 * spacing;
  for (int step = 0; step < kMaxDeepestSteps; ++step, h = std::max(0.5 * h, 0.05 * spacing)) {
    // The quadratic through six points around it.
    double d[6], target_thickness = 0;
    const Vec2 places[6] = {{0, 0}, {h, 0}, {-h, 0}, {0, h}, {0, -h}, {h, h}};
    for (int k = 0; k < 6; ++k) {
      SurfacePoint there = here;
      if (k > 0 && !depths_.casting().surface().retract(here, places[k], there)) return best;
      const SmoothDepths::Depth depth = depths_.measure(X_TC, {there.p, there.n}, node.triangle);
      if (!depth.met) return best;
      d[k] = depth.depth;
      if (k == 0) target_thickness = depth.thickness;
    }
    if (d[0] > best.depth) {
      const LayerThickness& layer = depths_.thickness();
      const double own = layer.casting ? layer.casting->within(node.cell, here.p) : 0;
      const double thick = layer.constant + own + target_thickness;
      best = {here.p, here.n, 0, 0, d[0], depths_.law().at(d[0], thick).p, d[0] / thick, node.cell};
    }
    const double hh = h * h, mixed = (d[5] - d[1] - d[3] + d[0]) / hh;
    const Vec2 gradient((d[1] - d[2]) / (2 * h), (d[3] - d[4]) / (2 * h));
    Mat2 hessian;
    hessian << (d[1] - 2 * d[0] + d[2]) / hh, mixed, mixed, (d[3] - 2 * d[0] + d[4]) / hh;
    if (!(hessian.determinant() > 0 && hessian.trace() < 0)) return best;
    Vec2 ds = -hessian.inverse() * gradient;
    ds *= std::min(1.0, kDeepestReach * spacing / std::max(ds.norm(), 1e-300));
    if (!go_inside(depths_.casting().surface(), ds, here)) return best;
  }
  return best;
}

void SmoothLayer::visit(const Pose& X_TC, Memory& memory, const std::function<void(const LayerPoint&)>& visit,
                        int level, const LayerMotion& motion) const {
  sum(X_TC, memory, level);
  for (const int index : memory.nodes.carrying) {
    const SmoothNode& node = memory.nodes.nodes[at(index)];
    const double depth = std::max(node.depth, 0.0);
    const double factor = damped(motion, node);
    visit({node.x, node.n, node.area, factor * node.load, depth, factor * std::max(node.p, 0.0), depth / node.thickness,
           node.cell, depths_.thickness().guessed(node.cell, node.triangle)});
    if (!node.passed && node.depth > 0)
      visit(deepest_from(X_TC, node, depths_.casting().longest_edge(node.cell) / memory.nodes.divisions));
  }
}

}  // namespace genu
