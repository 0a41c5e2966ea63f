#include "genu/run/sensitivity.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "genu/core/timer.h"
#include "genu/results/columns.h"
#include "genu/results/curves.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

constexpr int kMostContacts = 99;           // of one pair that can be named before the run has found them
constexpr std::size_t kMostRows = 5000000;  // of sensitivity.csv

bool names(const std::string& pattern, const std::string& column) {
  return pattern == "all" || matches(pattern, column) || matches(pattern, without_unit(column));
}

void refuse(Diagnostics& out, const char* option, const std::string& pattern, const std::string& why) {
  out.add({.file = {}, .key = option, .found = in_quotes(pattern), .rule = why});
}

/// Why a pattern names no output.
std::string no_output(const Prepared& prepared, const std::vector<Output>& known, const std::string& pattern) {
  std::vector<std::string> words;
  const ResultTable table = pose_table(prepared.scene, prepared.model, prepared.steps, {});
  for (const std::string& column : table.columns())
    if (const std::string why = why_not_smooth(column); !why.empty() && names(pattern, column))
      return "matches " + column + ", which " + why;
  for (const Output& o : known) words.insert(words.end(), {o.column, without_unit(o.column)});
  return "is no output of this scene" + did_you_mean(pattern, words) +
         " (outputs are the columns of results.csv, with or without the unit)";
}

void choose_outputs(const Prepared& prepared, const std::vector<std::string>& patterns, int contact_numbers,
                    std::vector<Output>& chosen, Diagnostics& out) {
  const std::vector<Output> known = outputs_of(prepared.scene, prepared.model, prepared.steps, contact_numbers);
  std::vector<bool> wanted(known.size());
  for (const std::string& pattern : patterns) {
    bool found = false;
    for (std::size_t k = 0; k < known.size(); ++k) {
      if (!names(pattern, known[k].column)) continue;
      wanted[k] = found = true;
    }
    if (!found) refuse(out, "--of", pattern, no_output(prepared, known, pattern));
  }
  for (std::size_t k = 0; k < known.size(); ++k)
    if (wanted[k]) chosen.push_back(known[k]);
}

void choose_parameters(const Scene& scene, const std::vector<std::string>& patterns, std::vector<Parameter>& chosen,
                       Diagnostics& out) {
  const std::vector<Parameter> known = parameters_of(scene);
  std::vector<std::string> words;
  for (const Parameter& p : known) words.push_back(p.name);
  std::vector<bool> wanted(known.size());
  for (const std::string& pattern : patterns) {
    bool found = false;
    for (std::size_t k = 0; k < known.size(); ++k) {
      if (pattern != "all" && !matches(pattern, known[k].name)) continue;
      wanted[k] = found = true;
    }
    if (!found) refuse(out, "--to", pattern, "is no parameter of this scene" + did_you_mean(pattern, words));
  }
  for (std::size_t k = 0; k < known.size(); ++k)
    if (wanted[k]) chosen.push_back(known[k]);
}

int contacts_made(const Solution& solution) {
  int most = 0;
  for (const PoseRecord& record : solution.records)
    for (const int number : record.point.pose.last_number) most = std::max(most, number);
  return most;
}

/// Of the numbered columns only those of results.csv.
void drop_contacts_not_made(const ResultTable& poses, std::vector<Output>& outputs) {
  std::erase_if(outputs, [&](const Output& o) { return o.contact_number > 0 && !poses.has_column(o.column); });
}

std::size_t rows_asked(const Prepared& prepared) {
  std::size_t asked = 1;
  for (const StepPlan& step : prepared.steps) asked += static_cast<std::size_t>(step.increments);
  return asked;
}

bool too_many(const Prepared& prepared, const SensitivityRows& rows, Diagnostics& out) {
  const auto counted =
      std::count_if(rows.outputs.begin(), rows.outputs.end(), [](const Output& o) { return o.contact_number == 0; });
  const std::size_t count = rows_asked(prepared) * static_cast<std::size_t>(counted) * rows.parameters.size();
  if (count <= kMostRows) return false;
  out.add({.file = {},
           .key = {},
           .found = {},
           .rule = fmt::format("{} poses, {} outputs and {} parameters make {} derivatives, at most {} are computed at "
                               "once: ask for fewer",
                               rows_asked(prepared), counted, rows.parameters.size(), count, kMostRows)});
  return true;
}

