// Meshes in memory, and what there is to say about a mesh before contact is computed on it.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "genu/api/problem.h"

namespace genu::api {

/// Vertices in the unit that the scene gives for the file, and triangles of their indices from 0.
struct Triangles {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// What `genu mesh-check` reports.
struct MeshCheck {
  struct Finding {
    std::string question;  ///< "non-manifold edges"
    std::string number;    ///< "3", with its unit
    std::string verdict;   ///< "ok", "note", "BAD"
    std::string why;       ///< or where, or what to do; may be empty
  };
  std::string unit;  ///< "mm", "m", "cm", "inch" or "um"
  bool guessed = false;
  std::size_t vertices = 0, triangles = 0;
  bool bad = false;  ///< contact near some place cannot be trusted
  std::vector<Finding> findings;
  std::vector<Problem> warnings;
};

/// `unit`: "mm", "m", "cm", "inch", "um"; empty: guessed from the size. Throws SceneError for a mesh that cannot be
/// read.
MeshCheck check_mesh(const std::string& file, const std::string& unit = {});
MeshCheck check_mesh(const Triangles& mesh, const std::string& unit = {});

}  // namespace genu::api
