#include "genu/sweep/read_sweep.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>

#include <fmt/format.h>

#include "genu/scene/reader.h"
#include "genu/scene/words.h"
#include "genu/sweep/read_vary.h"
#include "genu/sweep/tolerances.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kTwoLevels = 2;
constexpr int kLeastResolution = 3, kMostResolution = 5;

const std::vector<std::string> kDesigns = {"monte_carlo",          "latin_hypercube", "sobol", "factorial",
                                           "fractional_factorial", "one_at_a_time",   "points"};

/// Files of a folder that a name with * or ? in its last part means, sorted; any other name as it is.
std::vector<std::string> files_of(const fs::path& name) {
  const std::string pattern = name.filename().string();
  if (pattern.find_first_of("*?") == std::string::npos) return {name.string()};
  std::vector<std::string> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(name.parent_path().empty() ? "." : name.parent_path(), ignored))
    if (matches(pattern, entry.path().filename().string()))
      found.push_back((name.parent_path() / entry.path().filename()).string());
  std::sort(found.begin(), found.end());
  return found;
}

void read_scenes(ReadContext& context, Section& root, SweepDef& sweep) {
  const Item one = root.find("scene"), several = root.find("scenes");
  if (bool(one) == bool(several))
    root.error(one ? Code::conflict : Code::missing_key, "scene", "must be given: either `scene` or `scenes`");
  for (const Item& item : {one, several})
    for (const auto& [name, where] : read_texts(context, item)) {
      const fs::path path = fs::path(name).is_absolute() ? fs::path(name) : context.folder / name;
      const auto files = files_of(path);
      for (const std::string& file : files) sweep.scenes.push_back({file, where});
      if (files.empty()) context.error(where, Code::no_such_file, item.path, with_quotes(name), "matches no file");
    }
  std::set<std::string> seen;
  for (const SceneFileDef& scene : sweep.scenes)
    if (!seen.insert(fs::path(scene.path).lexically_normal().string()).second)
      context.error(scene.where, Code::duplicate, "scenes", with_quotes(scene.path), "is given twice");
}

void read_probabilities(ReadContext& context, const Item& item, SweepDef& sweep) {
  sweep.probabilities = {0.05, 0.95};
  if (sweep.design == DesignKind::factorial) sweep.probabilities = {0.05, 0.5, 0.95};
  if (!item || !is_array(context, item, "an array of numbers between 0 and 1")) return;
  if (is_random(sweep.design) || sweep.design == DesignKind::points)
    refuse(context, item, Code::no_effect, "belongs to the designs factorial, fractional_factorial and one_at_a_time");
  sweep.probabilities.clear();
  for (std::size_t k = 0; k < item.node->children.size(); ++k) {
    const auto p = read_number(context, item.element(k));
    if (p && !(*p > 0 && *p < 1)) refuse(context, item.element(k), Code::out_of_range, "must be > 0 and < 1");
    if (p) sweep.probabilities.push_back(*p);
  }
  if (sweep.probabilities.empty()) refuse(context, item, Code::missing_key, "names no probability");
  if (std::adjacent_find(sweep.probabilities.begin(), sweep.probabilities.end(), std::greater_equal<>()) !=
      sweep.probabilities.end())
    refuse(context, item, Code::wrong_form, "must rise from one to the next");
  if (sweep.design == DesignKind::fractional_factorial && item.node->children.size() != kTwoLevels)
    refuse(context, item, Code::wrong_form, "must have two numbers: every factor has two levels");
}

void read_design(ReadContext& context, Section& root, SweepDef& sweep) {
  if (const auto kind = read_choice(context, root.find("design"), kDesigns))
    sweep.design = static_cast<DesignKind>(*kind);
  const Item samples = root.find("samples"), seed = root.find("seed"), points = root.find("points");
  if (is_random(sweep.design)) {
    if (!samples) root.error(Code::missing_key, "samples", "must be given: how many samples are drawn");
    if (const auto n = read_integer(context, samples, 1, kMaxSamples)) sweep.samples = static_cast<std::uint64_t>(*n);
  } else if (samples) {
    refuse(context, samples, Code::no_effect, "has no effect: the design counts its own samples");
  }
  if (const auto n = read_integer(context, seed, 0, std::numeric_limits<std::int64_t>::max()))
    sweep.seed = static_cast<std::uint64_t>(*n);
  const Item indices = root.find("indices");
  sweep.indices = read_bool(context, indices).value_or(false);
  if (sweep.indices && sweep.design != DesignKind::monte_carlo && sweep.design != DesignKind::sobol)
    refuse(context, indices, Code::conflict, "needs the design monte_carlo or sobol (Saltelli's scheme)");
  read_probabilities(context, root.find("probabilities"), sweep);
  const Item resolution = root.find("resolution");
  if (resolution && sweep.design != DesignKind::fractional_factorial)
    refuse(context, resolution, Code::no_effect, "belongs to the design fractional_factorial");
  if (const auto r = read_integer(context, resolution, kLeastResolution, kMostResolution))
    sweep.resolution = static_cast<int>(*r);
  if (sweep.design == DesignKind::points) {
    if (!points)
      root.error(Code::missing_key, "points", "must be given: a CSV file with a column for each varied number");
  } else if (points) {
    refuse(context, points, Code::no_effect, "belongs to the design points");
  }
  if (const auto name = read_string(context, points)) {
    sweep.points = fs::path(*name).is_absolute() ? *name : (context.folder / *name).string();
    sweep.points_where = points.node->where;
  }
}

