// A scene as the knee that the programs of tools/peers/programs solve, and genu's own poses of it.
#pragma once

#include <string>

#include "genu/assemble/prepare.h"
#include "peers/exchange.h"

namespace genu::peers {

/// The knee of a scene whose first step prescribes the flexion of the femur on the fixed tibia. Empty, with why in
/// `out`, for a scene with anything that the programs do not know.
std::optional<Knee> make_knee(const Prepared& prepared, Diagnostics& out);

/// The scene, with the meshes in `folder` for its condyles where one is given.
std::optional<Prepared> prepare_knee(const std::string& scene, const std::string& folder, Diagnostics& out);

/// An elastic layer of the stiffness k (N/m^3, p = k d) on each triangle of the condyles in place of rigid contact: as
/// genu sums it, or as OpenSim-JAM does (plain_layer.h).
struct Layers {
  double stiffness = 0;
  bool plain = false;
};
std::optional<Prepared> prepare_layers(const std::string& scene, const std::string& folder, const Layers& layers,
                                       Diagnostics& out);

/// The path as `genu run` solves it, with all checks.
FoundPath solve_path(const Prepared& prepared);

}  // namespace genu::peers
