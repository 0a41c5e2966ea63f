// How lax a new knee is in the standard tests of docs/laxity.md, intact and with each of four ligaments cut, and how
// that depends on its numbers.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/core/cancelled.h"
#include "genu/model/parameters.h"

namespace genu {

/// Numbers of a scene that change together: each with its derivative (SI) to what changes them.
using NumberRates = std::vector<std::pair<Parameter, double>>;

struct NewKneeLaxity {
  struct Range {
    double least = std::numeric_limits<double>::infinity(), most = -least;  ///< over the angles
  };
  Range drawer;          ///< m: anterior
  Range sideways;        ///< rad: varus and valgus together
  Range rotation;        ///< rad: internal and external together
  int complete = 0;      ///< curves of the intact knee
  int cut_complete = 0;  ///< curves of the knees with a ligament cut

  /// What has to be within a range.
  struct Value {
    double value;        ///< m or rad; NaN where its curve ends before
    double least, most;  ///< the range
    double margin;       ///< how far inside it is aimed at
    VecX rates;          ///< derivatives, as asked for

    double aimed_least() const { return least + margin; }
    double aimed_most() const { return most - margin; }
  };
  /// Drawer, varus and valgus, and rotation at each angle; then of each cut ligament the mean motion that is added in
  /// its own direction, and how much more that is than the others add there.
  std::vector<Value> values;

  /// All curves of the intact knee and of the cut ones.
  bool all_complete() const { return missing_curves() == 0; }
  int missing_curves() const;
  /// All curves, and each value within its range, `margins` of its margin inside.
  bool usual(double margins = 0) const;
  /// For the terminal.
  std::string text() const;
};

/// At 0, 30, 60 and 90 deg, under the loads of `genu laxity`. The derivatives are exact, of the equilibria that were
/// found.
NewKneeLaxity laxity_of_new(const Prepared& prepared, const std::vector<NumberRates>& directions,
                            const Cancelled& cancelled);

}  // namespace genu
