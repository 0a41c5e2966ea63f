// The settings of `genu accuracy` solved in rounds, so that whatever else the machine does falls on all of them alike.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "genu/study/accuracy_report.h"
#include "genu/study/run_scene.h"

namespace genu {

/// One setting with all that solving it needs.
struct Trial {
  AccuracySetting setting;
  std::optional<Prepared> prepared;
  double build_seconds = 0;
  ResultTable poses = {};
  int solved = 0, asked = 0;
  bool called_off = false;                                         ///< it took too long: what is not solved might be
  std::vector<double> seconds = {};                                ///< a pose, of each round
  std::array<std::vector<double>, kAccuracyEffects> effects = {};  ///< of that, in each of accuracy_effects()
  bool complete() const { return solved == asked; }
};

/// Of the last time it was solved, about (model/effect_meter.h).
double effect_seconds(const Prepared& prepared, std::size_t effect);

double median(std::vector<double> values);

/// Half of the rounds took times that lie within this, over the median; with fewer than four, all of them.
double spread(std::vector<double> values);

/// With its surfaces built; empty where one cannot be.
std::optional<Trial> make_trial(const Prepared& prepared, const AccuracySetting& setting);

/// Solves all trials in turn, round after round; `own` gets the solution of the first. Those that `later` says once
/// there is something to compare join in then. False where it is called off before each of the first has been solved.
bool solve_all(std::vector<Trial>& trials, const AccuracyChoice& choice, const RunOptions& options,
               const std::function<std::vector<Trial>(const std::vector<Trial>&)>& later, int& rounds, Solution& own);

}  // namespace genu
