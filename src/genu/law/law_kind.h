// A kind of law as a scene names it: its word, the table of its numbers, and how to make the law. One file a law
// defines one of these (see blankevoort.cpp). The reader of scenes, the names of parameters, calibration and the
// documentation of a scene walk the table.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/law/force_law.h"

namespace genu {

/// One number of a law. Every number of a scene is > 0.
struct LawNumber {
  enum class Unit { strain, number, force, force_per_length, force_per_area };
  std::string key;  ///< in the scene
  Unit unit = Unit::force;
  bool limit_at_zero = false;  ///< the formula has a limit at 0, which make_law() accepts

  /// The unit's power of length: N/m^n has -n.
  int length_power() const { return unit == Unit::force_per_length ? -1 : unit == Unit::force_per_area ? -2 : 0; }
  /// "N/mm^2"; empty without a unit.
  std::string unit_name(const std::string& length_name) const;
  /// SI per unit, for a unit of length in m.
  double si(double length_unit) const;
  /// What is wrong with a value; empty if nothing is.
  std::string fault(double value) const;
};

/// The values that make a law of a kind.
struct LawValues {
  std::vector<double> numbers;                    ///< SI, in the order of the kind's table
  std::vector<std::pair<double, double>> points;  ///< (strain, N), of a kind with points
};

struct LawKind {
  std::string name;  ///< the word of `law` in a scene
  std::string what;  ///< in messages: "a quadratic ligament"
  std::vector<LawNumber> numbers;
  bool points = false;     ///< has the key `points`: (strain, N)
  bool both_ways = false;  ///< may push, and may have the slack length 0

  std::function<std::shared_ptr<const ForceLaw>(const LawValues&, double slack_length)> make;
  /// The slack length (m) at which the law has a force (N) at a length (m); the smallest strain where there are
  /// several.
  std::function<std::optional<double>(const LawValues&, double force, double length)> slack_length_for;
  /// What is wrong with the points; only for a kind that has some.
  std::function<std::string(const LawValues&)> fault_of_points = {};
};

/// The slack length at which a law of the strain alone has, at a length, the strain e; none for e <= -1.
std::optional<double> slack_length_at(std::optional<double> e, double length);

}  // namespace genu