void read_what_ifs(ReadContext& context, Section& root, SweepDef& sweep) {
  sweep.what_ifs.push_back({kAsItIs, {}, {}});
  for (const Item& item : named_tables(context, root, "what_if")) {
    Section table(context, item, "a what-if");
    WhatIfDef what_if{item.node->key, {}, item.node->key_where};
    for (auto& [text, where] : read_texts(context, table.find("without"))) what_if.changes.without.push_back(text);
    for (auto& [text, where] : read_texts(context, table.find("set"))) what_if.changes.set.push_back(text);
    table.finish();
    if (what_if.changes.empty()) table.error(Code::missing_key, "", "changes nothing: give `without` or `set`");
    if (what_if.name == kAsItIs) table.error(Code::duplicate, "", "is the name of the scene as it is");
    sweep.what_ifs.push_back(std::move(what_if));
  }
}

void read_rows(ReadContext& context, const Item& item, KeepDef& keep) {
  using Row = KeepDef::Row::Kind;
  const auto word = [&](const Item& one) {
    constexpr std::array kWords = {std::pair("all", Row::all), std::pair("last", Row::last), std::pair("max", Row::max),
                                   std::pair("min", Row::min)};
    for (const auto& [name, kind] : kWords)
      if (one.node->text == name) return keep.rows.push_back({kind, 0, one.node->where});
    refuse(context, one, Code::unknown_name, R"(must be a number, "all", "last", "max" or "min")");
  };
  const auto add = [&](const Item& one) {
    if (one.node->kind == TomlNode::Kind::string) return word(one);
    if (const auto value = read_number(context, one)) keep.rows.push_back({Row::value, *value, one.node->where});
  };
  if (!item) return;
  if (item.node->kind != TomlNode::Kind::array) return add(item);
  for (std::size_t k = 0; k < item.node->children.size(); ++k) add(item.element(k));
  if (item.node->children.empty()) refuse(context, item, Code::missing_key, "names no row");
}

void read_keep(ReadContext& context, Section& root, SweepDef& sweep) {
  const Item list = root.require("keep");
  if (!list || !is_array(context, list, "tables [[keep]]")) return;
  for (std::size_t k = 0; k < list.node->children.size(); ++k) {
    const Item item = list.element(k);
    if (!is_table(context, item)) continue;
    Section table(context, item, "a [[keep]]");
    KeepDef keep;
    for (const auto& [pattern, where] : read_texts(context, table.require("columns")))
      keep.columns.push_back({pattern, where});
    read_rows(context, table.require("at"), keep);
    table.finish();
    sweep.keep.push_back(std::move(keep));
  }
}

/// "ACL.force_N > 200"
void read_condition(ReadContext& context, const Item& item, EventDef& event) {
  const auto text = read_string(context, item);
  if (!text) return;
  const auto word = [](std::string_view part) {
    const std::size_t first = part.find_first_not_of(" \t"), last = part.find_last_not_of(" \t");
    return first == std::string_view::npos ? std::string_view() : part.substr(first, last + 1 - first);
  };
  const std::size_t sign = text->find_first_of("<>");
  const std::string_view column = word(std::string_view(*text).substr(0, sign)),
                         limit = sign == std::string::npos ? std::string_view() : word(&(*text)[sign + 1]);
  const auto [end, error] = std::from_chars(limit.data(), limit.data() + limit.size(), event.limit);
  const bool number = error == std::errc() && end == limit.data() + limit.size() && std::isfinite(event.limit);
  if (column.empty() || limit.empty() || !number)
    return refuse(context, item, Code::wrong_form, R"(must be a column, < or >, and a number: "ACL.force_N > 200")");
  event.above = (*text)[sign] == '>';
  event.keep.columns.push_back({std::string(column), item.node->where});
}

