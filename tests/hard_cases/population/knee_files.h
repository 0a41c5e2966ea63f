// A random knee as genu reads it.
#pragma once

#include <string>

#include "hard_cases/population/knee_spec.h"

namespace genu::population {

/// Writes scene.toml and its meshes (binary STL, mm) into `folder`, which exists; returns the scene's path. Vertices of
/// noisy meshes are moved by numbers drawn from `noise_seed`.
std::string write_knee(const Knee& knee, const std::string& folder, std::uint64_t noise_seed);

}  // namespace genu::population