std::string facts(const SensitivityChoice& choice, const SensitivityResult& r) {
  std::string out =
      fmt::format("  {:<12}{} poses, {} outputs, {} parameters: {} derivatives in {:.3f} s\n", "derivatives",
                  r.rows.rows(), r.rows.outputs.size(), r.rows.parameters.size(), r.rows.derivatives.size(), r.seconds);
  for (const std::string& pattern : choice.outputs)
    if (std::none_of(r.rows.outputs.begin(), r.rows.outputs.end(),
                     [&](const Output& o) { return names(pattern, o.column); }))
      out += fmt::format("  {:<12}{}: no contact of that number was made\n", "", pattern);
  if (r.poses_without > 0)
    out += fmt::format(
        "  {:<12}{} of {} poses have no derivative (not solved, not determined, or J is singular): their "
        "cells are empty\n",
        "", r.poses_without, r.rows.rows());
  return out;
}

}  // namespace

SensitivityRows choose(const Prepared& prepared, const SensitivityChoice& choice, int contact_numbers,
                       Diagnostics& out) {
  SensitivityRows rows;
  choose_outputs(prepared, choice.outputs, contact_numbers, rows.outputs, out);
  choose_parameters(prepared.scene, choice.parameters, rows.parameters, out);
  return rows;
}

void differentiate(const Prepared& prepared, const SensitivityChoice& choice, SensitivityResult& result) {
  const ScopedTimer timing(result.seconds);
  Diagnostics said_before;
  result.rows = choose(prepared, choice, contacts_made(result.solution), said_before);
  SensitivityRows& rows = result.rows;
  drop_contacts_not_made(result.solution.poses, rows.outputs);
  const std::size_t parameters = rows.parameters.size(), one = rows.outputs.size() * parameters;
  rows.derivatives.assign(result.solution.records.size() * one, std::numeric_limits<double>::quiet_NaN());
  Sensitivity sensitivity(prepared.scene, prepared.model);
  for (std::size_t row = 0; row < result.solution.records.size(); ++row) {
    const PosePoint& point = result.solution.records[row].point;
    if (!sensitivity.factor(point)) {
      ++result.poses_without;
      continue;
    }
    for (std::size_t p = 0; p < parameters; ++p) {
      sensitivity.differentiate(rows.parameters[p]);
      for (std::size_t o = 0; o < rows.outputs.size(); ++o)
        rows.derivatives[row * one + o * parameters + p] =
            rows.outputs[o].rate(point, sensitivity) * rows.outputs[o].shown * rows.parameters[p].si;
    }
  }
}

int run_sensitivity(const std::string& path, const std::optional<std::string>& folder, const SensitivityChoice& choice,
                    const RunOptions& options, Diagnostics& out, SensitivityResult& result) {
  const auto prepared = prepare_run(path, folder, out);
  if (!prepared) return kExitRefused;
  const SensitivityRows asked = choose(*prepared, choice, kMostContacts, out);
  if (out.has_errors() || too_many(*prepared, asked, out)) return kExitRefused;
  ContactField field(prepared->model);
  if (!check_start(*prepared, field, out)) return kExitRefused;
  result.solution = solve(*prepared, field, options);
  differentiate(*prepared, choice, result);
  const Scene& scene = prepared->scene;
  const auto& steps = prepared->steps;
  const Solution& solution = result.solution;
  result.text = ranking_text(result.rows, scene, steps, solution.poses, choice.most) + facts(choice, result);
  if (!folder) return solution.summary.exit_code;
  result.solution.folder = folder_for(*folder, options, result.solution.summary);
  const Chart chart = sensitivity_chart(result.rows, curves(scene, steps, solution.poses, solution.events));
  const std::string error =
      write_results(solution.folder, *prepared, solution,
                    {{"sensitivity.csv", sensitivity_csv(result.rows, scene, steps, solution.poses)},
                     {"ranking.csv", ranking_table(result.rows, scene, steps, solution.poses).to_csv()},
                     {"sensitivity.svg", to_svg(chart)}});
  if (error.empty()) return solution.summary.exit_code;
  out.add({.file = {}, .key = {}, .found = {}, .rule = error});
  return kExitFailed;
}

}  // namespace genu
