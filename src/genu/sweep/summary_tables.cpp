#include "genu/sweep/summary_tables.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "genu/sweep/statistics.h"
#include "genu/sweep/sweep_def.h"
#include "genu/sweep/tolerances.h"

namespace genu {
namespace {

using nlohmann::ordered_json;

struct Percentile {
  const char* name;
  double q;
};
constexpr std::array kPercentiles = {Percentile{"p5", 0.05}, Percentile{"p25", 0.25}, Percentile{"p50", 0.5},
                                     Percentile{"p75", 0.75}, Percentile{"p95", 0.95}};

ResultTable table_with(std::initializer_list<const char*> columns) {
  ResultTable table;
  for (const char* column : columns) table.add_column(column);
  return table;
}

void set_case(ResultTable& table, const SweepTable& sweep, std::size_t c) {
  table.add_row();
  table.set("scene", sweep.record.cases[c].scene);
  table.set("what_if", sweep.record.cases[c].what_if);
}

std::vector<double> sorted_of(const std::vector<double>& values) {
  std::vector<double> sorted = finite_of(values);
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

/// Low and high ends of an interval of an estimate. A design that is no random sample estimates nothing: none there.
void set_interval(ResultTable& table, const SweepTable& sweep, const std::string& before, const Interval& interval) {
  if (!sweep.record.random) return;
  table.set(before + "low", interval.low);
  table.set(before + "high", interval.high);
}

void set_statistics(ResultTable& table, const SweepTable& sweep, const std::vector<double>& values) {
  const Moments m = moments(values);
  const std::vector<double> sorted = sorted_of(values);
  table.set("n", static_cast<long>(m.count));
  table.set("mean", m.mean);
  set_interval(table, sweep, "mean_", m.mean_95);
  table.set("sd", m.sd);
  if (!sorted.empty()) table.set("min", sorted.front());
  if (!sorted.empty()) table.set("max", sorted.back());
  for (const auto& [name, q] : kPercentiles) {
    table.set(name, quantile(sorted, q));
    set_interval(table, sweep, std::string(name) + "_", quantile_interval(sorted, q));
  }
}

std::uint64_t count_class(const SweepTable::Case& in, const char* name) {
  return static_cast<std::uint64_t>(std::count(in.classes.begin(), in.classes.end(), name));
}

std::uint64_t count_jumped(const SweepTable::Case& in) {
  return static_cast<std::uint64_t>(std::count_if(in.jumps.begin(), in.jumps.end(), [](double j) { return j > 0; }));
}

/// Whether an event happens in a sample: one of its numbers is beyond the limit, or none of them is. Empty where there
/// is none of them; a case without a ligament lacks its columns alone.
std::optional<bool> happens_in(const SweepEvent& event, const SweepTable::Case& in, std::size_t sample) {
  bool known = false;
  for (const std::size_t k : event.kept) {
    const double value = in.kept[k][sample];
    if (event.above ? value > event.limit : value < event.limit) return true;
    known = known || std::isfinite(value);
  }
  return known ? std::optional(false) : std::nullopt;
}

ordered_json rows_of(const ResultTable& table) {
  ordered_json rows = ordered_json::array();
  for (std::size_t r = 0; r < table.rows(); ++r) {
    ordered_json row;
    for (std::size_t c = 0; c < table.columns().size(); ++c) {
      const Cell& cell = table.at(r, c);
      if (const auto* number = std::get_if<double>(&cell)) row[table.columns()[c]] = *number;
      if (const auto* count = std::get_if<long>(&cell)) row[table.columns()[c]] = *count;
      if (const auto* word = std::get_if<std::string>(&cell)) row[table.columns()[c]] = *word;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::vector<double> difference(const SweepTable& sweep, std::size_t c, std::size_t k) {
  std::vector<double> out = sweep.cases[c].kept[k];
  const std::vector<double>& from = sweep.cases[sweep.cases[c].reference].kept[k];
  for (std::size_t s = 0; s < out.size(); ++s) out[s] -= from[s];
  return out;
}

ResultTable statistics_table(const SweepTable& sweep) {
  ResultTable table =
      table_with({"scene", "what_if", "number", "n", "mean", "mean_low", "mean_high", "sd", "min", "max"});
  for (const auto& [name, q] : kPercentiles)
    for (const char* end : {"", "_low", "_high"}) table.add_column(std::string(name) + end);
  const auto add = [&](std::size_t c, std::size_t k, const std::string& what_if, const std::vector<double>& values) {
    set_case(table, sweep, c);
    table.set("what_if", what_if);
    table.set("number", sweep.record.kept[k].name);
    set_statistics(table, sweep, sweep.independent(values));
  };
  for (std::size_t c = 0; c < sweep.cases.size(); ++c)
    for (std::size_t k = 0; k < sweep.record.kept.size(); ++k)
      add(c, k, sweep.record.cases[c].what_if, sweep.cases[c].kept[k]);
  for (std::size_t c = 0; c < sweep.cases.size(); ++c)
    for (std::size_t k = 0; sweep.cases[c].reference != c && k < sweep.record.kept.size(); ++k)
      add(c, k, sweep.record.cases[c].what_if + " - " + sweep.record.cases[sweep.cases[c].reference].what_if,
          difference(sweep, c, k));
  return table;
}

ResultTable event_probabilities(const SweepTable& sweep) {
  ResultTable table = table_with({"scene", "what_if", "event", "count", "n", "probability", "low", "high"});
  for (std::size_t c = 0; c < sweep.cases.size(); ++c) {
    const SweepTable::Case& in = sweep.cases[c];
    const auto add = [&](const std::string& event, const auto& has) {  // has: whether it happens; empty: unknown
      std::uint64_t n = 0, count = 0;
      for (std::size_t s = 0; s < in.classes.size(); ++s) {
        const std::optional<bool> happens = sweep.repeats_draws(s) ? std::nullopt : has(s);
        if (happens) ++n, count += *happens ? 1 : 0;
      }
      set_case(table, sweep, c);
      table.set("event", event);
      table.set("count", static_cast<long>(count));
      table.set("n", static_cast<long>(n));
      table.set("probability", static_cast<double>(count) / static_cast<double>(n));
      set_interval(table, sweep, "", probability_interval(count, n));
    };
    add("jumped", [&](std::size_t s) { return std::optional(in.jumps[s] > 0); });
    for (const char* name : {"doubtful", "not_solved", "refused"})
      add(name, [&](std::size_t s) { return std::optional(in.classes[s] == name); });
    for (const SweepEvent& event : sweep.record.events)
      add(event.name, [&](std::size_t s) { return happens_in(event, in, s); });
  }
  return table;
}

ResultTable rank_table(const SweepTable& sweep) {
  ResultTable table = table_with({"scene", "what_if", "number", "factor", "n", "rank_correlation", "low", "high"});
  std::vector<Ordered> draws;
  for (const std::vector<double>& of_factor : sweep.draws) draws.emplace_back(sweep.independent(of_factor));
  for (std::size_t c = 0; c < sweep.cases.size(); ++c)
    for (std::size_t k = 0; k < sweep.record.kept.size(); ++k) {
      const Ordered values(sweep.independent(sweep.cases[c].kept[k]));
      for (std::size_t f = 0; f < draws.size(); ++f) {
        const std::size_t n = values.order.size();
        const double rank = sweep.record.is_mesh_error(f) ? kNoNumber : rank_correlation(draws[f], values);
        set_case(table, sweep, c);
        table.set("number", sweep.record.kept[k].name);
        table.set("factor", sweep.record.factors[f]);
        table.set("n", static_cast<long>(n));
        table.set("rank_correlation", rank);
        set_interval(table, sweep, "", rank_correlation_interval(rank, n));
      }
    }
  return table;
}

ResultTable index_table(const SweepTable& sweep) {
  ResultTable table =
      table_with({"scene", "what_if", "number", "factor", "blocks", "first", "first_error", "total", "total_error"});
  if (sweep.record.block < 2) return table;
  for (std::size_t c = 0; c < sweep.cases.size(); ++c)
    for (std::size_t k = 0; k < sweep.record.kept.size(); ++k) {
      const std::vector<SobolIndex> indices = sobol_indices(sweep.cases[c].kept[k], sweep.record.factors.size());
      for (std::size_t f = 0; f < indices.size(); ++f) {
        set_case(table, sweep, c);
        table.set("number", sweep.record.kept[k].name);
        table.set("factor", sweep.record.factors[f]);
        table.set("blocks", static_cast<long>(indices[f].blocks));
        table.set("first", indices[f].first);
        table.set("first_error", indices[f].first_error);
        table.set("total", indices[f].total);
        table.set("total_error", indices[f].total_error);
      }
    }
  return table;
}

ResultTable convergence_table(const SweepTable& sweep) {
  ResultTable table = table_with({"scene", "what_if", "number", "samples", "n", "mean", "sd", "p5", "p50", "p95"});
  if (!sweep.record.random) return table;
  for (std::size_t c = 0; c < sweep.cases.size(); ++c)
    for (std::size_t k = 0; k < sweep.record.kept.size(); ++k) {
      const std::vector<double> all = sweep.independent(sweep.cases[c].kept[k]);
      for (std::size_t n = std::min(kLeastConvergence, all.size());; n = std::min(2 * n, all.size())) {
        const std::vector<double> some(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n));
        const Moments m = moments(some);
        const std::vector<double> sorted = sorted_of(some);
        set_case(table, sweep, c);
        table.set("number", sweep.record.kept[k].name);
        table.set("samples", static_cast<long>(n));
        table.set("n", static_cast<long>(m.count));
        table.set("mean", m.mean);
        table.set("sd", m.sd);
        table.set("p5", quantile(sorted, 0.05));
        table.set("p50", quantile(sorted, 0.5));
        table.set("p95", quantile(sorted, 0.95));
        if (n == all.size()) break;
      }
    }
  return table;
}

SweepTables tables_of(const SweepTable& sweep) {
  return {statistics_table(sweep), event_probabilities(sweep), rank_table(sweep), index_table(sweep),
          convergence_table(sweep)};
}

std::size_t SweepTables::statistics_row(const SweepTable& sweep, std::size_t c, std::size_t k) {
  return c * sweep.record.kept.size() + k;
}

std::size_t SweepTables::factor_row(const SweepTable& sweep, std::size_t c, std::size_t k, std::size_t f) {
  return statistics_row(sweep, c, k) * sweep.record.factors.size() + f;
}

std::string summary_json(const SweepTable& sweep, const SweepTables& tables) {
  const SweepRecord& r = sweep.record;
  ordered_json j = {{"study", r.study},   {"title", r.title}, {"version", r.version}, {"hash", r.hash},
                    {"design", r.design}, {"seed", r.seed},   {"samples", r.samples}, {"factors", r.factors}};
  j["cases"] = ordered_json::array();
  for (std::size_t c = 0; c < r.cases.size(); ++c)
    j["cases"].push_back({{"scene", r.cases[c].scene},
                          {"what_if", r.cases[c].what_if},
                          {"solved", count_class(sweep.cases[c], "solved")},
                          {"doubtful", count_class(sweep.cases[c], "doubtful")},
                          {"not_solved", count_class(sweep.cases[c], "not_solved")},
                          {"refused", count_class(sweep.cases[c], "refused")},
                          {"jumped", count_jumped(sweep.cases[c])}});
  j["events"] = rows_of(tables.events);
  j["statistics"] = rows_of(tables.statistics);
  if (r.block > 1) j["sobol_indices"] = rows_of(tables.indices);
  return j.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string summary_text(const SweepTable& sweep, const SweepTables& tables) {
  constexpr std::size_t kRowsShown = 12;
  std::string text;
  for (std::size_t c = 0; c < sweep.cases.size(); ++c) {
    const SweepTable::Case& in = sweep.cases[c];
    text +=
        fmt::format("{}: {} samples, {} solved, {} doubtful, {} not solved, {} refused; {} jumped\n",
                    sweep.case_name(c), sweep.record.samples, count_class(in, "solved"), count_class(in, "doubtful"),
                    count_class(in, "not_solved"), count_class(in, "refused"), count_jumped(in));
  }
  const ResultTable& table = tables.statistics;
  std::vector<std::string> columns = {"number", "n", "mean", "sd", "p5", "p50", "p95"};
  if (sweep.cases.size() > 1) columns.insert(columns.begin(), {"scene", "what_if"});
  text += "\n" + to_text(table, columns, 3, kRowsShown);
  if (table.rows() > kRowsShown)
    text += fmt::format("  {} of {} rows; all are in statistics.csv\n", kRowsShown, table.rows());
  return text;
}

}  // namespace genu
