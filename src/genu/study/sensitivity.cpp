#include "genu/study/sensitivity.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include <fmt/format.h>

#include "genu/assemble/refuse_option.h"
#include "genu/assemble/with_numbers.h"
#include "genu/core/timer.h"
#include "genu/law/laws.h"
#include "genu/results/columns.h"
#include "genu/results/curves.h"
#include "genu/scene/words.h"
#include "genu/study/run_motion.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

bool names(const std::string& pattern, const std::string& column) {
  return pattern == "all" || matches(pattern, column) || matches(pattern, without_unit(column));
}

/// The layer whose number a column of results.csv is; null for any other column.
const LayerDef* layer_of(const SceneTables& scene, const std::string& column) {
  for (const LayerDef& layer : scene.layers)
    if (column.starts_with(layer.pair.name + ".")) return &layer;
  return nullptr;
}

/// The layer that a parameter's surface is pressed by; null for any other parameter.
const LayerDef* layer_of(const SceneTables& scene, const Parameter& p) {
  for (const LayerDef& layer : scene.layers)
    if (p.of_surface() && (layer.pair.surface_a == p.object || layer.pair.surface_b == p.object)) return &layer;
  return nullptr;
}

/// Why a pattern names no output.
std::string no_output(const Prepared& prepared, const std::vector<Output>& known, const std::string& pattern) {
  std::vector<std::string> words;
  const ResultTable table = pose_table(prepared.scene, prepared.model, prepared.steps, {});
  for (const std::string& column : table.columns())
    if (names(pattern, column) && layer_of(prepared.scene, column) != nullptr)
      return "matches " + column +
             ", a number of an elastic layer: none of them has an exact derivative here. Coordinates, ligaments and "
             "reactions of a scene with layers have";
  for (const std::string& column : table.columns())
    if (const std::string why = why_not_smooth(column); !why.empty() && names(pattern, column))
      return "matches " + column + ", which " + why;
  for (const std::string& column : table.columns())
    if (names(pattern, column)) return "matches " + column + ", which has no exact derivative here";
  for (const Output& o : known) words.insert(words.end(), {o.column, without_unit(o.column)});
  return "is no output of this scene" + did_you_mean(pattern, words) +
         " (outputs are the columns of results.csv, with or without the unit)";
}

/// What a parameter's object is called, in the plural; "" for what is prescribed.
const char* kind_of_object(const Parameter& p) {
  if (p.of_ligament()) return "ligaments";
  if (p.of_surface()) return "surfaces";
  if (p.of_load()) return "loads";
  if (p.of_joint()) return "joints";
  if (p.of_bushing()) return "bushings";
  return p.kind == Parameter::Kind::prescribed ? "" : "bodies";
}

/// Calls f(row) for each number of surfaces, loads, bodies, joints and bushings.
template <class F>
void for_tables(const F& f) {
  const auto of = [&](const auto& kinds) {
    for (const auto& kind : kinds)
      for (const auto& number : kind.numbers) f(number.row);
  };
  of(kSurfaceKinds);
  of(kLoadKinds);
  of(kBodyKinds);
  of(kJointKinds);
  of(kBushingKinds);
}

/// Why a pattern names no parameter: what the objects that it names have, those of ligaments alone where it asks for a
/// key that only ligaments can have.
std::string no_parameter(const SceneTables& scene, const std::vector<Parameter>& known, const std::string& pattern) {
  for (const Parameter& p : parameters_of(scene))
    if (const LayerDef* layer = layer_of(scene, p); layer != nullptr && matches(pattern, p.name))
      return fmt::format("matches {}, on a surface that the elastic layer {} presses: there are no derivatives to it",
                         p.name, layer->pair.name);
  std::vector<std::string> of_ligaments = law_keys();
  for_tables([&](const NumberRow& row) { std::erase(of_ligaments, row.key); });  // others have it too
  for (const char* word : {"slack_length", "reference_strain", "reference_force", "from", "to", "via"})
    of_ligaments.emplace_back(word);
  const auto object_of = [](const std::string& name) { return name.substr(0, name.find('.')); };
  const auto key_of = [](const std::string& name) { return name.substr(std::min(name.size(), name.find('.') + 1)); };
  const std::string object = object_of(pattern), key = pattern.find('.') == std::string::npos ? "" : key_of(pattern);
  const bool ligaments_only = std::find(of_ligaments.begin(), of_ligaments.end(), object_of(key)) != of_ligaments.end();
  std::vector<std::string> words, kinds;
  std::vector<std::vector<std::string>> keys;  // of each kind
  for (const Parameter& p : known) {
    words.push_back(p.name);
    const std::string kind = kind_of_object(p), own = key_of(p.name);
    if (kind.empty() || (ligaments_only && kind != "ligaments") || !matches(object, object_of(p.name))) continue;
    const auto place = std::find(kinds.begin(), kinds.end(), kind);
    const auto k = static_cast<std::size_t>(place - kinds.begin());
    if (place == kinds.end()) {
      kinds.push_back(kind);
      keys.emplace_back();
    }
    if (std::find(keys[k].begin(), keys[k].end(), own) == keys[k].end()) keys[k].push_back(own);
  }
  std::string out = "is no parameter of this scene" + did_you_mean(pattern, words);
  for (std::size_t k = 0; k < kinds.size() && !key.empty(); ++k) {
    constexpr std::size_t kKeysNamed = 12;
    std::string list;
    for (std::size_t i = 0; i < std::min(kKeysNamed, keys[k].size()); ++i) list += (i == 0 ? "" : ", ") + keys[k][i];
    out += fmt::format("; its {} have {}{}", kinds[k], list, keys[k].size() > kKeysNamed ? ", ..." : "");
  }
  return out;
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
    if (!found) refuse_option(out, Code::unknown_name, "--of", pattern, no_output(prepared, known, pattern));
  }
  for (std::size_t k = 0; k < known.size(); ++k)
    if (wanted[k]) chosen.push_back(known[k]);
}

