// What is kept of a sample: columns of its results at rows.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/result_table.h"
#include "genu/sweep/sweep_def.h"

namespace genu {

/// The coordinate over which a scene's rows go: the first that a step prescribes and changes, or the time of a motion.
struct MainCoordinate {
  std::string column;        ///< of results.csv; empty: there is none
  QuantityRef quantity;      ///< unless it is time
  double low = 0, high = 0;  ///< over all steps, in the column's unit
  std::vector<double> rows;  ///< its values at the rows of every step that changes it, each once
};
MainCoordinate main_coordinate(const Prepared& scene);

/// The columns of a scene's results that are known before it is solved.
std::vector<std::string> known_columns(const Prepared& scene);

struct KeptNumber {
  std::string name;    ///< "knee.x_mm@30", "ACL.force_N@max"
  std::string column;  ///< of results.csv
  KeepDef::Row::Kind row = KeepDef::Row::Kind::value;
  double value = 0;  ///< of the main coordinate
};

/// The numbers that a study keeps, those of all `scenes` in order of their first appearance. In `out`: patterns that
/// name no column of any scene, values that a scene's main coordinate does not reach.
std::vector<KeptNumber> find_kept(const SweepDef& sweep, const std::vector<const Prepared*>& scenes, Diagnostics& out);

/// An event of the study's own and the numbers that tell it.
struct SweepEvent {
  std::string name;
  std::vector<std::size_t> kept;  ///< it happens where one of these is beyond the limit
  bool above = true;
  double limit = 0;
};

/// The events of a study. Numbers that they need and the study does not keep are added to `kept`. In `out`: as of
/// find_kept().
std::vector<SweepEvent> find_events(const SweepDef& sweep, const std::vector<const Prepared*>& scenes,
                                    std::vector<KeptNumber>& kept, Diagnostics& out);

/// The numbers of a scene's results; NaN where a row is not solved or a column is not there. Between two rows they are
/// interpolated linearly. Extremes and the last row are numbers of a `complete` run alone: of a part of it they would
/// be those of another range.
std::vector<double> kept_values(const std::vector<KeptNumber>& kept, const MainCoordinate& main,
                                const ResultTable& table, bool complete);

}  // namespace genu