void read_events(ReadContext& context, Section& root, SweepDef& sweep) {
  std::set<std::string> names = {"jumped", "doubtful", "not_solved", "refused"};
  for (const Item& item : named_tables(context, root, "event")) {
    Section table(context, item, "an event");
    EventDef event;
    event.name = item.node->key;
    read_condition(context, table.require("when"), event);
    const Item at = table.find("at");
    read_rows(context, at, event.keep);
    table.finish();
    using Row = KeepDef::Row;
    if (!at) event.keep.rows.push_back({event.above ? Row::Kind::max : Row::Kind::min, 0, item.node->key_where});
    if (event.keep.rows.size() > 1 || (event.keep.rows.size() == 1 && event.keep.rows[0].kind == Row::Kind::all))
      refuse(context, at, Code::wrong_form, "must be one row; without `at` the event may happen at any row");
    if (!names.insert(event.name).second) table.error(Code::duplicate, "", "is an event that every study has");
    sweep.events.push_back(std::move(event));
  }
}

/// tables = "all", "jumped", 17 or an array of such.
void read_tables(ReadContext& context, const Item& item, SweepDef& sweep) {
  if (!item) return;
  std::vector<std::string> known = {"all", "jumped", "solved", "doubtful", "not_solved"};
  for (const EventDef& event : sweep.events) known.push_back(event.name);
  const auto add = [&](const Item& one) {
    if (one.node->kind == TomlNode::Kind::integer) {
      if (const auto number = read_integer(context, one, 0, kMaxSamples - 1))
        sweep.tables.samples.push_back({static_cast<std::uint64_t>(*number), one.node->where});
      return;
    }
    if (one.node->kind != TomlNode::Kind::string)
      return refuse(context, one, Code::wrong_form,
                    R"(must be "all", a class, "jumped", the name of an event, or the number of a sample)");
    const std::string& word = one.node->text;
    if (word == "refused")
      refuse(context, one, Code::no_effect, "names samples that were not solved at all: they have no table");
    else if (std::find(known.begin(), known.end(), word) == known.end())
      refuse(context, one, Code::unknown_name,
             "is no class and no event of this study" + did_you_mean(word, known) +
                 R"( ("all", "jumped", "solved", "doubtful", "not_solved", or numbers of samples))");
    else if (word == "all")
      sweep.tables.all = true;
    else
      sweep.tables.words.push_back({word, one.node->where});
  };
  if (item.node->kind != TomlNode::Kind::array) return add(item);
  for (std::size_t k = 0; k < item.node->children.size(); ++k) add(item.element(k));
  if (item.node->children.empty()) refuse(context, item, Code::missing_key, "names no sample");
}

}  // namespace

const char* to_string(DesignKind design) { return kDesigns[static_cast<std::size_t>(design)].c_str(); }

std::optional<SweepDef> read_sweep(const std::string& path, InputFiles& files, Diagnostics& out) {
  const auto document = read_document(path, files, out);
  if (!document) return std::nullopt;
  Diagnostics found;
  Scene unused;
  ReadContext context(path, found, unused);
  SweepDef sweep;
  sweep.file = path;
  Section root(context, {&*document, ""}, "a study");
  if (!root.has("scene") && !root.has("scenes") && (root.has("body") || root.has("joint"))) {
    out.error(Code::wrong_form, path, "is a scene: a study names one as `scene` (genu explain sweep)");
    return std::nullopt;
  }
  read_integer(context, root.require("format"), 1, 1);
  sweep.title = read_string(context, root.find("title")).value_or("");
  read_scenes(context, root, sweep);
  read_design(context, root, sweep);
  read_vary(context, root.find("vary"), sweep);
  if (!root.has("vary") && !is_random(sweep.design))
    root.error(Code::missing_key, "vary", "must be given: the design combines values of varied numbers");
  read_correlation(context, root.find("correlation"), sweep);
  read_what_ifs(context, root, sweep);
  read_keep(context, root, sweep);
  read_events(context, root, sweep);
  read_tables(context, root.find("tables"), sweep);
  root.finish();
  found.sort();
  for (const Diagnostic& d : found.items()) out.add(d);
  if (found.has_errors()) return std::nullopt;
  return sweep;
}

}  // namespace genu
