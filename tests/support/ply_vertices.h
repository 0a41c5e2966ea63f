// The vertices of a mesh file by their numbers there, which a reader need not keep.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "genu/core/types.h"
#include "support/temporary_folder.h"

namespace genu::test {

/// Vertices of a binary PLY file of x y z, some with normals, in its own order. m.
inline std::vector<Vec3> ply_vertices(const std::string& file) {
  const std::string bytes = read_file(file);
  const std::size_t body = bytes.find("end_header\n") + 11, count = std::stoul(bytes.substr(bytes.find("vertex ") + 7));
  const std::size_t numbers = bytes.substr(0, body).find("property float nx") == std::string::npos ? 3 : 6;
  std::vector<Vec3> out(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      float x = 0;
      std::memcpy(&x, bytes.data() + body + 4 * (numbers * i + k), 4);
      out[i][static_cast<Eigen::Index>(k)] = 1e-3 * static_cast<double>(x);
    }
  return out;
}

}  // namespace genu::test
