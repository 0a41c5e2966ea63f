// A row of a table of numbers: the key of a number of a scene, its unit, which values it may have, and how a change of
// it is named and measured. Laws, loads, surfaces, joints and bodies have such tables (law/law_kind.h,
// scene/number_table.h). The reader of scenes, parameters, calibration and the tests walk them.
#pragma once

#include <string>

#include "genu/core/units.h"

namespace genu {

/// Unit of a number of a scene. A scene chooses its units of length and angle; N, N m, kg and s are fixed.
enum class Unit {
  number,
  length,
  angle,
  force,
  moment,
  mass,
  force_per_length,
  force_per_area,
  moment_per_angle,
  force_per_speed,  ///< N s / length
  moment_per_rate,  ///< N m s / angle
  time_per_length
};

/// Units of length and angle: those of a scene, or those of results where nothing else is given.
struct ChosenUnits {
  double length = units::kMillimetre;  ///< m
  double angle = units::kDegree;       ///< rad
  std::string length_name = "mm", angle_name = "deg";
};

/// SI per unit.
double si(Unit unit, const ChosenUnits& chosen = {});
/// "N/mm^2", "N m/deg"; empty for a number without a unit.
std::string unit_name(Unit unit, const ChosenUnits& chosen = {});
/// The same in names of columns and parameters: "Nm/deg"; "1" for a number without a unit.
std::string unit_in_results(Unit unit);

struct NumberRow {
  enum class Range {
    any,
    at_least_zero,
    above_zero,
    above_zero_or_limit  ///< > 0 in a scene; a program may give 0, where the formula has a limit
  };
  enum class Change {
    share,    ///< 1 % of the value
    absolute  ///< standard_change() of the unit
  };
  enum class Presence { required, optional };

  const char* key = "";
  Unit unit = Unit::number;
  Range range = Range::above_zero;
  Change change = Change::share;
  Presence presence = Presence::required;
  int size = 1;                  ///< 3: a vector [x, y, z]
  double otherwise = 0;          ///< SI, where an optional number is absent
  const char* table = nullptr;   ///< key of the table inside the object that has it, as "limits" of a joint
  const char* name = nullptr;    ///< in parameters: "limits.from"; the key where there is none
  const char* with = nullptr;    ///< key of another number without which this one has no effect
  const char* reason = nullptr;  ///< why, for the message: "is where the mass acts, and there is no mass"
  bool in_motion = false;        ///< has an effect only in a scene with [dynamics]

  const char* parameter() const { return name != nullptr ? name : key; }
  /// What is wrong with a value; empty if nothing is.
  std::string fault(double value) const;
};

/// The change that makes parameters of different kinds comparable: 1 mm, 1 deg, 1 N, 0.01 N m, 0.01 of a number, 1 of
/// any other unit of results. SI.
double standard_change(Unit unit);
/// "1 mm", "0.01 Nm", "0.01"
std::string standard_change_text(Unit unit);

}  // namespace genu
