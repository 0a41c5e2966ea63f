// A bushing of a scene: a linear spring between frames of two bodies, in all six directions. And the table of its
// numbers.
#pragma once

#include <optional>
#include <string>

#include "genu/core/pose.h"
#include "genu/core/source_location.h"
#include "genu/core/types.h"
#include "genu/scene/number_table.h"

namespace genu {

struct BushingDef {
  struct Frame {
    int body = -1;
    Pose placement;  ///< X_body_frame, m
  };
  std::string name;
  Frame from, to;
  bool coincide = false;                   ///< `to` has no place of its own: the frames coincide at the reference pose
  Vec3 stiffness = Vec3::Zero();           ///< N / m along the axes of `from`
  Vec3 rotation_stiffness = Vec3::Zero();  ///< N m / rad about them
  Vec3 damping = Vec3::Zero();             ///< N s / m; only with dynamics
  Vec3 rotation_damping = Vec3::Zero();    ///< N m s / rad; only with dynamics
  /// In the place of both stiffnesses: N, m, rad; of [x, y, z, rotation vector].
  std::optional<Mat6> matrix;
  SourceLocation where;
};

/// One of three numbers along or about the axes of a bushing.
constexpr NumberRow bushing_row(const char* key, Unit unit, bool in_motion) {
  return {.key = key,
          .unit = unit,
          .range = NumberRow::Range::at_least_zero,
          .presence = NumberRow::Presence::optional,
          .size = 3,
          .in_motion = in_motion};
}

inline constexpr NumberOf<BushingDef> kBushingNumbers[] = {
    {.row = bushing_row("stiffness", Unit::force_per_length, false),
     .values = [](BushingDef& b) { return b.stiffness.data(); },
     .has_effect = [](const BushingDef& b) { return !b.matrix; }},
    {.row = bushing_row("rotation_stiffness", Unit::moment_per_angle, false),
     .values = [](BushingDef& b) { return b.rotation_stiffness.data(); },
     .has_effect = [](const BushingDef& b) { return !b.matrix; }},
    {.row = bushing_row("damping", Unit::force_per_speed, true),
     .values = [](BushingDef& b) { return b.damping.data(); }},
    {.row = bushing_row("rotation_damping", Unit::moment_per_rate, true),
     .values = [](BushingDef& b) { return b.rotation_damping.data(); }}};

inline constexpr KindOf<BushingDef> kBushingKinds[] = {{"", "a bushing", kBushingNumbers}};

inline const KindOf<BushingDef>& kind_of(const BushingDef&) { return kBushingKinds[0]; }

}  // namespace genu
