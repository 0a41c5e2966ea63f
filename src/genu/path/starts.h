// All the equilibria that can be found from many starts: a joint may balance in several poses, and one start finds one.
//
// Start 1 is a given pose; start k > 1 has each coordinate that is free moved from there by the k-1 th point of
// Halton's sequence (J. Halton, Numer. Math. 2 (1960) 84-90), coordinate by coordinate in the bases 2, 3, 5, ...: the
// same starts on every machine, and more of them fill the same box more densely. A start in which surfaces overlap so
// far that they might come out on the wrong sides, or which does not settle, is drawn back toward start 1: to a half, a
// quarter, an eighth of the way.
//
// Each start is settled twice: by Newton's method alone, which finds equilibria of any kind, and downhill
// (descent_seed.h), which finds stable ones. From each equilibrium that is unstable two more descents set out,
// displaced both ways along its unstable motion: to the stable poses on either side of a saddle. Between two stable
// poses the coordinate that differs most is driven to where that costs nothing, and let go: at the saddle.
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
  double translation = 0.5;     ///< of the model's characteristic length: of a free translation
  /// Two poses are the same where no body differs by more: translations in characteristic lengths, rotations in rad.
  double same_pose = 1e-6;
  double largest_overlap = 5e-3;  ///< m: in a start, as in the reference pose of a run
  NewtonOptions newton;
};

struct Equilibrium {
  enum class Found { newton, downhill, between, beside };
  Balanced pose;
  PoseReport report;
  Stability stability;
  std::optional<double> energy;  ///< J, see potential_energy.h
  /// From 1, each at one equilibrium: where it leads downhill, or, where that ends nowhere, by Newton's method alone
  std::vector<int> starts;
  Found found = Found::newton;  ///< the first way to it
  int first_start = 0;  ///< the start of that way; of the saddle beside which, or the first pose between which it lies
};

const char* to_string(Equilibrium::Found found);

struct FailedStart {
  int start = 0;  ///< from 1
  PoseReport report;
};

struct StartSearch {
  int count = 0;                        ///< starts that were tried
  std::vector<Equilibrium> equilibria;  ///< distinct ones, in the order they were found in
  std::vector<FailedStart> failed;
};

/// Element `index` (>= 0) of the van der Corput sequence in `base` >= 2, in (0, 1): Halton's sequence, one base each.
double van_der_corput(int index, int base);

/// The coordinates of every joint from which start `k` (from 1) sets out: those of `first`, what is prescribed or held
/// at its value, and `share` of the way to the start's point.
std::vector<JointValues> start_coordinates(const JointModel& model, const Target& target,
                                           const std::vector<JointValues>& first, int k, double share,
                                           const StartOptions& options);

/// Settles every start, one after the other, at `target`, then looks between stable equilibria and beside unstable
/// ones; start 1 has the coordinates `first`. A start that is `cancelled` is not counted.
StartSearch search_starts(const JointModel& model, ContactField& field, const Target& target,
                          const std::vector<JointValues>& first, const StartOptions& options,
                          const Cancelled& cancelled);

}  // namespace genu
