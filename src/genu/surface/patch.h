// A part of a surface, cut out by planes of the surface's own frame: where contact is meant.
//
// The surface itself goes on past the edges, so that a contact point which runs off is found there and can be told by
// how much (edge_distance); candidates for contact and overlaps are looked for on the patch alone.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "genu/core/pose.h"
#include "genu/surface/surface.h"

namespace genu {

/// Ranges of coordinates in the surface's frame; what is empty is not limited.
struct Patch {
  using Range = std::optional<std::pair<double, double>>;
  std::array<Range, 3> box;  ///< x, y, z, m
  Range theta;               ///< about z from x toward y, rad; less than a full turn wide

  /// Straight distance (m) of p, in the surface's frame, to the nearest of the cutting planes: positive inside,
  /// negative outside, +infinity without any.
  double edge_distance(const Vec3& p) const;
};

/// The part of the surface inside `patch`; X_BS is the surface's frame in its body. `endless` says along which axes of
/// that frame the surface itself has no end: where the patch limits these, the surface is bounded.
/// `own_mesh`, where given, makes the patch's triangles of about an edge (m), and the surface is not cut. `front`,
/// where given, is the patch's clear_in_front().
std::unique_ptr<Surface> make_patch(std::shared_ptr<const Surface> surface, const Pose& X_BS, const Patch& patch,
                                    const std::array<bool, 3>& endless, std::function<Mesh(double edge)> own_mesh = {},
                                    std::function<double(const Vec3&)> front = {});

}  // namespace genu
