// Triangles of a random knee's shapes, by plain grids over their parameters: no code of genu's.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hard_cases/population/knee_spec.h"

namespace genu::population {

struct Triangles {
  std::vector<Vec3> vertices;  ///< mm, in the shape's own frame
  std::vector<std::array<int, 3>> faces;
};

Triangles shape_mesh(const Shape& shape, double size_x, double size_y, std::uint64_t noise_seed);

/// Binary STL, float32.
void write_binary_stl(const Triangles& mesh, const std::string& path);

}  // namespace genu::population
