#include "genu/surface/patch.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "genu/mesh/mesh_cut.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

/// The part between two half planes that begin on the axis z.
class Wedge {
 public:
  explicit Wedge(const std::pair<double, double>& theta)
      : from_(std::cos(theta.first), std::sin(theta.first)),
        to_(std::cos(theta.second), std::sin(theta.second)),
        reflex_(theta.second - theta.first > std::numbers::pi) {}

  /// m, to the nearer half plane: positive inside.
  double distance(const Vec3& p) const {
    const Vec2 x = p.head<2>();
    const double over_from = cross(from_, x), over_to = cross(to_, x);
    const bool inside = reflex_ ? over_from >= 0 || over_to <= 0 : over_from >= 0 && over_to <= 0;
    const double nearer = std::min(to_half_plane(from_, over_from, x), to_half_plane(to_, over_to, x));
    return inside ? nearer : -nearer;
  }

 private:
  static double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
  static double to_half_plane(const Vec2& along, double over, const Vec2& x) {
    return along.dot(x) > 0 ? std::abs(over) : x.norm();
  }

  Vec2 from_, to_;
  bool reflex_;
};

std::optional<Wedge> wedge_of(const Patch& patch) {
  return patch.theta ? std::optional<Wedge>(*patch.theta) : std::nullopt;
}

/// Patch::edge_distance(), with the patch's wedge at hand.
double to_edge(const Patch& patch, const std::optional<Wedge>& wedge, const Vec3& p) {
  double distance = wedge ? wedge->distance(p) : std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const auto& range = patch.box[at(axis)];
    if (range) distance = std::min({distance, p[axis] - range->first, range->second - p[axis]});
  }
  return distance;
}

double mesh_area(const Mesh& mesh) {
  const SampleSet samples = vertex_samples(mesh);
  return std::accumulate(samples.areas.begin(), samples.areas.end(), 0.0);
}

using PatchSide = std::function<double(const Vec3&)>;  ///< positive inside, in the surface's frame

/// The patch as what is common to several sides, planes wherever possible: those cut a mesh exactly, whatever the size
/// of its triangles.
std::vector<PatchSide> sides_of(const Patch& patch) {
  std::vector<PatchSide> sides;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& range = patch.box[static_cast<std::size_t>(axis)];
    if (!range) continue;
    sides.emplace_back([axis, low = range->first](const Vec3& p) { return p[axis] - low; });
    sides.emplace_back([axis, high = range->second](const Vec3& p) { return high - p[axis]; });
  }
  if (!patch.theta) return sides;
  const auto [from, to] = *patch.theta;
  if (to - from > std::numbers::pi) {
    sides.emplace_back([wedge = Wedge(*patch.theta)](const Vec3& p) { return wedge.distance(p); });
    return sides;
  }
  const Vec3 first(-std::sin(from), std::cos(from), 0), last(std::sin(to), -std::cos(to), 0);
  sides.emplace_back([first](const Vec3& p) { return first.dot(p); });
  sides.emplace_back([last](const Vec3& p) { return last.dot(p); });
  return sides;
}

class PatchSurface final : public Surface {
 public:
  PatchSurface(std::shared_ptr<const Surface> surface, const Pose& X_BS, const Patch& patch,
               const std::array<bool, 3>& endless, std::function<Mesh(double)> own_mesh,
               std::function<double(const Vec3&)> front)
      : whole_(std::move(surface)),
        X_BS_(X_BS),
        patch_(patch),
        wedge_(wedge_of(patch)),
        endless_(endless),
        own_mesh_(std::move(own_mesh)),
        front_(std::move(front)) {}

  bool project(const Vec3& x, SurfacePoint& out) const override { return whole_->project(x, out); }
  bool retract(const SurfacePoint& from, const Vec2& ds, SurfacePoint& out) const override {
    return whole_->retract(from, ds, out);
  }
  bool retract_roughly(const SurfacePoint& from, const Vec2& ds, SurfacePoint& out) const override {
    return whole_->retract_roughly(from, ds, out);
  }

  bool bending(const Vec3& x, const Vec3& t, Bending& out) const override { return whole_->bending(x, t, out); }
  std::optional<RoundShape> round() const override { return whole_->round(); }
  double smooth_length() const override { return whole_->smooth_length(); }

  bool meet(const Vec3& origin, const Vec3& direction, double& t, Vec3& normal) const override {
    return whole_->meet(origin, direction, t, normal);
  }

  /// Empty past the edge: the surface there is no part of the patch, and its side says nothing.
  std::optional<double> gap(const Vec3& x) const override {
    std::optional<SurfacePoint> foot;
    return gap_and_foot(x, foot);
  }

  std::optional<double> gap_and_foot(const Vec3& x, std::optional<SurfacePoint>& foot) const override {
    if (!whole_->project(x, foot.emplace())) {
      foot.reset();
      return std::nullopt;
    }
    if (edge_distance(foot->p) < 0) return std::nullopt;
    return is_global() ? foot->n.dot(x - foot->p) : whole_->gap(x);
  }

