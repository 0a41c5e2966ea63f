// A load of a scene, and the tables of its numbers. A load is affine in each of them (model/load.h).
#pragma once

#include <optional>
#include <string>

#include "genu/core/source_location.h"
#include "genu/core/types.h"
#include "genu/scene/number_table.h"
#include "genu/scene/path_def.h"
#include "genu/scene/scale_def.h"

namespace genu {

struct LoadDef {
  enum class Kind { wrench, toward, coordinate, cable };
  enum class Frame { world, body };
  std::string name;
  Kind kind = Kind::wrench;
  int body = -1;                     ///< wrench, toward
  Vec3 force = Vec3::Zero();         ///< wrench: N
  Vec3 moment = Vec3::Zero();        ///< wrench: N m
  Vec3 point = Vec3::Zero();         ///< wrench, toward: m, in the body
  Frame frame = Frame::world;        ///< wrench
  int toward_body = -1;              ///< toward: the body pulled to, and pulled on as much
  Vec3 toward_point = Vec3::Zero();  ///< m, in that body
  double value = 0;                  ///< toward, cable: N; coordinate: N m or N
  double activation = 1;             ///< toward, cable: the share of the value that acts
  std::vector<PathEnd> points;       ///< cable: from end to end
  std::vector<WrapDef> wraps;        ///< cable: surfaces between them, in order
  CoordinateRef coordinate;          ///< coordinate: where the generalised moment or force acts
  std::optional<ScaleDef> scale;
  SourceLocation where;

  /// Whether it changes with time by itself.
  bool in_time() const { return scale && scale->in_time(); }
  bool on_rotation() const { return kind == Kind::coordinate && coordinate.index < 3; }
};

/// A number of any value that the file may leave out.
constexpr NumberRow load_row(const char* key, Unit unit, int size, double otherwise = 0) {
  return {.key = key,
          .unit = unit,
          .range = NumberRow::Range::any,
          .change = NumberRow::Change::absolute,
          .presence = NumberRow::Presence::optional,
          .size = size,
          .otherwise = otherwise};
}

inline constexpr NumberOf<LoadDef> kForce{.row = load_row("force", Unit::force, 3),
                                          .values = [](LoadDef& l) { return l.force.data(); }};
inline constexpr NumberOf<LoadDef> kMoment{.row = load_row("moment", Unit::moment, 3),
                                           .values = [](LoadDef& l) { return l.moment.data(); }};
inline constexpr NumberOf<LoadDef> kForcePoint{.row = {.key = "point",
                                                       .unit = Unit::length,
                                                       .range = NumberRow::Range::any,
                                                       .change = NumberRow::Change::absolute,
                                                       .presence = NumberRow::Presence::optional,
                                                       .size = 3,
                                                       .with = "force",
                                                       .reason = "is where a force acts, and there is no force"},
                                               .values = [](LoadDef& l) { return l.point.data(); },
                                               .frame = [](const LoadDef& l) { return l.body; }};
inline constexpr NumberOf<LoadDef> kWrenchNumbers[] = {kForce, kMoment, kForcePoint};

inline constexpr NumberOf<LoadDef> kMagnitude{.row = {.key = "magnitude",
                                                      .unit = Unit::force,
                                                      .range = NumberRow::Range::at_least_zero,
                                                      .change = NumberRow::Change::absolute},
                                              .values = [](LoadDef& l) { return &l.value; }};
inline constexpr NumberOf<LoadDef> kActivation{.row = {.key = "activation",
                                                       .range = NumberRow::Range::at_least_zero,
                                                       .change = NumberRow::Change::absolute,
                                                       .presence = NumberRow::Presence::optional,
                                                       .otherwise = 1},
                                               .values = [](LoadDef& l) { return &l.activation; }};
inline constexpr NumberOf<LoadDef> kPulledPoint{.row = load_row("point", Unit::length, 3),
                                                .values = [](LoadDef& l) { return l.point.data(); },
                                                .frame = [](const LoadDef& l) { return l.body; }};
inline constexpr NumberOf<LoadDef> kTowardPoint{.row = {.key = "point",
                                                        .unit = Unit::length,
                                                        .range = NumberRow::Range::any,
                                                        .change = NumberRow::Change::absolute,
                                                        .size = 3,
                                                        .table = "toward",
                                                        .name = "toward"},
                                                .values = [](LoadDef& l) { return l.toward_point.data(); },
                                                .frame = [](const LoadDef& l) { return l.toward_body; }};
inline constexpr NumberOf<LoadDef> kTowardNumbers[] = {kMagnitude, kActivation, kPulledPoint, kTowardPoint};

inline constexpr NumberOf<LoadDef> kMomentNumbers[] = {
    {.row = load_row("value", Unit::moment, 1, 1), .values = [](LoadDef& l) { return &l.value; }}};
inline constexpr NumberOf<LoadDef> kForceNumbers[] = {
    {.row = load_row("value", Unit::force, 1, 1), .values = [](LoadDef& l) { return &l.value; }}};

inline constexpr NumberOf<LoadDef> kCableNumbers[] = {kMagnitude, kActivation};

/// In the order of LoadDef::Kind; of a load on a coordinate one kind for rotations, one for translations.
inline constexpr KindOf<LoadDef> kLoadKinds[] = {{"", "a load", kWrenchNumbers},
                                                 {"toward", "a load toward a point", kTowardNumbers},
                                                 {"on", "a load on a joint coordinate", kMomentNumbers},
                                                 {"on", "a load on a joint coordinate", kForceNumbers},
                                                 {"from", "a cable", kCableNumbers}};

inline const KindOf<LoadDef>& kind_of(const LoadDef& l) {
  const bool on_translation = l.kind == LoadDef::Kind::coordinate && !l.on_rotation();
  return kLoadKinds[static_cast<int>(l.kind) + (on_translation || l.kind == LoadDef::Kind::cable ? 1 : 0)];
}

}  // namespace genu
