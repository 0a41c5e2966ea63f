// What one surface of a layer casts on the other at a pose: the judge's own sums of forces, moments and areas.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "genu/judge/pose.h"

namespace genu::judge {

/// A layer's resultant on the second surface's body, about its origin, in its axes.
struct Resultant {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  Vec3 centre = Vec3::Zero();  ///< mean of the places, weighted by load; during summation, times the load
  double area = 0, most = 0, load = 0, depth = 0;
  double points = 0, outside = 0;  ///< samples in contact: those that reach into the region, and out of it
  double side = 0;                 ///< m: longest side of the area that a sample in contact represents
  double lean = 0;                 ///< largest 1 - cosine of the angle between the normals of both surfaces
  Vec3 deepest = Vec3::Zero();     ///< place of the largest depth
  /// A triangle that carries load with its centre on the border of the region: by rounding on either side.
  struct OnBorder {
    Vec3 x, on_b;
    double pressure = 0, area = 0, depth = 0;
  };
  std::vector<OnBorder> on_border = {};

  void add(const OnBorder& t) { add(t.x, t.on_b, t.pressure, t.area, t.depth); }
  void add(const Vec3& x, const Vec3& on_b, double pressure, double area_of, double depth_there) {
    if (depth_there > depth) deepest = x;
    force += pressure * area_of * on_b;
    moment += x.cross(pressure * area_of * on_b);
    centre += pressure * area_of * x;
    load += pressure * area_of;
    area += area_of;
    most = std::max(most, pressure);
    depth = std::max(depth, depth_there);
    ++points;
  }
  /// Equivalent number of square samples as fine as the coarsest ones along their longer side.
  double fineness() const { return side > 0 ? std::min(points, area / (side * side)) : points; }
  Vec3 mean() const { return load > 0 ? Vec3(centre / load) : Vec3::Zero(); }
  /// Adds another one with weight `share`.
  void join(const Resultant& o, double share) {
    force += share * o.force;
    moment += share * o.moment;
    centre += share * o.centre;
    load += share * o.load;
    area += share * o.area;
    most = std::max(most, o.most);
    if (o.depth > depth) deepest = o.deepest;
    depth = std::max(depth, o.depth);
    points = points > 0 ? std::min(points, o.points) : o.points;
    side = std::max(side, o.side);
    outside += o.outside;
    lean = std::max(lean, o.lean);
  }
};

/// Pa, of an undamped layer that is not measured to a bone; depth in m.
double pressure_of(const LayerDef& layer, double depth);

/// Keeps what it summed: the regions of a layer have the same samples.
class LayerCasts {
 public:
  LayerCasts(const PoseCase& pose, const LayerDef& layer) : pose_(pose), layer_(layer) {}

  /// Whether the surface has ends, so that samples can cover it.
  bool sampleable(int surface) const;
  /// The integral cast by surface `from` on `to` over a region (null: over the whole layer), with `fine` times as many
  /// samples along an edge, moved `raised` (m) outward.
  const Resultant& cast(const RegionDef* region, int from, int to, int fine, double raised = 0) const;

 private:
  /// Null where triangles are summed as they are.
  const BentFacets* bent_of(const Side& side) const {
    return layer_.quadrature == LayerDef::Quadrature::smooth ? side.bent.get() : nullptr;
  }
  Rim::Part part_of(const Side& other, const Vec3& x, const Vec3& n, double area, double most) const;
  double depth_of(const Side& other, const Vec3& x, const Vec3& n, double most) const;
  static double depth_under_bent(const Side& other, const Vec3& x, const Vec3& n, double most);
  std::vector<Resultant> cast_all(int from, int to, int fine, double raised) const;
  bool lies_on_border(const RegionDef& region, const Vec3& x) const;
  template <typename Clear, typename Add>
  void each_sample(int surface, int fine, Clear clear, Add add) const;

  const PoseCase& pose_;
  const LayerDef& layer_;
  /// By surfaces (from, to), fineness and distance moved; for the whole and each region.
  mutable std::map<std::tuple<int, int, int, double>, std::vector<Resultant>> casts_;
};

}  // namespace genu::judge