  double edge_distance(const Vec3& p) const override {
    return std::min(whole_->edge_distance(p), to_edge(patch_, wedge_, to_own(p)));
  }

  Mesh triangles(double edge, const Vec3& centre, double reach) const override {
    if (own_mesh_) return own_mesh_(edge);
    Extent extent = extent_round(to_own(centre), reach);
    Mesh mesh = cut_out(edge, extent);
    // A patch much narrower than the edges slips through between the vertices.
    for (int k = 0; k < kPatchHalvings && mesh.triangles.empty(); ++k) mesh = cut_out(edge *= 0.5, extent);
    if (is_unbounded()) return mesh;
    // Along a steep polynomial the patch may reach farther than the box that limits it is wide.
    for (int k = 0; k < kPatchDoublings && ends_inside(mesh, extent.reach); ++k) {
      extent.reach *= 2;
      Mesh wider = cut_out(edge, extent);
      const bool grew = mesh_area(wider) > (1 + 1e-6) * mesh_area(mesh);
      mesh = std::move(wider);
      if (!grew) break;
    }
    return mesh;
  }

  /// Vertices of triangles(), put onto the surface: those of a mesh lie off it by its noise.
  SampleSet samples(double spacing, const Vec3& centre, double reach) const override {
    SampleSet set = vertex_samples(triangles(spacing, centre, reach));
    for (Vec3& p : set.points) {
      SurfacePoint foot;
      if (whole_->project(p, foot)) p = foot.p;
    }
    return set;
  }

  std::span<const DoubtfulPlace> doubtful() const override { return whole_->doubtful(); }
  bool is_global() const override { return whole_->is_global(); }
  bool knows_distance() const override { return false; }
  double clear_in_front(const Vec3& x) const override { return front_ ? front_(x) : 0; }
  bool is_unbounded() const override {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (endless_[axis] && !patch_.box[axis]) return true;
    return false;
  }

 private:
  struct Extent {
    Vec3 centre;
    double reach;
  };

  Vec3 to_own(const Vec3& p_B) const { return X_BS_.R.transpose() * (p_B - X_BS_.p); }

  /// Where an endless surface has to be looked at: along limited axes where the patch is, along others near `centre`.
  Extent extent_round(const Vec3& centre, double reach) const {
    Extent extent{centre, is_unbounded() ? reach : 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& range = patch_.box[axis];
      if (!endless_[axis] || !range) continue;
      extent.centre[static_cast<Eigen::Index>(axis)] = 0.5 * (range->first + range->second);
      extent.reach = std::max(extent.reach, 0.5 * (range->second - range->first));
    }
    if (extent.reach == 0) extent.reach = reach;
    return extent;
  }

  Mesh cut_out(double edge, const Extent& extent) const {
    Mesh mesh = whole_->triangles(edge, X_BS_ * extent.centre, extent.reach);
    for (const PatchSide& side : sides_of(patch_)) {
      const PatchSide inside = [&](const Vec3& p) { return side(to_own(p)); };
      mesh = cut_mesh(mesh, inside, [&](const Vec3& a, const Vec3& b) { return crossing(inside, a, b); });
    }
    return mesh;
  }

  /// Whether an endless surface was left off before the patch's edge.
  bool ends_inside(const Mesh& mesh, double reach) const {
    if (endless_ == std::array<bool, 3>{}) return false;
    const std::vector<bool> border = boundary_vertices(mesh, mesh_edges(mesh));
    for (std::size_t v = 0; v < border.size(); ++v)
      if (border[v] && edge_distance(mesh.vertices[v]) > 1e-6 * reach) return true;
    return false;
  }

  /// Where the surface between a, inside, and b, outside, leaves the patch: bisected to rounding, the last point
  /// inside.
  Vec3 crossing(const PatchSide& inside, const Vec3& a, const Vec3& b) const {
    Vec3 best = a;
    double low = 0, high = 1;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      Vec3 p = a + middle * (b - a);
      if (SurfacePoint point; is_global() && whole_->project(p, point)) p = point.p;
      if (inside(p) >= 0)
        low = middle, best = p;
      else
        high = middle;
    }
    return best;
  }

  std::shared_ptr<const Surface> whole_;
  Pose X_BS_;
  Patch patch_;
  std::optional<Wedge> wedge_;
  std::array<bool, 3> endless_;
  std::function<Mesh(double)> own_mesh_;
  std::function<double(const Vec3&)> front_;
};

}  // namespace

double Patch::edge_distance(const Vec3& p) const { return to_edge(*this, wedge_of(*this), p); }

std::unique_ptr<Surface> make_patch(std::shared_ptr<const Surface> surface, const Pose& X_BS, const Patch& patch,
                                    const std::array<bool, 3>& endless, std::function<Mesh(double edge)> own_mesh,
                                    std::function<double(const Vec3&)> front) {
  return std::make_unique<PatchSurface>(std::move(surface), X_BS, patch, endless, std::move(own_mesh),
                                        std::move(front));
}

}  // namespace genu
