#include "genu/sweep/sweep_page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "genu/core/file_text.h"
#include "genu/results/svg_text.h"
#include "genu/sweep/pictures.h"
#include "genu/sweep/summary_tables.h"

namespace genu {
namespace {

constexpr const char* kStyle =
    "body{font:15px/1.5 'Helvetica Neue',Helvetica,Arial,'Liberation Sans',sans-serif;margin:2em auto;max-width:1340px;"
    "padding:0 1em;color:#222}table{border-collapse:collapse;font-size:13px}td,th{padding:2px 10px;border-bottom:1px "
    "solid #ddd;text-align:right}td.w,th.w{text-align:left}code{font-size:12px}svg{max-width:100%;height:auto}"
    ".p{display:flex;flex-wrap:wrap;gap:12px}";

constexpr std::size_t kMostPictures = 24, kMostListed = 50;

std::string html_cell(const std::string& text, bool words = false) {
  return fmt::format("<td{}>{}</td>", words ? " class=\"w\"" : "", svg_escaped(text));
}

std::string html_number(const Cell& cell, int digits) {
  if (const auto* value = std::get_if<double>(&cell)) return fmt::format("{:.{}g}", *value, digits);
  if (const auto* count = std::get_if<long>(&cell)) return fmt::format("{}", *count);
  const auto* word = std::get_if<std::string>(&cell);
  return word != nullptr ? *word : std::string();
}

/// Some columns of a table, its first `most` rows.
std::string html_table(const ResultTable& table, const std::vector<std::string>& columns, std::size_t most) {
  std::string out = "<table><tr>";
  for (const std::string& column : columns) out += "<th>" + svg_escaped(column) + "</th>";
  out += "</tr>\n";
  for (std::size_t r = 0; r < std::min(most, table.rows()); ++r) {
    out += "<tr>";
    for (const std::string& column : columns) {
      const Cell& value = table.at(r, table.column_index(column));
      out += html_cell(html_number(value, 4), std::holds_alternative<std::string>(value));
    }
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

std::vector<std::string> scenes_of(const SweepTable& sweep) {
  std::vector<std::string> scenes;
  for (const auto& in : sweep.record.cases)
    if (std::find(scenes.begin(), scenes.end(), in.scene) == scenes.end()) scenes.push_back(in.scene);
  return scenes;
}

std::string pictures(const SweepTable& sweep) {
  std::vector<std::string> bands, histograms, tornados;
  for (const std::string& scene : scenes_of(sweep)) {
    for (const std::string& column : columns_with_bands(sweep)) bands.push_back(bands_picture(sweep, scene, column));
    for (const std::size_t k : pictured_numbers(sweep)) histograms.push_back(histogram_picture(sweep, scene, k));
  }
  for (const std::size_t k : pictured_numbers(sweep))
    for (std::size_t c = 0; c < sweep.cases.size(); ++c) tornados.push_back(tornado_picture(sweep, c, k));
  std::string out;
  const auto add = [&](const char* title, std::vector<std::string>& list) {
    std::erase(list, std::string());
    if (list.empty()) return;
    out += fmt::format("<h2>{}</h2>\n<div class=\"p\">\n", title);
    for (std::size_t k = 0; k < std::min(kMostPictures, list.size()); ++k) out += list[k];
    out += "</div>\n";
    if (list.size() > kMostPictures) out += fmt::format("<p>{} of {} charts.</p>\n", kMostPictures, list.size());
  };
  add("Over the main coordinate", bands);
  add("What matters most", tornados);
  add("Distributions", histograms);
  return out;
}

/// The command that solves a sample by itself.
std::string command_of(const SweepTable& sweep, std::size_t c, std::size_t sample) {
  std::string out = fmt::format("genu sweep {} --sample {}", shell_word(sweep.record.study), sample);
  if (sweep.cases.size() > 1)
    out += fmt::format(" --case {}", shell_word(sweep.record.cases[c].scene + "/" + sweep.record.cases[c].what_if));
  return out + fmt::format(" --out sample-{}", sample);
}

template <class F>
std::string listed(const SweepTable& sweep, const char* title, const F& wanted) {
  std::string rows;
  std::size_t count = 0;
  for (std::size_t c = 0; c < sweep.cases.size(); ++c)
    for (std::size_t s = 0; s < sweep.cases[c].classes.size(); ++s) {
      const SweepTable::Case& in = sweep.cases[c];
      if (!wanted(in, s) || ++count > kMostListed) continue;
      rows += "<tr>" + html_cell(sweep.case_name(c), true) + html_cell(std::to_string(s)) +
              html_cell(in.classes[s], true) +
              html_cell(std::isfinite(in.jump_at[s]) ? fmt::format("{:.5g}", in.jump_at[s]) : std::string()) +
              html_cell(in.reasons[s], true) + "<td class=\"w\"><code>" + svg_escaped(command_of(sweep, c, s)) +
              "</code></td></tr>\n";
    }
  if (count == 0) return fmt::format("<h2>{}</h2>\n<p>None.</p>\n", title);
  return fmt::format(
      "<h2>{}</h2>\n<p>{}{}</p>\n<table><tr><th class=\"w\">case</th><th>sample</th><th class=\"w\">class"
      "</th><th>jump at</th><th class=\"w\">reason</th><th class=\"w\">by itself</th></tr>\n{}</table>\n",
      title, count, count > kMostListed ? fmt::format(", the first {}:", kMostListed) : ":", rows);
}

}  // namespace

std::string sweep_page(const SweepTable& sweep) {
  const SweepRecord& r = sweep.record;
  const std::string name = std::filesystem::path(r.study).filename().string();
  const std::string title = svg_escaped(r.title.empty() ? name : r.title);
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title><style>{}</style></head>"
      "<body>\n<h1>{}</h1>\n<p>{} samples of {} numbers in {} case{}; design {}, seed {}; genu {}, study {}.</p>\n",
      title, kStyle, title, r.samples, r.factors.size(), r.cases.size(), r.cases.size() == 1 ? "" : "s", r.design,
      r.seed, svg_escaped(r.version), svg_escaped(name));
  std::vector<std::string> event_columns = {"scene", "what_if", "event", "count", "n", "probability"};
  if (r.random) event_columns.insert(event_columns.end(), {"low", "high"});
  out += "<h2>Events</h2>\n" + html_table(event_probabilities(sweep), event_columns, kMostListed);
  out += pictures(sweep);
  constexpr std::size_t kMostRows = 200;
  std::vector<std::string> columns = {"scene", "what_if", "number", "n",   "mean", "sd",
                                      "min",   "max",     "p5",     "p50", "p95"};
  std::string words = "All rows are in statistics.csv.";
  if (r.random) {
    columns = {"scene", "what_if", "number", "n",   "mean",    "mean_low", "mean_high",
               "sd",    "p5",      "p50",    "p95", "p95_low", "p95_high"};
    words = "mean_low to p95_high: 95 % intervals. " + words;
  }
  out += "<h2>Statistics</h2>\n<p>" + words + "</p>\n" + html_table(statistics_table(sweep), columns, kMostRows);
  out += listed(sweep, "Samples that jumped", [](const auto& in, std::size_t s) { return in.jumps[s] > 0; });
  out += listed(sweep, "Samples without an answer", [](const auto& in, std::size_t s) {
    return in.classes[s] == "not_solved" || in.classes[s] == "refused";
  });
  return out + "</body></html>\n";
}

}  // namespace genu
