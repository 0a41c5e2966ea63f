// How much of a patch of vertices lies in polynomials of each degree: the spectrum that tells noise from shape.
//
// The heights of the vertices within a radius over their mean plane are split into parts that are orthogonal to each
// other: the best fit of degree 0, what degree 1 adds, ..., what degree 5 adds, and the rest (index 6). A smooth shape
// falls off geometrically with the degree, the faster the narrower the patch; noise does not, once the patch is wider
// than its correlation length.
#pragma once

#include <array>
#include <vector>

#include "genu/core/types.h"
#include "genu/mesh/mesh.h"
#include "genu/mesh/vertex_graph.h"

namespace genu {

constexpr int kShellDegree = 5;
constexpr int kShells = kShellDegree + 2;  // 0 .. 5 and the rest

/// Mean square height (m^2, weighted by 1 - r^2 / radius^2) of each part.
using ShellEnergies = std::array<double, kShells>;

class ShellFitter {
 public:
  ShellFitter(const Mesh& mesh, const VertexGraph& graph);

  /// Of the patch round vertex v. False where it has too few vertices, or reaches a crease.
  bool energies(int v, double radius, ShellEnergies& out);

  /// How many vertices the last patch counted.
  int samples() const { return static_cast<int>(gathered_.size()); }

 private:
  bool gather(int v, double radius);

  const Mesh& mesh_;
  const VertexGraph& graph_;
  std::vector<int> stamp_;
  int now_ = 0;
  std::vector<int> gathered_;
};

/// The mean energies of noise on a round patch of radius 1 with evenly spread vertices.
class NoiseShells {
 public:
  explicit NoiseShells(int samples);

  /// Of unit noise with the correlation exp(-r^2 / length^2); length 0: white.
  ShellEnergies energies(double length) const;

 private:
  MatX basis_;    ///< samples x columns, orthonormal, by degree
  MatX squares_;  ///< of the distances between vertices
  VecX roots_;    ///< of the weights
};

}  // namespace genu
