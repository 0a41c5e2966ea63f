#include "genu/contact/smooth_depths.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "genu/contact/tolerances.h"

namespace genu {
namespace {

std::vector<Ray> rays_from_corners(const SmoothCells& cells, double lead) {
  std::vector<Ray> rays;
  rays.reserve(cells.corners().size());
  for (const SmoothCells::Node& c : cells.corners()) rays.push_back({c.x + lead * c.n, -c.n});
  return rays;
}

double mean_edge(const TriangleTree& tree) {
  double area = 0;
  for (int t = 0; t < tree.size(); ++t) area += tree.area_vector(t).norm();
  return std::sqrt(area / std::max(1, tree.size()));
}

}  // namespace

SmoothDepths::SmoothDepths(std::shared_ptr<const SmoothCells> casting, std::shared_ptr<const SmoothCells> target,
                           std::shared_ptr<const TriangleTree> tree, double search_depth, const LayerLaw& law,
                           LayerThickness thickness)
    : casting_(std::move(casting)),
      target_(std::move(target)),
      tree_(std::move(tree)),
      search_depth_(search_depth),
      edge_(target_->mean_edge()),
      lead_(lead()),
      trust_(kSmoothTrust * mean_edge(*tree_)),
      law_(law),
      thickness_(std::move(thickness)),
      facets_(target_),
      rays_(rays_from_corners(*casting_, lead_), tree_, lead_ + search_depth, LayerRays::Grouping::together, {}, lead_),
      first_cell_(casting_->corners().size() + 1, 0) {
  for (int cell = 0; cell < casting_->cell_count(); ++cell)
    for (const int v : casting_->vertices(cell)) ++first_cell_[at(v + 1)];
  for (std::size_t v = 1; v < first_cell_.size(); ++v) first_cell_[v] += first_cell_[v - 1];
  cells_.resize(at(first_cell_.back()));
  std::vector<int> next = first_cell_;
  for (int cell = 0; cell < casting_->cell_count(); ++cell)
    for (const int v : casting_->vertices(cell)) cells_[at(next[at(v)]++)] = cell;
}

/// Beyond bumps within a cell and the distance of the target's triangles from its smooth surface.
double SmoothDepths::lead() const {
  double longest = 0;
  for (int cell = 0; cell < casting_->cell_count(); ++cell) longest = std::max(longest, casting_->longest_edge(cell));
  return std::max(kLayerLead * std::max(casting_->mean_edge(), edge_), kCellBump * longest);
}

void SmoothDepths::begin(const Pose& X_TC, int divisions, Memory& memory) const {
  SmoothNodes& known = memory.nodes;
  if (known.divisions != divisions) {
    known.divisions = divisions;
    known.place.assign(at(casting_->node_count(divisions)), -1);
    known.nodes.clear();
    known.first_part.assign(at(casting_->cell_count()), -1);
    known.shape.clear();
    known.shapes.clear();
  }
  known.corners.resize(casting_->corners().size());
  known.seen.resize(at(casting_->cell_count()), 0);
  ++known.pose;
  known.at = X_TC;
  known.carrying.clear();
  known.touching.clear();
  known.reached.clear();
  rays_.cast(X_TC, memory, [&](int corner, const TriangleTree::Hit& hit, const Vec3&, const Vec3&) {
    known.corners[at(corner)] = {known.pose, hit.triangle, hit.distance - lead_};
    for (int k = first_cell_[at(corner)]; k < first_cell_[at(corner + 1)]; ++k) {
      if (hit.distance - lead_ < -kCellNear * std::max(edge_, casting_->longest_edge(cells_[at(k)]))) continue;
      std::uint64_t& seen = known.seen[at(cells_[at(k)])];
      if (seen != known.pose) known.reached.push_back(cells_[at(k)]);
      seen = known.pose;
    }
  });
}

bool SmoothDepths::accept(const Pose& X_TC, const Line& line, double from, double depth, const Vec3& m,
                          Depth& out) const {
  const double cosine = m.dot(line.direction);
  if (!(cosine > kMinRayCosine) || !(std::abs(depth - from) < trust_)) return false;
  out.met = true;
  out.depth = depth;
  out.w = X_TC.R.transpose() * (m / -cosine);
  return true;
}

void SmoothDepths::accept_flat(const Pose& X_TC, const Line& line, Depth& out) const {
  const Vec3& m = tree_->area_vector(out.triangle);
  out.met = true;
  out.depth = out.flat;
  out.w = X_TC.R.transpose() * (m / -m.dot(line.direction));
}

bool SmoothDepths::follow(const Pose& X_TC, const SmoothCells::Node& node, double from, Depth& out) const {
  return follow(X_TC, line_from(X_TC, node.x, node.n), from, out);
}

bool SmoothDepths::follow(const Pose& X_TC, const Line& line, double from, Depth& out) const {
  Vec3 m;
  double depth = from;
  return target_->surface().meet(line.origin, line.direction, depth, m) && accept(X_TC, line, from, depth, m, out);
}

bool SmoothDepths::follow_facets(const Pose& X_TC, const Line& line, double from, Memory& memory, Depth& out) const {
  CurvedFacets::Meeting there;
  if (!facets_.meet(line.origin, line.direction, out.triangle, memory.nodes.facets, there)) return false;
  if (!accept(X_TC, line, from, there.distance, there.normal, out)) return false;
  out.triangle = there.facet;
  return true;
}

/// From the flat triangle to the smooth surface over it; stays where that fails.
void SmoothDepths::bend(const Pose& X_TC, const Line& line, Memory& memory, Depth& out) const {
  if (thickness_.target) add_thickness(X_TC, line, out);
  const bool bent = memory.nodes.divisions == 2 ? follow_facets(X_TC, line, out.flat, memory, out)
                                                : follow(X_TC, line, out.flat, out);
  if (!bent) accept_flat(X_TC, line, out);
}

bool SmoothDepths::cast(const Line& line, int hint, Depth& out) const {
  const TriangleTree::Hit hit =
      tree_->leaving(line.origin - lead_ * line.direction, line.direction, lead_ + search_depth_, hint);
  if (!hit) return false;
  // A line that enters the other body below the surface starts outside of it: it passes through.
  if (hit.distance > lead_ && tree_->entering(line.origin, line.direction, hit.distance - lead_)) return false;
  out.triangle = hit.triangle;
  out.flat = hit.distance - lead_;
  return true;
}

SmoothDepths::Depth SmoothDepths::measure(const Pose& X_TC, const SmoothCells::Node& node, int hint) const {
  const Line line = line_from(X_TC, node.x, node.n);
  Depth out;
  if (!cast(line, hint, out)) return out;
  if (thickness_.target) add_thickness(X_TC, line, out);
  if (!follow(X_TC, line, out.flat, out)) accept_flat(X_TC, line, out);
  out.met = out.depth <= search_depth_;
  return out;
}

/// The thickness measured at the triangle and point of the hit.
void SmoothDepths::add_thickness(const Pose& X_TC, const Line& line, Depth& out) const {
  const Vec3& m = tree_->area_vector(out.triangle);
  out.thickness = thickness_.target->at(out.triangle, line.origin + out.flat * line.direction);
  const Vec3 w = m / -m.dot(line.direction);
  out.u = X_TC.R.transpose() * thickness_rate(thickness_.target->gradient(out.triangle), line.direction, w);
}

double SmoothDepths::own_thickness(const SmoothCells::Place& place) const {
  if (!thickness_.casting) return thickness_.constant;
  const std::array<double, 3> share = SmoothCells::shares(place);
  const std::array<int, 3>& corners = casting_->vertices(place.cell);
  double own = 0;  // added first: of two terms, on an edge, both cells get the same bits
  for (int k = 0; k < 3; ++k) own += share[at(k)] * thickness_.casting->at_vertex(corners[at(k)]);
  return thickness_.constant + own;
}

/// Outside of contact, further than the lines from the corners begin: from a facet that another corner of the cell
/// meets, or of any cell at this corner.
bool SmoothDepths::beyond_lead(const SmoothCells::Place& place, const Line& line, Memory& memory, Depth& out) const {
  const double limit = kLayerReachOut * casting_->longest_edge(place.cell);
  if (!SmoothCells::is_corner(place)) return beyond_lead_of(place.cell, limit, line, memory, out);
  const std::size_t v = at(casting_->number(place)), first = at(first_cell_[v]), last = at(first_cell_[v + 1]);
  double most = 0;
  for (std::size_t k = first; k < last; ++k) most = std::max(most, kLayerReachOut * casting_->longest_edge(cells_[k]));
  for (std::size_t k = first; k < last; ++k)
    if (beyond_lead_of(cells_[k], most, line, memory, out)) return true;
  return false;
}

bool SmoothDepths::beyond_lead_of(int cell, double limit, const Line& line, Memory& memory, Depth& out) const {
  const SmoothNodes& known = memory.nodes;
  for (const int v : casting_->vertices(cell)) {
    const CornerHit& hit = known.corners[at(v)];
    if (hit.pose != known.pose) continue;
    CurvedFacets::Meeting there;
    if (!facets_.meet(line.origin, line.direction, hit.triangle, memory.nodes.facets, there)) continue;
    if (!(there.distance < 0 && there.distance > -limit)) continue;
    if (!(there.normal.dot(line.direction) > kMinRayCosine)) continue;
    const Vec3& flat = tree_->area_vector(there.facet);
    if (!(flat.dot(line.direction) > kMinRayCosine * flat.norm())) continue;
    out.triangle = there.facet;
    out.flat = there.distance;
    return true;
  }
  return false;
}

SmoothDepths::Depth SmoothDepths::measure_corner(const Pose& X_TC, const SmoothCells::Place& place, const Line& line,
                                                 Memory& memory) const {
  Depth out;
  const CornerHit& hit = memory.nodes.corners[at(casting_->number(place))];
  if (hit.pose == memory.nodes.pose) {
    out.triangle = hit.triangle;
    out.flat = hit.depth;
  } else if (!beyond_lead(place, line, memory, out)) {
    return out;
  }
  bend(X_TC, line, memory, out);
  return out;
}

/// Where the surrounding corners of the cell have met the other surface, from the interpolated depth; else by a line
/// of its own.
SmoothDepths::Depth SmoothDepths::measure_inside(const Pose& X_TC, const SmoothCells::Place& place, const Line& line,
                                                 int hint, Memory& memory) const {
  const std::array<double, 3> share = SmoothCells::shares(place);
  Depth out;
  double between = 0;
  bool met = !thickness_.target;  // else the triangle is needed
  for (int k = 0; met && k < 3; ++k) {
    if (share[at(k)] == 0) continue;
    const SmoothNode& corner = this->corner(X_TC, place.cell, k, memory);
    met = corner.met;
    between += share[at(k)] * corner.depth;
    out.triangle = corner.triangle;
  }
  if (met && (memory.nodes.divisions == 2 ? follow_facets(X_TC, line, between, memory, out)
                                          : follow(X_TC, line, between, out)))
    return out;
  out = {};
  if (cast(line, hint, out) || beyond_lead(place, line, memory, out)) bend(X_TC, line, memory, out);
  return out;
}

int SmoothDepths::index(const SmoothCells::Place& place, SmoothNodes& known) const {
  int& index = known.place[at(casting_->number(place))];
  if (index < 0) {
    index = static_cast<int>(known.nodes.size());
    const SmoothCells::Node fresh = casting_->node(place, reach());
    known.nodes.emplace_back();
    known.nodes.back().x = fresh.x;
    known.nodes.back().n = fresh.n;
    known.nodes.back().ridge = fresh.ridge;
    known.nodes.back().own_thickness = own_thickness(place);
  }
  return index;
}

SmoothNode& SmoothDepths::corner(const Pose& X_TC, int cell, int k, Memory& memory) const {
  const SmoothCells::Place place = SmoothCells::corner({cell, memory.nodes.divisions, 0, 0}, k);
  const int known = memory.nodes.place[at(casting_->vertices(cell)[at(k)])];
  return node(X_TC, place, known < 0 ? index(place, memory.nodes) : known, memory);
}

SmoothNode& SmoothDepths::node(const Pose& X_TC, const SmoothCells::Place& place, int index, Memory& memory) const {
  const SmoothNode& known = memory.nodes.nodes[at(index)];
  if (known.pose != memory.nodes.pose) {
    const Line line = line_from(X_TC, known.x, known.n);
    const Depth d = SmoothCells::is_corner(place) ? measure_corner(X_TC, place, line, memory)
                                                  : measure_inside(X_TC, place, line, known.triangle, memory);
    SmoothNode& node = memory.nodes.nodes[at(index)];  // corners may be new
    node.pose = memory.nodes.pose;
    node.met = d.met && d.depth <= search_depth_;  // a smooth surface lies on either side of its triangles
    if (node.met) set(d, node);
  }
  return memory.nodes.nodes[at(index)];
}

void SmoothDepths::set(Depth d, SmoothNode& node) const {
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
}

}  // namespace genu
