#include "genu/results/sensitivity_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/results/columns.h"
#include "genu/results/tolerances.h"

namespace genu {
namespace {

constexpr std::size_t kMostPanels = 12, kMostLines = 6, kMostOutputs = 12;

bool varies(const StepPlan& step) {
  return std::any_of(step.prescribed.begin(), step.prescribed.end(), [](const auto& p) { return p.from != p.to; });
}

/// The columns of `poses` that say where on the path a row is: what is prescribed, and where a step does not drive any
/// of that, the load factors, and the time that loads follow.
std::vector<std::string> place_columns(const SceneTables& scene, const std::vector<StepPlan>& steps,
                                       const ResultTable& poses) {
  std::vector<std::string> out;
  for (const StepPlan& step : steps) {
    for (const auto& p : step.prescribed) {
      const std::string name = coordinate_column(scene, p.coordinate);
      if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
    }
  }
  if (std::all_of(steps.begin(), steps.end(), varies)) return out;
  for (const LoadDef& load : scene.loads)
    if (const std::string name = load.name + ".factor"; poses.has_column(name)) out.push_back(name);
  if (std::any_of(scene.loads.begin(), scene.loads.end(), [](const LoadDef& l) { return l.in_time(); }) &&
      poses.has_column("time_s"))
    out.push_back("time_s");
  return out;
}

std::string unit_of(const Output& output, const Parameter& parameter) {
  return parameter.unit == "1" ? output.unit : output.unit + " per " + parameter.unit;
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.17g}", value) : std::string(); }

/// Whether two parameters do the same to an output at every pose.
bool alike(const SensitivityRows& rows, std::size_t output, const RankedParameter& a, const RankedParameter& b) {
  for (std::size_t row = 0; row < rows.rows(); ++row) {
    const double x = rows.effect(row, output, a.parameter), y = rows.effect(row, output, b.parameter);
    if (std::isfinite(x) != std::isfinite(y) || std::abs(x - y) > kSameEffect * std::abs(a.largest)) return false;
  }
  return true;
}

std::vector<RankedParameter> grouped(const SensitivityRows& rows, std::size_t output,
                                     const std::vector<RankedParameter>& sorted) {
  std::vector<RankedParameter> out;
  for (const RankedParameter& r : sorted) {
    const auto same = std::find_if(out.rbegin(), out.rend(), [&](const RankedParameter& group) {
      return kNearEffect * std::abs(group.largest) <= std::abs(r.largest) && alike(rows, output, group, r);
    });
    if (same == out.rend())
      out.push_back(r);
    else
      same->alike.push_back(r.parameter);
  }
  return out;
}

std::string names_of(const SensitivityRows& rows, const std::vector<std::size_t>& parameters) {
  constexpr std::size_t kMost = 6;
  std::string out;
  for (std::size_t k = 0; k < std::min(kMost, parameters.size()); ++k)
    out += (k == 0 ? "" : ", ") + rows.parameters[parameters[k]].name;
  return parameters.size() > kMost ? out + fmt::format(" and {} more", parameters.size() - kMost) : out;
}

struct RankedLine {
  std::string name, change, effect, rms, place, below;
};

/// Lines with their rank, from 1, columns under each other.
std::string aligned(const std::vector<RankedLine>& lines) {
  std::size_t name = 0, change = 0, effect = 0, rms = 0, rank = 0;
  for (const RankedLine& l : lines) {
    name = std::max(name, l.name.size()), change = std::max(change, l.change.size());
    effect = std::max(effect, l.effect.size()), rms = std::max(rms, l.rms.size());
  }
  std::string out;
  for (const RankedLine& l : lines)
    out += fmt::format("  {:>3}  {:<{}}  {:>{}}  {:>{}}  {:<{}}  {}\n{}", ++rank, l.name, name, l.change, change,
                       l.effect, effect, l.rms, rms, l.place, l.below);
  return out;
}

}  // namespace

std::vector<RankedParameter> ranking(const SensitivityRows& rows, std::size_t output) {
  std::vector<RankedParameter> out;
  for (std::size_t p = 0; p < rows.parameters.size(); ++p) {
    RankedParameter ranked;
    ranked.parameter = p;
    double squares = 0;
    int count = 0;
    for (std::size_t row = 0; row < rows.rows(); ++row) {
      const double effect = rows.effect(row, output, p);
      if (!std::isfinite(effect)) continue;
      squares += effect * effect;
      ++count;
      if (std::abs(effect) <= std::abs(ranked.largest)) continue;
      ranked.largest = effect;
      ranked.row = row;
    }
    if (ranked.largest == 0) continue;
    ranked.mean_size = std::sqrt(squares / count);
    out.push_back(ranked);
  }
  std::stable_sort(out.begin(), out.end(), [](const RankedParameter& a, const RankedParameter& b) {
    return std::abs(a.largest) > std::abs(b.largest);
  });
  std::erase_if(
      out, [&](const RankedParameter& r) { return std::abs(r.largest) < kEffectRounding * std::abs(out[0].largest); });
  return grouped(rows, output, out);
}

std::string sensitivity_csv(const SensitivityRows& rows, const SceneTables& scene, const std::vector<StepPlan>& steps,
                            const ResultTable& poses) {
  std::string out = "step,increment";
  const std::vector<std::string> places = place_columns(scene, steps, poses);
  for (const std::string& name : places) out += "," + name;
  out += ",output,parameter,derivative,unit,change,effect\n";
  for (std::size_t row = 0; row < rows.rows(); ++row) {
    std::string start = fmt::format("{},{}", poses.number(row, "step"), poses.number(row, "increment"));
    for (const std::string& name : places) start += "," + number(poses.number(row, name));
    for (std::size_t o = 0; o < rows.outputs.size(); ++o) {
      for (std::size_t p = 0; p < rows.parameters.size(); ++p) {
        const Parameter& parameter = rows.parameters[p];
        out += fmt::format("{},{},{},{},{},{},{}\n", start, rows.outputs[o].column, parameter.name,
                           number(rows.derivative(row, o, p)), unit_of(rows.outputs[o], parameter),
                           parameter.change_text, number(rows.effect(row, o, p)));
      }
    }
  }
  return out;
}

ResultTable ranking_table(const SensitivityRows& rows, const SceneTables& scene, const std::vector<StepPlan>& steps,
                          const ResultTable& poses) {
  ResultTable table;
  const std::vector<std::string> places = place_columns(scene, steps, poses);
  for (const char* name :
       {"output", "rank", "parameter", "change", "largest_effect", "rms_effect", "step", "increment"})
    table.add_column(name);
  for (const std::string& name : places) table.add_column(name);
  for (std::size_t o = 0; o < rows.outputs.size(); ++o) {
    long rank = 0;
    for (const RankedParameter& r : ranking(rows, o)) {
      std::vector<std::size_t> group = {r.parameter};
      group.insert(group.end(), r.alike.begin(), r.alike.end());
      ++rank;
      for (const std::size_t parameter : group) {
        table.add_row();
        table.set("output", rows.outputs[o].column);
        table.set("rank", rank);
        table.set("parameter", rows.parameters[parameter].name);
        table.set("change", rows.parameters[parameter].change_text);
        table.set("largest_effect", r.largest);
        table.set("rms_effect", r.mean_size);
        table.set("step", poses.at(r.row, poses.column_index("step")));
        table.set("increment", poses.at(r.row, poses.column_index("increment")));
        for (const std::string& name : places) table.set(name, poses.number(r.row, name));
      }
    }
  }
  return table;
}

std::string ranking_text(const SensitivityRows& rows, const SceneTables& scene, const std::vector<StepPlan>& steps,
                         const ResultTable& poses, std::size_t most) {
  std::string out;
  const std::vector<std::string> places = place_columns(scene, steps, poses);
  for (std::size_t o = 0; o < std::min(kMostOutputs, rows.outputs.size()); ++o) {
    const std::vector<RankedParameter> ranked = ranking(rows, o);
    const std::string unit = rows.outputs[o].unit == "1" ? "" : " " + rows.outputs[o].unit;
    out += fmt::format("{}: what one standard change of a parameter does to it, largest along the path\n",
                       rows.outputs[o].column);
    if (ranked.empty()) out += "  no parameter asked for changes it\n";
    std::vector<RankedLine> lines;
    for (std::size_t k = 0; k < std::min(most, ranked.size()); ++k) {
      const RankedParameter& r = ranked[k];
      std::string place;
      for (const std::string& name : places) {
        const double value = poses.number(r.row, name);
        if (!std::isfinite(value)) continue;
        place += fmt::format("{} {} = {:.4g}", place.empty() ? "at" : ",", name, std::abs(value) < 1e-9 ? 0 : value);
      }
      const Parameter& p = rows.parameters[r.parameter];
      lines.push_back({p.name, p.change_text, fmt::format("{:+.5g}{}", r.largest, unit),
                       fmt::format("(rms {:.4g})", r.mean_size), place,
                       r.alike.empty() ? "" : fmt::format("       and so does {}\n", names_of(rows, r.alike))});
    }
    out += aligned(lines);
    if (ranked.size() > most) out += fmt::format("       and {} more\n", ranked.size() - most);
    out += "\n";
  }
  if (rows.outputs.size() > kMostOutputs)
    out += fmt::format("and {} more outputs: ranking.csv has them all\n\n", rows.outputs.size() - kMostOutputs);
  return out;
}

Chart sensitivity_chart(const SensitivityRows& rows, const Chart& axis) {
  Chart chart;
  chart.title = axis.title + ": effects of one standard change";
  chart.x_title = axis.x_title;
  chart.x = axis.x;
  for (std::size_t o = 0; o < rows.outputs.size() && chart.panels.size() < kMostPanels; ++o) {
    const Output& output = rows.outputs[o];
    const bool pure = output.unit == "1";  // strains: in thousandths, or they would be too small to see
    ChartPanel panel;
    panel.title = fmt::format("{} [{}]", without_unit(output.column), pure ? "1/1000" : output.unit);
    panel.from_zero = true;
    for (const RankedParameter& r : ranking(rows, o)) {
      if (panel.series.size() == kMostLines) break;
      ChartSeries series{rows.parameters[r.parameter].name, {}};
      if (!r.alike.empty()) series.name += fmt::format(" (and {} alike)", r.alike.size());
      for (std::size_t row = 0; row < rows.rows(); ++row)
        series.y.push_back((pure ? 1e3 : 1) * rows.effect(row, o, r.parameter));
      panel.series.push_back(std::move(series));
    }
    if (!panel.series.empty()) chart.panels.push_back(std::move(panel));
  }
  return chart;
}

}  // namespace genu
