// A body of a scene, and the table of its numbers.
#pragma once

#include <optional>
#include <string>

#include "genu/core/piece_files.h"
#include "genu/core/pose.h"
#include "genu/core/source_location.h"
#include "genu/core/types.h"
#include "genu/scene/number_table.h"

namespace genu {

struct BodyDef {
  /// A closed mesh full of a material.
  struct Solid {
    PieceFiles file;       ///< paths as opened
    double file_unit = 1;  ///< m per unit of the files
    Pose placement;        ///< X_body_mesh
    double density = 0;    ///< kg/m^3
    SourceLocation where;
  };
  std::string name;
  bool fixed = false;
  /// Where mass, centre of mass and inertia come from: they are 0 as read, and known once its mesh is
  /// (assemble/read_solids.h).
  std::optional<Solid> solid;
  double mass = 0;                     ///< kg; 0 has no weight
  Vec3 centre_of_mass = Vec3::Zero();  ///< m, in the body
  Mat3 inertia = Mat3::Zero();         ///< kg m^2, about the centre of mass, axes of the body; only with dynamics
  SourceLocation where;

  bool has_weight() const { return !fixed && mass > 0; }
};

inline constexpr NumberOf<BodyDef> kBodyNumbers[] = {{.row = {.key = "mass", .unit = Unit::mass},
                                                      .values = [](BodyDef& b) { return &b.mass; },
                                                      .has_effect = [](const BodyDef& b) { return b.has_weight(); }},
                                                     {.row = {.key = "centre_of_mass",
                                                              .unit = Unit::length,
                                                              .range = NumberRow::Range::any,
                                                              .change = NumberRow::Change::absolute,
                                                              .presence = NumberRow::Presence::optional,
                                                              .size = 3,
                                                              .with = "mass",
                                                              .reason = "is where the mass acts, and there is no mass"},
                                                      .values = [](BodyDef& b) { return b.centre_of_mass.data(); },
                                                      .frame = [](const BodyDef&) { return kItself; },
                                                      .has_effect = [](const BodyDef& b) { return b.has_weight(); }}};

inline constexpr KindOf<BodyDef> kBodyKinds[] = {{"", "a body", kBodyNumbers}};

inline const KindOf<BodyDef>& kind_of(const BodyDef&) { return kBodyKinds[0]; }

}  // namespace genu
