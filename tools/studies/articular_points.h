// Points of articular surfaces, as few and as inexact as they were once measured by hand: what the polynomials of
// meshes/wismans1980 are fitted to.
#pragma once

#include <string>

#include "studies/solved_scene.h"

namespace genu::studies {

/// points-femur.ply and points-tibia.ply (mm): vertices of the measured cartilage in `data` (the folder of
/// lenhart2015), thinned to a few hundred a condyle or plateau, each moved along its normal by white noise of
/// kPointNoise, always the same. Empty, with an error in `out`, where a mesh is missing.
Files articular_points(const std::string& data, Diagnostics& out);

inline constexpr double kPointNoise = 1e-4;  ///< m, rms

}  // namespace genu::studies
