// A map that lays points of the reference knee on a mesh.
#pragma once

#include <span>
#include <vector>

#include "genu/atlas/point_tree.h"

namespace genu {

struct Affine {
  Mat3 linear = Mat3::Identity();
  Vec3 shift = Vec3::Zero();  ///< m

  Vec3 operator()(const Vec3& p) const { return linear * p + shift; }
};

/// y(p) = a(p) + sum_k exp(-|a(p) - c_k|^2 / (2 b^2)) w_k with a affine.
struct BoneMap {
  Affine affine;
  std::vector<Vec3> places;   ///< c_k, m
  std::vector<Vec3> weights;  ///< w_k, m
  double reach = 1;           ///< b, m

  Vec3 operator()(const Vec3& p) const;
};

/// The turn, scale and shift (and reflection, where `reflects`) that take `from` nearest to `to`. Umeyama (1991).
Affine similarity(std::span<const Vec3> from, std::span<const Vec3> to, bool reflects);

struct Registration {
  BoneMap map;
  std::vector<Vec3> mapped;     ///< m: the points, where the map takes them
  std::vector<Vec3> normals;    ///< there, unit
  std::vector<double> misfits;  ///< m: of each its distance from its partner's tangent plane, or from a partner far off
  double median = 0;            ///< m: misfit
  double matched = 0;           ///< part of the points whose misfit is below kMatched
};

/// Part of the target's points (of some hundreds, evenly) that have a mapped point as near as partners must be: little
/// where the reference is a piece of what the mesh shows.
double explained(const Registration& found, const PointTree& target);

/// Lays `points` on `target` by iterated closest points (README): from the best of `starts`, which may have a
/// reflection each.
Registration register_points(std::span<const FacingPoint> points, const PointTree& target,
                             std::span<const Affine> starts);

}  // namespace genu
