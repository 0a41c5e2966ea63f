// Multiple equilibria from many starts: a joint may balance in several poses, and one start finds one.
//
// Start 1 is a given pose. Start k > 1 moves each free coordinate from there by point k - 1 of Halton's sequence (J.
// Halton, Numer. Math. 2 (1960) 84-90), coordinate by coordinate in the bases 2, 3, 5, ... The starts are the same on
// every machine, and more of them fill the same box more densely. A start is moved toward start 1, to 1/2, 1/4 and 1/8
// of the way, if its surfaces overlap so far that they might separate on the wrong sides, or if it does not converge.
//
// Each start is solved twice: by Newton's method, which finds equilibria of any kind, and by energy descent
// (descent_seed.h), which finds stable ones. From each unstable equilibrium two more descents start, displaced both
// ways along its unstable mode, to the stable poses on either side of the saddle. Between two stable poses the
// coordinate that differs most is driven to the point where its reaction is 0, and released there: at the saddle.
#pragma once

#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "genu/equilibrium/active_set.h"
#include "genu/equilibrium/stability.h"
#include "genu/path/tolerances.h"

namespace genu {

struct StartOptions {
  int count = 1;
  double angle = kStartSpread;  ///< rad: largest change of a free angle
  double translation = 0.5;     ///< of the characteristic length: largest change of a free translation
  /// Two poses are the same if no body differs by more: translations in characteristic lengths, rotations in rad.
  double same_pose = 1e-6;
  double largest_overlap = 5e-3;  ///< m: allowed in a start, as in the reference pose of a run
  NewtonOptions newton;
};

struct Equilibrium {
  enum class Found { newton, downhill, between, beside };
  Balanced pose;
  PoseReport report;
  Stability stability;
  std::optional<double> energy;  ///< J, see potential_energy.h
  /// Starts (from 1) that led to this equilibrium: each counts for the result of its descent, else of Newton's method.
  std::vector<int> starts;
  Found found = Found::newton;  ///< how it was found first
  int first_start = 0;          ///< start that found it; beside: that of the saddle; between: of the first pose
};

const char* to_string(Equilibrium::Found found);

struct FailedStart {
  int start = 0;  ///< from 1
  PoseReport report;
};

struct StartSearch {
  int count = 0;                        ///< number of starts tried
  std::vector<Equilibrium> equilibria;  ///< distinct ones, in the order found
  std::vector<FailedStart> failed;
};

/// Element `index` (>= 0) of the van der Corput sequence in `base` >= 2, in (0, 1): Halton's sequence, one base each.
double van_der_corput(int index, int base);

/// The joint coordinates of start `k` (from 1): those of `first`, prescribed or held coordinates at their values, and
/// `share` of the way to the start's point.
std::vector<JointValues> start_coordinates(const JointModel& model, const Target& target,
                                           const std::vector<JointValues>& first, int k, double share,
                                           const StartOptions& options);

/// Solves every start in turn at `target`, then searches between stable equilibria and beside unstable ones. Start 1
/// has the coordinates `first`. A `cancelled` start is not counted.
StartSearch search_starts(const JointModel& model, ContactField& field, const Target& target,
                          const std::vector<JointValues>& first, const StartOptions& options,
                          const Cancelled& cancelled);

}  // namespace genu
