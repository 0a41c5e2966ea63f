#include "genu/sweep/page_parts.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/results/svg_text.h"

namespace genu {
namespace {

constexpr const char* kStyle =
    "body{font:15px/1.5 'Helvetica Neue',Helvetica,Arial,'Liberation Sans',sans-serif;margin:2em auto;max-width:1340px;"
    "padding:0 1em;color:#222}table{border-collapse:collapse;font-size:13px}td,th{padding:2px 10px;border-bottom:1px "
    "solid #ddd;text-align:right}td.w,th.w{text-align:left}code{font-size:12px}svg{max-width:100%;height:auto}"
    ".p{display:flex;flex-wrap:wrap;gap:12px}";

constexpr std::size_t kMostPictures = 24;

std::string html_number(const Cell& cell, int digits) {
  if (const auto* value = std::get_if<double>(&cell)) return fmt::format("{:.{}g}", *value, digits);
  if (const auto* count = std::get_if<long>(&cell)) return fmt::format("{}", *count);
  const auto* word = std::get_if<std::string>(&cell);
  return word != nullptr ? *word : std::string();
}

}  // namespace

std::string page_cell(const std::string& text, bool words) {
  return fmt::format("<td{}>{}</td>", words ? " class=\"w\"" : "", svg_escaped(text));
}

std::string page_table(const ResultTable& table, const std::vector<std::string>& columns, std::size_t most) {
  std::string out = "<table><tr>";
  for (const std::string& column : columns) out += "<th>" + svg_escaped(column) + "</th>";
  out += "</tr>\n";
  for (std::size_t r = 0; r < std::min(most, table.rows()); ++r) {
    out += "<tr>";
    for (const std::string& column : columns) {
      const Cell& value = table.at(r, table.column_index(column));
      out += page_cell(html_number(value, 4), std::holds_alternative<std::string>(value));
    }
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

std::string page_head(const std::string& title) {
  const std::string text = svg_escaped(title);
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">{}<title>{}</title><style>{}</style></head>"
      "<body>\n<h1>{}</h1>\n",
      kSweepPageMark, text, kStyle, text);
}

std::string page_charts(const std::string& title, const std::string& before, std::vector<std::string> charts) {
  std::erase(charts, std::string());
  if (charts.empty()) return {};
  std::string out = fmt::format("<h2>{}</h2>\n{}<div class=\"p\">\n", title, before);
  for (std::size_t k = 0; k < std::min(kMostPictures, charts.size()); ++k) out += charts[k];
  out += "</div>\n";
  if (charts.size() > kMostPictures) out += fmt::format("<p>{} of {} charts.</p>\n", kMostPictures, charts.size());
  return out;
}

}  // namespace genu
