// Which place of which body a frame of the model is.
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

/// A frame by its path, through chains of offset frames: "/bodyset/tibia_r", "/jointset/knee_r/tibia_r_offset",
/// "femur_r_offset" of the joint `owner`, "/ground". Nothing where there is none, or a chain that ends nowhere.
std::optional<PlacedFrame> find_frame(const Model& model, const std::string& path, const std::string& owner);

}  // namespace genu::osim
