// What `genu accuracy` finds, and how it is written: settings with their errors and times, as text, table and picture.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "genu/study/accuracy_settings.h"

namespace genu {

/// Outputs with one unit.
struct AccuracyGroup {
  std::string name, unit;  ///< "position", "mm"
  std::vector<std::string> columns;
  double finest_error = 0;        ///< of what the others are compared with
  double finest_uncertainty = 0;  ///< of that estimate
  double order = 0;               ///< with which errors fall with the edges; 0: none is seen
};

/// What time is told apart by: the search for contacts, the equations of contacts, ligaments.
inline constexpr std::size_t kAccuracyEffects = 3;
extern const std::array<const char*, kAccuracyEffects> kAccuracyEffectNames;

struct AccuracyPoint {
  AccuracySetting setting;
  std::string name;
  std::vector<double> errors;  ///< of each group, in its unit, with that of the finest; NaN: not one row is comparable
  int solved = 0, asked = 0;   ///< rows
  double build_seconds = 0;    ///< all surfaces and the model
  double pose_seconds = 0;     ///< median
  double spread = 0;           ///< of the rounds: what the middle half of them lies within, over the median
  std::array<double, kAccuracyEffects> effect_seconds{};  ///< of a pose's, medians
  bool called_off = false;  ///< it took many times as long as the scene as it is: what is not solved might be
  bool complete() const { return solved == asked; }
};

struct AccuracyReport {
  std::string title, reference, machine;
  std::vector<std::pair<std::string, double>> stages;  ///< of the scene as it is: name, s
  std::vector<AccuracyGroup> groups;
  std::vector<AccuracyPoint> points;
  int rounds = 0;
  bool noisy = false;                     ///< the rounds differ too much to tell times apart
  std::map<std::string, double> targets;  ///< by unit
  int chosen = -1;                        ///< the fastest that keeps the targets, or twice the smallest errors
  std::string sentence;
};

struct AccuracyChoice {
  std::vector<std::string> targets;  ///< "0.01mm", "0.05deg", "1N"
  int rounds = 5;
  double seconds = 60;  ///< about as long it may take, but for one round
};

std::string to_text(const AccuracyReport& report);
std::string to_csv(const AccuracyReport& report);
std::string to_svg(const AccuracyReport& report);

}  // namespace genu
