// Integrals over the contact area of two elastic layers.
//
// One of the two bodies casts: its surface is divided into cells, and at a point of a cell with outward normal n the
// depth d is measured along -n to the other surface. The pressure p(d) of the layer's law acts there along -n on the
// casting body and along n on the other, on the line through both points.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "genu/contact/layer_law.h"
#include "genu/contact/layer_rays.h"
#include "genu/contact/smooth_nodes.h"
#include "genu/core/cancelled.h"

namespace genu {

/// Force and moment on the casting body about its origin, and their tangent, in its own axes.
struct LayerSum {
  Vec6 wrench = Vec6::Zero();   ///< N, N m
  Mat6 tangent = Mat6::Zero();  ///< d wrench / d (twist of the casting body relative to the other), in co-rotating axes
  double load = 0;              ///< N: integral of p dA, without damping
  double damped = 0;            ///< W: power dissipated by damping
  double error = 0;  ///< N: estimated error of the load; 0 for a quadrature without a smooth reference surface
};

/// Relative motion, for damping: the pressure becomes p (1 + c d'), at least 0 (Hunt and Crossley 1975). The tangent
/// does not include damping.
struct LayerMotion {
  Vec6 twist = Vec6::Zero();  ///< of the casting body relative to the other, at its own origin, in its own axes
  double damping = 0;         ///< c, s/m

  double factor(double depth_rate) const { return std::max(0.0, 1 + damping * depth_rate); }
  /// m/s: velocity of a point of the casting body.
  Vec3 velocity(const Vec3& x) const { return twist.head<3>() + twist.tail<3>().cross(x); }
};

/// A point of the contact area, for results.
struct LayerPoint {
  Vec3 x;                ///< m, in the frame of the casting body
  Vec3 n;                ///< unit, outward there
  double area = 0;       ///< m^2 that it represents; 0 for a point that gives a depth only
  double load = 0;       ///< N that it represents, damping included
  double depth = 0;      ///< m
  double pressure = 0;   ///< Pa, damping included
  double used = 0;       ///< depth / thickness
  int cell = 0;          ///< of the casting surface
  bool guessed = false;  ///< a thickness there was filled in and not measured
};

/// The rays of a triangle layer near the rim of the other mesh.
struct RimRays {
  enum class Side : char { away, near, over };  ///< away from the rim; near it; and known to meet the mesh
  LayerRays::Memory rays;
  std::vector<Side> side;  ///< of each ray
  std::vector<int> near;   ///< rays that may be near, also a little later,
  Pose listed;             ///< since this pose
  bool known = false;
};

class LayerQuadrature {
 public:
  struct Memory : LayerRays::Memory {
    SmoothNodes nodes;
    RimRays rim;
    Cancelled cancelled;  ///< once true a long sum stops without a result
  };
  virtual ~LayerQuadrature() = default;

  /// Adds to `out`. X_TC: pose of the casting body in the frame of the other. Keeps its memory from call to call. A
  /// higher `level` refines the quadrature if it can be refined.
  virtual void add(const Pose& X_TC, Memory& memory, LayerSum& out, int level = 0,
                   const LayerMotion& motion = {}) const = 0;

  /// Visits the points with pressure.
  virtual void visit(const Pose& X_TC, Memory& memory, const std::function<void(const LayerPoint&)>& visit,
                     int level = 0, const LayerMotion& motion = {}) const = 0;

  /// From the centre of each cell of the casting surface along its inward normal, in the casting body's frame.
  virtual std::vector<Ray> cell_rays() const = 0;
  /// Triangles of the other surface, in its body's frame, for the rays.
  virtual const TriangleTree& target() const = 0;
};

/// Adds a load (N) along a line of the casting body: `line`: its force and moment for 1 N; `load_rate` (N/m, N): rate
/// of the load, a row (. twist of the casting body). All in casting axes.
inline void add_load(const Vec6& line, double load, const Vec6& load_rate, LayerSum& out) {
  out.wrench += load * line;
  for (Eigen::Index j = 0; j < 6; ++j) out.tangent.col(j) += load_rate[j] * line;
}

/// Line of a pressure at x, on the casting body with outward unit normal n.
inline Vec6 pressure_line(const Vec3& x, const Vec3& n) {
  Vec6 line;
  line << -n, -x.cross(n);
  return line;
}

/// Adds the effect of a pressure on a small area. `x`: its place; `n`: outward unit normal of the casting body; `y`:
/// the point of the other surface; `w`: d' = w . (velocity of the ray at y - velocity of the other surface there). All
/// in casting axes; `load` = p A (N), `load_slope` = p' A (N/m).
inline void add_pressure(const Vec3& x, const Vec3& n, const Vec3& y, const Vec3& w, double load, double load_slope,
                         LayerSum& out) {
  Vec6 rate;
  rate << w, y.cross(w);
  add_load(pressure_line(x, n), load, load_slope * rate, out);
}

/// h' = u . (velocity of the ray at the target's surface - velocity of the target there), for a thickness on the target
/// with this gradient: the exit point moves with the ray and, as d changes, along it. The pressure is a function of d /
/// h, so p' = slope (d' - (d / h) h').
inline Vec3 thickness_rate(const Vec3& gradient, const Vec3& direction, const Vec3& w) {
  return gradient + gradient.dot(direction) * w;
}

}  // namespace genu
