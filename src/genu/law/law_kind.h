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

#include "genu/core/number_row.h"
#include "genu/law/force_law.h"

namespace genu {

/// The values that make a law of a kind.
struct LawValues {
  std::vector<double> numbers;                    ///< SI, in the order of the kind's table
  std::vector<std::pair<double, double>> points;  ///< (strain, N), of a kind with points
};

struct LawKind {
  std::string name;                ///< the word of `law` in a scene
  std::string what;                ///< in messages: "a quadratic ligament"
  std::vector<NumberRow> numbers;  ///< all required, single, and > 0 in a scene
  bool points = false;             ///< has the key `points`: (strain, N)
  bool both_ways = false;          ///< may push, and may have the slack length 0

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
