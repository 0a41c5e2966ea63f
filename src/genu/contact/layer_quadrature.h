// Sums over the area where two elastic layers are pressed together.
//
// One of the two bodies casts: its surface is cut into cells, and at a point of a cell with outward normal n the depth
// d is measured along -n to the other surface. The pressure p(d) of the layer's law acts there along -n on the casting
// body and along n on the other, on the one line that joins both points.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "genu/contact/layer_law.h"
#include "genu/contact/layer_rays.h"
#include "genu/contact/smooth_nodes.h"
#include "genu/core/cancelled.h"

namespace genu {

/// Force and moment on the casting body, about its origin, and how they change as it moves: all in its own axes.
struct LayerSum {
  Vec6 wrench = Vec6::Zero();   ///< N, N m
  Mat6 tangent = Mat6::Zero();  ///< d wrench / d (twist of the casting body against the other), in axes that turn along
  double load = 0;              ///< N: sum of p dA, without damping
  double damped = 0;            ///< W: what damping takes
  double error = 0;             ///< N: of the load, estimated; 0 where the quadrature knows no smooth surface to miss
};

/// How the bodies move, where a layer is damped: its pressure is p (1 + c d') then, never below 0 (Hunt and Crossley
/// 1975). The tangent knows nothing of it.
struct LayerMotion {
  Vec6 twist = Vec6::Zero();  ///< of the casting body against the other at the casting body's origin, its own axes
  double damping = 0;         ///< c, s/m

  double factor(double depth_rate) const { return std::max(0.0, 1 + damping * depth_rate); }
  /// m/s: of a point of the casting body.
  Vec3 velocity(const Vec3& x) const { return twist.head<3>() + twist.tail<3>().cross(x); }
};

/// A point of the area in contact, for results.
struct LayerPoint {
  Vec3 x;                ///< m, in the frame of the casting body
  Vec3 n;                ///< unit, outward there
  double area = 0;       ///< m^2 that it stands for; 0 for a point that tells how deep and nothing else
  double load = 0;       ///< N that it stands for, damping included
  double depth = 0;      ///< m
  double pressure = 0;   ///< Pa, damping included
  double used = 0;       ///< depth over thickness
  int cell = 0;          ///< of the casting surface
  bool guessed = false;  ///< where it lies a thickness was not measured, but filled in
};

class LayerQuadrature {
 public:
  struct Memory : LayerRays::Memory {
    SmoothNodes nodes;
    Cancelled cancelled;  ///< where it says so a long sum is left off, and is nothing
  };
  virtual ~LayerQuadrature() = default;

  /// Adds to `out`; X_TC is the casting body in the frame of the other. Keeps its memory from call to call. A higher
  /// `level` is finer, where the quadrature knows how to be.
  virtual void add(const Pose& X_TC, Memory& memory, LayerSum& out, int level = 0,
                   const LayerMotion& motion = {}) const = 0;

  /// Visits the points that carry pressure.
  virtual void visit(const Pose& X_TC, Memory& memory, const std::function<void(const LayerPoint&)>& visit,
                     int level = 0, const LayerMotion& motion = {}) const = 0;

  /// From the middle of each cell of the casting surface along minus its normal, in the casting body's frame.
  virtual std::vector<Ray> cell_rays() const = 0;
  /// What rays meet: triangles of the other surface, in its body's frame.
  virtual const TriangleTree& target() const = 0;
};

/// Adds what a pressure on a small area does. `x`: where; `n`: outward unit normal of the casting body; `y`: the point
/// of the other surface; `w`: d' = w . (velocity of the ray at y - velocity of the other surface there). All in casting
/// axes; `load` = p A (N), `load_slope` = p' A (N/m).
inline void add_pressure(const Vec3& x, const Vec3& n, const Vec3& y, const Vec3& w, double load, double load_slope,
                         LayerSum& out) {
  Vec6 line, rate;
  line << -n, -x.cross(n);
  rate << w, y.cross(w);
  out.wrench += load * line;
  const Vec6 turn = load_slope * rate;
  for (Eigen::Index j = 0; j < 6; ++j) out.tangent.col(j) += turn[j] * line;
}

/// h' = u . (velocity of the ray at the target's surface - velocity of the target there), of a thickness on the target
/// with this gradient: the point where the ray comes out moves with the ray and, as d changes, along it. A pressure
/// depends on d / h alone, so p' = slope (d' - (d / h) h').
inline Vec3 thickness_rate(const Vec3& gradient, const Vec3& direction, const Vec3& w) {
  return gradient + gradient.dot(direction) * w;
}

}  // namespace genu
