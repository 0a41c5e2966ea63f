// A joint of a scene, and the tables of its numbers.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>

#include "genu/core/source_location.h"
#include "genu/core/types.h"
#include "genu/scene/number_table.h"

namespace genu {

/// The anatomical axes of a knee, or of femur and patella, for the description of Grood and Suntay
/// (model/grood_suntay.h). Unit vectors, anterior perpendicular to proximal.
struct GroodSuntayDef {
  struct Bone {
    int body = -1;
    Vec3 proximal = Vec3::UnitZ();
    Vec3 anterior = Vec3::UnitY();
    Vec3 origin = Vec3::Zero();  ///< m
  };
  bool right = true;     ///< a right knee
  bool patella = false;  ///< `tibia` is the patella
  Bone femur, tibia;
};

/// The six coordinates of `child` in `parent`: R_parent_child = R1 R2 R3 (successive rotations about the child's own
/// axes); x = child's origin in the parent's axes. A free joint names all six and constrains nothing. A revolute joint
/// leaves the first rotation, `angle` about its axis, a fixed joint none: they hold the others at `reference`, and
/// these have no names.
struct JointDef {
  enum class Type { free, revolute, fixed };
  struct Rotation {
    std::string name;
    Vec3 axis = Vec3::UnitX();  ///< signed unit axis: "flexion -z" is (0, 0, -1)
  };
  std::string name;
  int parent = -1;  ///< index into Scene::bodies
  int child = -1;
  std::array<Rotation, 3> rotations;
  std::array<std::string, 3> translations;
  std::array<double, 6> reference{};  ///< rotations (rad), then translations (m): the pose reference_strain means
  std::optional<std::array<double, 6>> start;  ///< the same: where the search for equilibrium begins, if not there
  Type type = Type::free;
  double stiffness = 0;  ///< revolute: N m / rad, at rest at angle 0
  double damping = 0;    ///< revolute: N m s / rad; only with dynamics
  struct Limits {
    double lower = -std::numeric_limits<double>::infinity();  ///< rad
    double upper = std::numeric_limits<double>::infinity();
    double stiffness = 0;  ///< N m / rad, of what lies beyond
  };
  std::optional<Limits> limits;  ///< revolute
  std::optional<GroodSuntayDef> grood_suntay;
  SourceLocation where;

  /// Whether coordinate i (0..2 rotations, 3..5 translations) may change.
  bool leaves(int i) const { return type == Type::free || (type == Type::revolute && i == 0); }
};

inline constexpr NumberOf<JointDef> kRevoluteNumbers[] = {
    {.row = {.key = "stiffness",
             .unit = Unit::moment_per_angle,
             .range = NumberRow::Range::at_least_zero,
             .presence = NumberRow::Presence::optional},
     .values = [](JointDef& j) { return &j.stiffness; }},
    {.row = {.key = "damping",
             .unit = Unit::moment_per_rate,
             .range = NumberRow::Range::at_least_zero,
             .presence = NumberRow::Presence::optional,
             .in_motion = true},
     .values = [](JointDef& j) { return &j.damping; }},
    {.row = {.key = "from",
             .unit = Unit::angle,
             .range = NumberRow::Range::any,
             .change = NumberRow::Change::absolute,
             .presence = NumberRow::Presence::optional,
             .otherwise = -std::numeric_limits<double>::infinity(),
             .table = "limits",
             .name = "limits.from"},
     .values = [](JointDef& j) { return j.limits ? &j.limits->lower : nullptr; }},
    {.row = {.key = "to",
             .unit = Unit::angle,
             .range = NumberRow::Range::any,
             .change = NumberRow::Change::absolute,
             .presence = NumberRow::Presence::optional,
             .otherwise = std::numeric_limits<double>::infinity(),
             .table = "limits",
             .name = "limits.to"},
     .values = [](JointDef& j) { return j.limits ? &j.limits->upper : nullptr; },
     .fault = [](const JointDef& j) -> const char* {
       return j.limits->lower < j.limits->upper ? nullptr : "must be more than `from`";
     }},
    {.row = {.key = "stiffness", .unit = Unit::moment_per_angle, .table = "limits", .name = "limits.stiffness"},
     .values = [](JointDef& j) { return j.limits ? &j.limits->stiffness : nullptr; }}};

inline constexpr KindOf<JointDef> kJointKinds[] = {
    {"free", "a free joint", {}}, {"revolute", "a revolute joint", kRevoluteNumbers}, {"fixed", "a fixed joint", {}}};

inline const KindOf<JointDef>& kind_of(const JointDef& j) { return kJointKinds[static_cast<int>(j.type)]; }

}  // namespace genu
