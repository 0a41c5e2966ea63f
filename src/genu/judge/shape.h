// Closed forms of surfaces, independent of the solver's: a function that is 0 on the surface, positive outside and has
// a gradient there; samples; and the patch. All in the shape's own frame (m).
#pragma once

#include <optional>
#include <vector>

#include "genu/scene/scene.h"

namespace genu::judge {

/// A piece of a surface around one of its points.
struct Sample {
  Vec3 p = Vec3::Zero(), n = Vec3::Zero();  ///< m; outward unit normal
  double area = 0;                          ///< m^2: area that it represents
  double side = 0;                          ///< m: longest side of that
};

class Shape {
 public:
  /// Any surface except a mesh.
  explicit Shape(const SurfaceDef& def) : def_(&def) {}

  double value(const Vec3& p) const;
  Vec3 gradient(const Vec3& p) const;
  Vec3 normal(const Vec3& p) const { return gradient(p).normalized(); }

  /// The point of the surface nearest to p, from a search that starts at p. Empty where it does not converge.
  std::optional<Vec3> nearest(const Vec3& p) const;
  /// A point of the surface near p: down the gradient.
  std::optional<Vec3> onto(Vec3 p) const;
  /// Whether a point of the surface lies in its patch.
  bool in_patch(const Vec3& p) const;
  /// m: distance from the patch, along the axes; 0 inside.
  double beyond_patch(const Vec3& p) const;

  /// Whether it is bounded, by its form or by its patch.
  bool bounded() const;
  /// About n x n samples over the patch, fine enough for integration. For a bounded shape only.
  std::vector<Sample> samples(int n) const;
  /// n x n samples, also beside the patch, and those in the patch of the one with this index, divided into
  /// `fine` x `fine`.
  std::vector<Sample> pieces(int n) const;
  std::vector<Sample> samples_of(int n, int index, int fine) const;
  /// How fast value() changes at most near p, over the distance.
  double steepness(const Vec3& p) const;

 private:
  /// Range of the two parameters u, v.
  struct Parameters {
    double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  };
  Parameters parameters() const;
  Vec3 point(double u, double v) const;
  Sample piece(const Parameters& r, int n, int i, int j) const;

  const SurfaceDef* def_;
};

}  // namespace genu::judge
