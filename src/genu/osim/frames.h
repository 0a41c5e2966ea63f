// Frames of the model by their paths, as OpenSim writes them: "/bodyset/tibia_r", "/jointset/knee_r/femur_offset",
// "/bodyset/tibia_r/plateau_frame", "/ground". A path names one frame or none: names alone are never searched for.
#pragma once

#include <optional>
#include <string>

#include "genu/core/pose.h"
#include "genu/osim/model.h"

namespace genu::osim {

/// A frame of the model as a place in one of its bodies.
struct PlacedFrame {
  int body = -1;  ///< index into Model::bodies; their number: the ground
  Pose X_body_frame;
};

/// The path that a socket of the element at the path `owner` means: itself where it begins with a slash; else from the
/// owner, "../femur_offset". A name alone is a frame of the owner that has been read, else the ground, else a body.
std::string frame_path(const Model& model, const std::string& socket, const std::string& owner);

/// A frame by its path, through chains of offset frames. Nothing where there is none, or a chain that ends nowhere.
std::optional<PlacedFrame> find_frame(const Model& model, const std::string& path);

}  // namespace genu::osim
