// A mesh as it might have been measured another time: its vertices moved along their normals by a random field.
//
// The field is a sum of random waves, as nearly Gaussian as their number allows, of mean 0 and rms noise.rms, with
//
//   correlation of x and y = exp(-|x - y|^2 / l^2),   l = noise.correlation_length
//
// It belongs to space, not to the mesh: another mesh of the same surface in the same place, coarser or in another
// order, is perturbed by the same field. Distances are straight ones: faces that are nearer than l to each other err
// alike, each along its own normal. l = 0 is white noise: each vertex errs for itself, by its index.
#pragma once

#include <cstdint>
#include <vector>

#include "genu/mesh/mesh.h"
#include "genu/surface/mesh_noise.h"

namespace genu {

/// Heights (m) at points (m), the same for the same seed, whatever the number of threads.
std::vector<double> noise_field(const std::vector<Vec3>& points, const MeshNoise& noise, std::uint64_t seed);

/// The mesh with its vertices moved along their (area weighted) normals by such heights.
Mesh perturbed(const Mesh& mesh, const MeshNoise& noise, std::uint64_t seed);

}  // namespace genu
