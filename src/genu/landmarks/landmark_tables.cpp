#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "genu/assemble/table_text.h"
#include "genu/landmarks/landmark_formats.h"
#include "genu/landmarks/tolerances.h"
#include "genu/mesh_files/text_words.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

std::string lower(std::string_view word) {
  std::string out(word);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

/// Where a table has what; -1: nowhere.
struct PointColumns {
  int name = -1, x = -1, y = -1, z = -1, error = -1;
  bool whole() const { return std::min({name, x, y, z}) >= 0; }
};

PointColumns columns_of(const std::vector<TextCell>& cells) {
  PointColumns out;
  for (int i = 0; i < static_cast<int>(cells.size()); ++i) {
    const std::string word = lower(cells[at(i)].text);
    if (word == "name" || word == "label") out.name = i;
    if (word == "x") out.x = i;
    if (word == "y") out.y = i;
    if (word == "z") out.z = i;
    if (word == "error") out.error = i;
  }
  return out;
}

/// A table of points while it is read.
struct PointTable {
  const std::string& file;
  Diagnostics& out;
  double metres;
  PointColumns columns{};

  std::optional<double> number(int line, const std::vector<TextCell>& cells, int column, const char* key) const {
    if (column >= static_cast<int>(cells.size())) {
      out.add(error_at({file, {line, 0}}, Code::missing_key, key, {}, "is missing: the line has too few cells"));
      return std::nullopt;
    }
    const TextCell& cell = cells[at(column)];
    const FilePlace place{file, {line, cell.column}};
    double value = 0;
    if (!TextWords::number(std::string_view(cell.text), value) || std::isnan(value)) {
      out.add(
          error_at(place, Code::wrong_form, key, with_quotes(cell.text),
                   has_decimal_comma(cell.text) ? "must have a point in the place of the comma" : "must be a number"));
      return std::nullopt;
    }
    if (std::abs(value) <= kFarthestLandmark) return metres * value;
    out.add(error_at(place, Code::out_of_range, key, cell.text,
                     fmt::format("must be within {:g} of 0", kFarthestLandmark)));
    return std::nullopt;
  }

  void row(const TextLine& line, char separator, LandmarkFile& found) const {
    std::vector<TextCell> cells;
    if (!split_separated(line.text, separator, cells)) {
      out.add(error_at({file, {line.number, 0}}, Code::wrong_form, {}, {}, "has a quote that is not closed"));
      return;
    }
    const bool named = columns.name < static_cast<int>(cells.size()) && !cells[at(columns.name)].text.empty();
    if (!named)
      out.add(error_at({file, {line.number, 0}}, Code::missing_key, "name", {}, "is missing: each point has a name"));
    const auto x = number(line.number, cells, columns.x, "x"), y = number(line.number, cells, columns.y, "y"),
               z = number(line.number, cells, columns.z, "z");
    std::optional<double> error;
    const bool stated =
        columns.error >= 0 && columns.error < static_cast<int>(cells.size()) && !cells[at(columns.error)].text.empty();
    if (stated) error = number(line.number, cells, columns.error, "error");
    if (error && !(*error > 0))
      out.add(error_at({file, {line.number, cells[at(columns.error)].column}}, Code::out_of_range, "error",
                       cells[at(columns.error)].text, "must be > 0"));
    if (named && x && y && z)
      found.points.push_back({cells[at(columns.name)].text,
                              Vec3(*x, *y, *z),
                              error,
                              {file, {line.number, cells[at(columns.name)].column}}});
  }
};

/// What stands behind "# KEY =" of a header's line, and its column; empty where it is another line.
std::optional<TextCell> said_in(std::string_view line, std::string_view key) {
  const std::size_t at = line.find_first_not_of("# \t");
  if (at == std::string_view::npos || !lower(line.substr(at)).starts_with(lower(key))) return std::nullopt;
  const std::size_t equals = line.find_first_not_of(" \t", at + key.size());
  if (equals == std::string_view::npos || line[equals] != '=') return std::nullopt;
  const std::size_t begin = std::min(line.find_first_not_of(" \t", equals + 1), line.size());
  const std::size_t end = line.find_last_not_of(" \t") + 1;
  return TextCell{std::string(line.substr(begin, std::max(end, begin) - begin)), static_cast<int>(begin) + 1};
}

/// By words since 4.11, by numbers before.
std::string space_of(const TextCell& said, const FilePlace& place, Diagnostics& out) {
  const std::string word = lower(said.text);
  if (word == "ras" || word == "0") return "RAS";
  if (word == "lps" || word == "1") return "LPS";
  out.add(error_at(place, Code::unknown_name, "CoordinateSystem", with_quotes(said.text),
                   word == "ijk" || word == "2" ? "counts voxels of an image that is not here: save the points as LPS"
                                                : "must be LPS or RAS (1 or 0 in older files)"));
  return {};
}

}  // namespace

LandmarkFile read_fcsv(const std::string& file, const std::string& text, Diagnostics& out) {
  LandmarkFile found;
  found.space = "RAS";
  PointTable table{file, out, 1e-3, {}};
  bool header = false;
  for (const TextLine& line : lines_of(text)) {
    if (!line.text.starts_with('#')) {
      if (header && table.columns.whole()) table.row(line, ',', found);
      continue;
    }
    std::vector<TextCell> cells;
    const std::string words = lower(line.text);
    if (words.find("markups fiducial file") != std::string::npos) {
      header = true;
      split_separated("id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID", ',', cells);
    } else if (words.find("fiducial list file") != std::string::npos) {
      header = true;
      split_separated("label,x,y,z,sel,vis", ',', cells);
    } else if (const auto columns = said_in(line.text, "columns")) {
      split_separated(columns->text, ',', cells);
    } else if (const auto space = said_in(line.text, "CoordinateSystem")) {
      found.space = space_of(*space, {file, {line.number, space->column}}, out);
    }
    if (cells.empty()) continue;
    table.columns = columns_of(cells);
    if (!table.columns.whole())
      out.add(error_at({file, {line.number, 0}}, Code::missing_key, "columns", {}, "must name label, x, y and z"));
  }
  if (!header)
    out.error(Code::broken_file, file,
              "does not begin as a list of fiducials of 3D Slicer does (\"# Markups fiducial file version = ...\")");
  return found;
}

LandmarkFile read_landmark_table(const std::string& file, const std::string& text, double unit, Diagnostics& out) {
  LandmarkFile found;
  const std::vector<TextLine> lines = lines_of(text);
  if (lines.empty()) return found;
  const char separator = separator_of(lines.front().text, lines.size() > 1 ? lines[1].text : lines.front().text);
  std::vector<TextCell> names;
  const bool split = split_separated(lines.front().text, separator, names);
  PointTable table{file, out, unit, columns_of(names)};
  if (!split || !table.columns.whole()) {
    out.add(error_at({file, {lines.front().number, 1}}, Code::missing_key, {}, {},
                     "must name the columns: name,x,y,z and, if it is known, error"));
    return found;
  }
  for (std::size_t i = 1; i < lines.size(); ++i) table.row(lines[i], separator, found);
  return found;
}

}  // namespace genu
