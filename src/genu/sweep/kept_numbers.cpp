#include "genu/sweep/kept_numbers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/results/columns.h"
#include "genu/results/motion_table.h"
#include "genu/results/pose_table.h"
#include "genu/scene/words.h"
#include "genu/study/run_motion.h"
#include "genu/sweep/statistics.h"
#include "genu/sweep/tolerances.h"

namespace genu {
namespace {

using RowKind = KeepDef::Row::Kind;

/// Flush the round-off of a prescribed value: it is a round number.
double round_value(double x) { return std::round(1e9 * x) / 1e9; }

MainCoordinate time_of(const Prepared& p) {
  MainCoordinate main;
  main.column = "time_s";
  main.high = p.scene.dynamics->duration;
  for (const double t : output_times(plan_motion(*p.scene.dynamics))) main.rows.push_back(round_value(t));
  return main;
}

/// The numbers of the solved rows; NaN in others.
std::vector<double> column_of(const ResultTable& table, const std::string& name) {
  std::vector<double> out;
  if (!table.has_column(name)) return out;
  const std::size_t column = table.column_index(name);
  const std::size_t status = table.has_column("status") ? table.column_index("status") : table.columns().size();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double* number = std::get_if<double>(&table.at(row, column));
    const bool solved = status == table.columns().size() || table.at(row, status) == Cell(std::string("ok"));
    out.push_back(solved && number != nullptr ? *number : kNoNumber);
  }
  return out;
}

double extreme(const std::vector<double>& y, bool largest) {
  double best = kNoNumber;
  for (const double v : y)
    if (std::isfinite(v) && (!std::isfinite(best) || (largest ? v > best : v < best))) best = v;
  return best;
}

/// y at the first rows between which x passes `value`.
double at_value(const std::vector<double>& x, const std::vector<double>& y, double value, double same) {
  for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k) {
    if (std::abs(x[k] - value) <= same) return y[k];
    if (k == 0 || !((x[k - 1] < value) == (value < x[k])) || !std::isfinite(x[k - 1])) continue;
    const double t = (value - x[k - 1]) / (x[k] - x[k - 1]);
    return y[k - 1] + t * (y[k] - y[k - 1]);
  }
  return kNoNumber;
}

const char* word(RowKind kind) { return kind == RowKind::last ? "last" : kind == RowKind::max ? "max" : "min"; }

/// Adds a number unless it is there; returns its place.
std::size_t add_number(std::vector<KeptNumber>& kept, const std::string& column, RowKind row, double value) {
  const std::string name = column + "@" + (row == RowKind::value ? fmt::format("{}", value) : word(row));
  const auto same = std::find_if(kept.begin(), kept.end(), [&](const KeptNumber& k) { return k.name == name; });
  const auto place = static_cast<std::size_t>(same - kept.begin());
  if (same == kept.end()) kept.push_back({name, column, row, value});
  return place;
}

/// Refuses values that the main coordinate of a scene does not reach; `first`: that of the first scene, whose rows
/// "all" means.
void check_row(const SweepDef& sweep, const std::string& key, const KeepDef::Row& row, const Prepared& scene,
               const MainCoordinate& main, const MainCoordinate& first, Diagnostics& out) {
  if (row.kind != RowKind::value && row.kind != RowKind::all) return;
  const double beyond = kSameRow * (main.high - main.low);
  const auto reached = [&](double value) { return value >= main.low - beyond && value <= main.high + beyond; };
  const auto refuse = [&](Code code, const std::string& found, const std::string& rule) {
    out.add(error_at({sweep.file, row.where}, code, key + ".at", found, rule));
  };
  if (main.column.empty())
    refuse(Code::not_applicable, {},
           R"(has no main coordinate to refer to: no step of the scene changes one. Use "last", "max" or "min")");
  else if (main.column != first.column)
    refuse(Code::conflict, {},
           fmt::format("means {} in the first scene and {} in {}: give scenes with different main coordinates studies "
                       "of their own",
                       first.column, main.column, scene.source.file));
  else if (row.kind == RowKind::all && !std::all_of(first.rows.begin(), first.rows.end(), reached))
    refuse(Code::out_of_range, "\"all\"",
           fmt::format("means rows of the first scene, from {:g} to {:g}, and {} of {} goes from {:g} to {:g}",
                       first.low, first.high, main.column, scene.source.file, main.low, main.high));
  else if (row.kind == RowKind::value && !reached(row.value))
    refuse(Code::out_of_range, fmt::format("{}", row.value),
           fmt::format("{} of {} goes from {:g} to {:g}", main.column, scene.source.file, main.low, main.high));
}

/// The scenes of a study, of whose columns its tables name some.
class Scenes {
 public:
  Scenes(const SweepDef& sweep, const std::vector<const Prepared*>& scenes) : sweep_(sweep), scenes_(scenes) {
    for (const Prepared* scene : scenes) {
      columns_.push_back(known_columns(*scene));
      mains_.push_back(main_coordinate(*scene));
    }
  }

