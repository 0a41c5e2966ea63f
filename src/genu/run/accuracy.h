// What accuracy costs in time: a scene solved under many settings (accuracy_settings.h), each with its error and its
// time.
//
// Errors are the largest differences over all rows from the same path in closed form, where meshes are cut from closed
// forms; otherwise from the finest solution, together with what that is itself off by, which Richardson's
// extrapolation estimates from how the differences of coarser meshes grow with their edges (L. F. Richardson 1911).
// Times are medians over rounds in which every setting is solved once.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "genu/run/accuracy_settings.h"
#include "genu/run/run_scene.h"

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

/// A setting is called off after so many times as long as the scene as it is takes, but not
/// within a few seconds: more is of no use to anyone.
inline constexpr double kPatience = 20, kPatienceToSaveTime = 4, kShortest = 5;  // kShortest: s

/// Of the last time it was solved, about (model/effect_meter.h).
double effect_seconds(const Prepared& prepared, std::size_t effect);

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

/// The largest difference of any column over the rows that both tables have solved; `stretch` rows of `other` for one
/// of `reference`. NaN without such a row.
double largest_difference(const ResultTable& reference, const ResultTable& other,
                          const std::vector<std::string>& columns, double stretch);

/// Error of the finest of four meshes whose edges are as 1 : f2 : f3 : f4, from the differences of the others from it;
/// sets error, its uncertainty and the order.
void extrapolate(const std::vector<double>& factors, const std::vector<double>& differences, AccuracyGroup& out);

std::string to_text(const AccuracyReport& report);
std::string to_csv(const AccuracyReport& report);
std::string to_svg(const AccuracyReport& report);

/// Reads, solves under every setting, writes the scene's own results with accuracy.csv, accuracy.svg and, with targets,
/// chosen/scene.toml with the meshes it needs into `folder` (where one is given). Returns the exit code.
int run_accuracy(const std::string& path, const std::optional<std::string>& folder, const AccuracyChoice& choice,
                 const RunOptions& options, Diagnostics& out, AccuracyReport& report, Solution& own);

}  // namespace genu
