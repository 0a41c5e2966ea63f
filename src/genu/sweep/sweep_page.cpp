#include "genu/sweep/sweep_page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "genu/core/file_text.h"
#include "genu/results/svg_text.h"
#include "genu/sweep/histograms.h"
#include "genu/sweep/page_parts.h"
#include "genu/sweep/pictures.h"
#include "genu/sweep/summary_tables.h"

namespace genu {
namespace {

constexpr std::size_t kMostListed = 50;

std::vector<std::string> scenes_of(const SweepTable& sweep) {
  std::vector<std::string> scenes;
  for (const auto& in : sweep.record.cases)
    if (std::find(scenes.begin(), scenes.end(), in.scene) == scenes.end()) scenes.push_back(in.scene);
  return scenes;
}

std::string pictures(const SweepTable& sweep, const SweepTables& tables) {
  std::vector<std::string> bands, moving, histograms, tornados;
  const std::vector<std::string> columns = columns_with_bands(sweep);
  const std::vector<std::size_t> pictured = pictured_numbers(sweep, tables);
  for (const std::string& scene : scenes_of(sweep)) {
    for (const std::string& column : columns) {
      bands.push_back(bands_picture(sweep, tables, scene, column));
      moving.push_back(moving_histogram(sweep, scene, column));
    }
    for (const std::size_t k : pictured)
      if (std::find(columns.begin(), columns.end(), sweep.record.kept[k].column) == columns.end() ||
          !sweep.record.kept[k].at_value)
        histograms.push_back(histogram_picture(sweep, scene, k));
  }
  for (const std::size_t k : pictured)
    for (std::size_t c = 0; c < sweep.cases.size(); ++c) tornados.push_back(tornado_picture(sweep, tables, c, k));
  return page_charts("Over the main coordinate", {}, bands) + page_charts("What matters most", {}, tornados) +
         page_charts("Distributions over the main coordinate", histogram_slider(sweep), moving) +
         page_charts("Distributions", {}, histograms);
}

/// The command that solves a sample by itself.
std::string command_of(const SweepTable::Case& in, std::size_t sample) {
  std::string out = fmt::format("genu sweep {} --sample {}", shell_word(in.study), sample);
  if (!in.name.empty()) out += fmt::format(" --case {}", shell_word(in.name));
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
      rows += "<tr>" + page_cell(sweep.case_name(c), true) + page_cell(std::to_string(s)) +
              page_cell(in.classes[s], true) +
              page_cell(std::isfinite(in.jump_at[s]) ? fmt::format("{:.5g}", in.jump_at[s]) : std::string()) +
              page_cell(in.reasons[s], true) + "<td class=\"w\"><code>" + svg_escaped(command_of(in, s)) +
              "</code></td></tr>\n";
    }
  if (count == 0) return fmt::format("<h2>{}</h2>\n<p>None.</p>\n", title);
  return fmt::format(
      "<h2>{}</h2>\n<p>{}{}</p>\n<table><tr><th class=\"w\">case</th><th>sample</th><th class=\"w\">class"
      "</th><th>jump at</th><th class=\"w\">reason</th><th class=\"w\">by itself</th></tr>\n{}</table>\n",
      title, count, count > kMostListed ? fmt::format(", the first {}:", kMostListed) : ":", rows);
}

/// All behind the first lines; `where`: the whole tables are.
std::string body_of(const SweepTable& sweep, const SweepTables& tables, const std::string& where) {
  const SweepRecord& r = sweep.record;
  std::string out;
  std::vector<std::string> event_columns = {"scene", "what_if", "event", "count", "n", "probability"};
  if (r.random) event_columns.insert(event_columns.end(), {"low", "high"});
  out += "<h2>Events</h2>\n" + page_table(tables.events, event_columns, kMostListed);
  out += pictures(sweep, tables);
  constexpr std::size_t kMostRows = 200;
  std::vector<std::string> columns = {"scene", "what_if", "number", "n",   "mean", "sd",
                                      "min",   "max",     "p5",     "p50", "p95"};
  std::string words = where;
  if (r.random) {
    columns = {"scene", "what_if", "number", "n",   "mean",    "mean_low", "mean_high",
               "sd",    "p5",      "p50",    "p95", "p95_low", "p95_high"};
    words = "mean_low to p95_high: 95 % intervals. " + where;
  }
  out += "<h2>Statistics</h2>\n<p>" + words + "</p>\n" + page_table(tables.statistics, columns, kMostRows);
  out += listed(sweep, "Samples that jumped", [](const auto& in, std::size_t s) { return in.jumps[s] > 0; });
  out += listed(sweep, "Samples without an answer", [](const auto& in, std::size_t s) {
    return in.classes[s] == "not_solved" || in.classes[s] == "refused";
  });
  return out + "</body></html>\n";
}

}  // namespace

std::string sweep_page(const SweepTable& sweep, const SweepTables& tables) {
  const SweepRecord& r = sweep.record;
  const std::string name = std::filesystem::path(r.study).filename().string();
  return fmt::format("{}<p>{} samples of {} numbers in {} case{}; design {}, seed {}; genu {}, study {}.</p>\n",
                     page_head(r.title.empty() ? name : r.title), r.samples, r.factors.size(), r.cases.size(),
                     r.cases.size() == 1 ? "" : "s", r.design, r.seed, svg_escaped(r.version), svg_escaped(name)) +
         body_of(sweep, tables, "All rows are in statistics.csv.");
}

std::string compared_page(const SweepTable& all, const SweepTables& tables, const std::string& title,
                          const std::string& about) {
  return page_head(title) + "<p>" + svg_escaped(about) + "</p>\n" +
         body_of(all, tables, "Ranks are in each study's own folder.");
}

}  // namespace genu