  /// Adds what `keep` names to `kept`, in order of first appearance; returns the places. `key`: of the table.
  std::vector<std::size_t> add(const std::string& key, const KeepDef& keep, std::vector<KeptNumber>& kept,
                               Diagnostics& out) const {
    for (const KeepDef::Row& row : keep.rows)
      for (std::size_t s = 0; s < scenes_.size(); ++s)
        check_row(sweep_, key, row, *scenes_[s], mains_[s], mains_[0], out);
    std::vector<std::size_t> places;
    for (const KeepDef::Column& wanted : keep.columns) {
      const std::size_t before = places.size();
      for (const std::vector<std::string>& list : columns_)
        for (const std::string& column : list)
          if (matches(wanted.pattern, column) || matches(wanted.pattern, without_unit(column)))
            add_rows(column, keep.rows, kept, places);
      if (places.size() == before)
        out.add(error_at({sweep_.file, wanted.where}, Code::unknown_column,
                         key + (key == "keep" ? ".columns" : ".when"), with_quotes(wanted.pattern),
                         "is no column of results.csv" + did_you_mean(wanted.pattern, columns_.front())));
    }
    return places;
  }

 private:
  void add_rows(const std::string& column, const std::vector<KeepDef::Row>& rows, std::vector<KeptNumber>& kept,
                std::vector<std::size_t>& places) const {
    for (const KeepDef::Row& row : rows)
      if (row.kind == RowKind::all)
        for (const double value : mains_.front().rows)
          places.push_back(add_number(kept, column, RowKind::value, value));
      else
        places.push_back(add_number(kept, column, row.kind, row.value));
  }

  const SweepDef& sweep_;
  const std::vector<const Prepared*>& scenes_;
  std::vector<std::vector<std::string>> columns_;
  std::vector<MainCoordinate> mains_;
};

}  // namespace

MainCoordinate main_coordinate(const Prepared& p) {
  if (p.scene.dynamics) return time_of(p);
  MainCoordinate main;
  for (const StepPlan& step : p.steps)
    for (const StepPlan::Prescribed& c : step.prescribed) {
      const double from = round_value(shown_value(c.coordinate, c.from)),
                   to = round_value(shown_value(c.coordinate, c.to));
      const bool first = main.column.empty();
      if (first ? from == to : coordinate_column(p.scene, c.coordinate) != main.column) continue;
      if (first) {
        main.column = coordinate_column(p.scene, c.coordinate);
        main.quantity = c.coordinate;
        main.low = main.high = from;
      }
      for (int k = 0; k <= step.increments && from != to; ++k) {
        const double row = round_value(from + (to - from) * k / step.increments);
        if (std::find(main.rows.begin(), main.rows.end(), row) == main.rows.end()) main.rows.push_back(row);
      }
      main.low = std::min({main.low, from, to});
      main.high = std::max({main.high, from, to});
    }
  return main;
}

std::vector<std::string> known_columns(const Prepared& p) {
  std::vector<std::string> columns =
      (p.scene.dynamics ? motion_table(p.scene, p.model, {}) : pose_table(p.scene, p.model, p.steps, {})).columns();
  std::erase_if(columns, [](const std::string& c) {
    return c == "step" || c == "increment" || c == "status" || c == "stability";  // words and counts
  });
  return columns;
}

std::vector<KeptNumber> find_kept(const SweepDef& sweep, const std::vector<const Prepared*>& scenes, Diagnostics& out) {
  const Scenes all(sweep, scenes);
  std::vector<KeptNumber> kept;
  for (const KeepDef& keep : sweep.keep) all.add("keep", keep, kept, out);
  return kept;
}

std::vector<SweepEvent> find_events(const SweepDef& sweep, const std::vector<const Prepared*>& scenes,
                                    std::vector<KeptNumber>& kept, Diagnostics& out) {
  const Scenes all(sweep, scenes);
  std::vector<SweepEvent> events;
  for (const EventDef& event : sweep.events)
    events.push_back({event.name, all.add("event." + event.name, event.keep, kept, out), event.above, event.limit});
  return events;
}

std::vector<double> kept_values(const std::vector<KeptNumber>& kept, const MainCoordinate& main,
                                const ResultTable& table, bool complete) {
  const std::vector<double> x = column_of(table, main.column);
  const double same = kSameRow * (main.high - main.low);
  std::vector<double> out, y;
  std::string column;
  for (const KeptNumber& k : kept) {
    if (k.column != column) y = column_of(table, k.column), column = k.column;
    switch (k.row) {
      case RowKind::last:
        out.push_back(complete && !y.empty() ? y.back() : kNoNumber);
        break;
      case RowKind::max:
      case RowKind::min:
        out.push_back(complete ? extreme(y, k.row == RowKind::max) : kNoNumber);
        break;
      default:
        out.push_back(at_value(x, y, k.value, same));
    }
  }
  return out;
}

}  // namespace genu