constexpr const char* kTogether = ":together";

/// Marks what a pattern names in `wanted`, or refuses it.
void mark_parameters(const SceneTables& scene, const std::vector<Parameter>& known, const std::string& pattern,
                     std::vector<bool>& wanted, Diagnostics& out) {
  bool found = false;
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (pattern != "all" && !matches(scene, pattern, known[k].name)) continue;
    wanted[k] = found = true;
  }
  if (!found) refuse_option(out, Code::unknown_name, "--to", pattern, no_parameter(scene, known, pattern));
}

/// The one parameter that moves all of `members`, each by its standard change.
Parameter bundle_of(const std::string& name, const std::vector<Parameter>& members) {
  Parameter bundle;
  bundle.name = name;
  bundle.unit = "1";
  bundle.change = 1;
  const bool same = std::all_of(members.begin(), members.end(),
                                [&](const Parameter& p) { return p.change_text == members[0].change_text; });
  bundle.change_text = same && !members.empty() ? members[0].change_text + " each" : "one each";
  return bundle;
}

/// What can be asked for: nothing that only moves a surface that a layer presses.
std::vector<Parameter> known_parameters(const SceneTables& scene) {
  std::vector<Parameter> known = parameters_of(scene);
  std::erase_if(known, [&](const Parameter& p) { return layer_of(scene, p) != nullptr; });
  return known;
}

/// Single parameters in the scene's order, then the bundles as asked for.
void choose_parameters(const SceneTables& scene, const std::vector<std::string>& patterns, SensitivityRows& rows,
                       Diagnostics& out) {
  const std::vector<Parameter> known = known_parameters(scene);
  const auto marked = [&](const std::vector<bool>& wanted) {
    std::vector<Parameter> chosen;
    for (std::size_t k = 0; k < known.size(); ++k)
      if (wanted[k]) chosen.push_back(known[k]);
    return chosen;
  };
  std::vector<bool> singles(known.size());
  std::vector<Parameter> bundles;
  std::vector<std::vector<Parameter>> members;
  for (const std::string& pattern : patterns) {
    if (!pattern.ends_with(kTogether)) {
      mark_parameters(scene, known, pattern, singles, out);
      continue;
    }
    std::vector<bool> wanted(known.size());
    std::stringstream parts(pattern.substr(0, pattern.size() - std::string_view(kTogether).size()));
    for (std::string part; std::getline(parts, part, '+');) mark_parameters(scene, known, part, wanted, out);
    members.push_back(marked(wanted));
    bundles.push_back(bundle_of(pattern, members.back()));
    if (members.back().empty() && parts.str().empty())
      refuse_option(out, Code::missing_key, "--to", pattern, "names nothing to move together");
  }
  rows.parameters = marked(singles);
  rows.bundles.resize(rows.parameters.size());
  rows.parameters.insert(rows.parameters.end(), bundles.begin(), bundles.end());
  rows.bundles.insert(rows.bundles.end(), members.begin(), members.end());
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
  if (count <= kMaxSensitivityRows) return false;
  out.error(Code::too_large, {},
            fmt::format("{} poses, {} outputs and {} parameters make {} derivatives, at most {} are computed at "
                        "once: ask for fewer",
                        rows_asked(prepared), counted, rows.parameters.size(), count, kMaxSensitivityRows));
  return true;
}

/// The layers whose surfaces a pattern names beside what it finds; their parameters are left out.
std::string left_out(const SceneTables& scene, const SensitivityChoice& choice) {
  std::vector<const LayerDef*> layers;
  for (const Parameter& p : parameters_of(scene))
    for (const std::string& pattern : choice.parameters)
      if (const LayerDef* layer = layer_of(scene, p);
          layer != nullptr && (pattern == "all" || matches(pattern, p.name)))
        if (std::find(layers.begin(), layers.end(), layer) == layers.end()) layers.push_back(layer);
  std::string names;
  for (const LayerDef* layer : layers) names += (names.empty() ? "" : ", ") + layer->pair.name;
  if (names.empty()) return {};
  return fmt::format("  {:<12}not of the surfaces under elastic layers ({})\n", "", names);
}

std::string facts(const SceneTables& scene, const SensitivityChoice& choice, const SensitivityResult& r) {
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
  return out + left_out(scene, choice);
}

}  // namespace

