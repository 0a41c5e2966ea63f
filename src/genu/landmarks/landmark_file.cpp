#include "genu/landmarks/landmark_file.h"

#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/format.h>

#include "genu/assemble/table_text.h"
#include "genu/core/file_text.h"
#include "genu/landmarks/landmark_formats.h"
#include "genu/scene/utf8.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

bool ends_with(std::string name, std::string_view end) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.ends_with(end);
}

void refuse_repeated(const std::vector<Landmark>& points, Diagnostics& out) {
  std::map<std::string, int> first;
  for (const Landmark& point : points) {
    const auto [known, is_new] = first.emplace(point.name, point.place.at.line);
    if (!is_new)
      out.add(error_at(point.place, Code::duplicate, "name", with_quotes(point.name),
                       fmt::format("is the name of the point on line {}, too: number several points of one end, "
                                   "\"{} 1\" and \"{} 2\"",
                                   known->second, point.name, point.name)));
  }
}

}  // namespace

std::optional<LandmarkFile> read_landmarks(const std::string& file, double unit, Diagnostics& out) {
  const auto text = text_of_file(file, out);
  if (!text) return std::nullopt;
  return read_landmark_text(file, *text, unit, out);
}

std::optional<LandmarkFile> read_landmark_text(const std::string& file, const std::string& text, double unit,
                                               Diagnostics& out) {
  const std::size_t before = out.count(Diagnostic::Severity::error);
  LandmarkFile found;
  if (const auto fault = fault_of_encoding(text))
    out.error(fault->code, file, fault->text);
  else if (const auto place = first_invalid_utf8(text))
    out.add(error_at({file, *place}, Code::not_utf8, {}, {}, "is no UTF-8: save the file as UTF-8"));
  else if (ends_with(file, ".json"))
    found = read_markups(file, text, out);
  else if (ends_with(file, ".fcsv"))
    found = read_fcsv(file, text, out);
  else if (ends_with(file, ".csv"))
    found = read_landmark_table(file, text, unit, out);
  else
    out.error(Code::wrong_form, file, "must be landmarks: .mrk.json or .fcsv of 3D Slicer, or a table .csv");
  refuse_repeated(found.points, out);
  if (out.count(Diagnostic::Severity::error) > before) return std::nullopt;
  if (found.points.empty()) {
    out.error(Code::missing_key, file, "has no points");
    return std::nullopt;
  }
  return found;
}

}  // namespace genu