SensitivityRows choose(const Prepared& prepared, const SensitivityChoice& choice, int contact_numbers,
                       Diagnostics& out) {
  SensitivityRows rows;
  choose_outputs(prepared, choice.outputs, contact_numbers, rows.outputs, out);
  choose_parameters(prepared.scene, choice.parameters, rows, out);
  return rows;
}

namespace {

/// The pose with the nearest points of pairs that never touched: their gaps have derivatives too.
PosePoint with_clear_pairs(const PosePoint& point, const JointModel& model, ContactField& field) {
  PosePoint out = point;
  for (int pair = 0; point.solved() && pair < static_cast<int>(model.pairs.size()); ++pair) {
    const auto of_pair = [pair](const auto& c) { return c.pair == pair; };
    const auto& held = point.pose.state.contacts;
    const auto& open = point.pose.open;
    if (std::any_of(held.begin(), held.end(), of_pair) || std::any_of(open.begin(), open.end(), of_pair)) continue;
    if (const auto there = field.nearest(point.pose.state, pair))
      out.pose.open.push_back({.pair = pair, .number = 0, .geometry = there->contact, .gap = there->gap});
  }
  return out;
}

}  // namespace

void differentiate(const Prepared& prepared, ContactField& field, const SensitivityChoice& choice,
                   SensitivityResult& result) {
  const ScopedTimer timing(result.seconds);
  Diagnostics said_before;
  result.rows = choose(prepared, choice, contacts_made(result.solution), said_before);
  SensitivityRows& rows = result.rows;
  drop_contacts_not_made(result.solution.poses, rows.outputs);
  const std::size_t parameters = rows.parameters.size(), one = rows.outputs.size() * parameters;
  rows.derivatives.assign(result.solution.records.size() * one, std::numeric_limits<double>::quiet_NaN());
  Sensitivity sensitivity(prepared.scene, prepared.model);
  for (std::size_t row = 0; row < result.solution.records.size(); ++row) {
    const PosePoint point = with_clear_pairs(result.solution.records[row].point, prepared.model, field);
    if (!sensitivity.factor(point)) {
      ++result.poses_without;
      continue;
    }
    for (std::size_t p = 0; p < parameters; ++p) {
      const auto derivative = [&](std::size_t o) -> double& {
        return rows.derivatives[row * one + o * parameters + p];
      };
      const std::vector<Parameter>& bundle = rows.bundles[p];
      if (!bundle.empty())
        for (std::size_t o = 0; o < rows.outputs.size(); ++o) derivative(o) = 0;
      for (const Parameter& member : bundle) {
        sensitivity.differentiate(member);
        for (std::size_t o = 0; o < rows.outputs.size(); ++o)
          derivative(o) += rows.outputs[o].rate(point, sensitivity) * rows.outputs[o].shown * member.change;
      }
      if (!bundle.empty()) continue;
      sensitivity.differentiate(rows.parameters[p]);
      for (std::size_t o = 0; o < rows.outputs.size(); ++o)
        derivative(o) = rows.outputs[o].rate(point, sensitivity) * rows.outputs[o].shown * rows.parameters[p].si;
    }
  }
}

bool solve_and_differentiate(const Prepared& prepared, const SensitivityChoice& choice, const RunOptions& options,
                             Diagnostics& out, SensitivityResult& result) {
  if (refuse_motion(prepared, "sensitivity", out)) return false;
  const SensitivityRows asked = choose(prepared, choice, kMaxNamedContacts, out);
  if (out.has_errors() || too_many(prepared, asked, out)) return false;
  ContactField field = contact_field(prepared);
  if (!check_start(prepared, field, out)) return false;
  result.solution = solve(prepared, field, options);
  differentiate(prepared, field, choice, result);
  return true;
}

int run_sensitivity(const SceneSource& source, const std::optional<std::string>& folder,
                    const SensitivityChoice& choice, const RunOptions& options, Diagnostics& out,
                    SensitivityResult& result) {
  const auto prepared = prepare_run(source, folder, out);
  if (!prepared || !solve_and_differentiate(*prepared, choice, options, out, result)) return kExitRefused;
  const PlacedScene& scene = prepared->scene;
  const auto& steps = prepared->steps;
  const Solution& solution = result.solution;
  result.text = ranking_text(result.rows, scene, steps, solution.poses, choice.most) + facts(scene, choice, result);
  if (!folder) return solution.summary.exit_code;
  result.solution.folder = folder_for(*folder, options, result.solution.summary);
  const Chart chart = sensitivity_chart(result.rows, curves(scene, steps, solution.poses, solution.events));
  const std::string error =
      write_results(solution.folder, *prepared, solution,
                    {{"sensitivity.csv", sensitivity_csv(result.rows, scene, steps, solution.poses)},
                     {"ranking.csv", ranking_table(result.rows, scene, steps, solution.poses).to_csv()},
                     {"sensitivity.svg", to_svg(chart)}});
  if (error.empty()) return solution.summary.exit_code;
  out.error(Code::cannot_write, {}, error);
  return kExitFailed;
}

}  // namespace genu
