#include <cmath>

#include <fmt/format.h>

#include "genu/landmarks/json_places.h"
#include "genu/landmarks/landmark_formats.h"
#include "genu/landmarks/tolerances.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

/// A file of markups while it is read.
struct Markups {
  const std::string& file;
  Diagnostics& out;

  void refuse(const JsonValue& value, Code code, const std::string& key, const std::string& rule) const {
    const bool whole = value.kind == JsonValue::Kind::array || value.kind == JsonValue::Kind::object;
    const std::string found = value.kind == JsonValue::Kind::string ? with_quotes(value.text) : value.text;
    out.add(error_at({file, value.at}, code, key, whole ? "" : found, rule));
  }

  /// "LPS", as where nothing is said, or "RAS"; empty, with an error, of anything else.
  std::string space(const JsonValue& markup, const std::string& path) const {
    const JsonValue* said = markup.find("coordinateSystem");
    if (!said) return "LPS";
    if (said->kind == JsonValue::Kind::string && (said->text == "LPS" || said->text == "RAS")) return said->text;
    refuse(*said, Code::unknown_name, path + ".coordinateSystem", R"(must be "LPS" or "RAS")");
    return {};
  }

  /// Metres in one unit: "mm", or three words of which the first is one.
  double unit(const JsonValue& markup, const std::string& path) const {
    const JsonValue* said = markup.find("coordinateUnits");
    if (!said) return 1e-3;
    const JsonValue& word =
        said->kind == JsonValue::Kind::array && !said->children.empty() ? said->children.front() : *said;
    if (word.kind == JsonValue::Kind::string)
      for (const auto& [name, metres] : {std::pair("mm", 1e-3), std::pair("cm", 1e-2), std::pair("m", 1.0)})
        if (word.text == name) return metres;
    refuse(word, Code::unknown_name, path + ".coordinateUnits", R"(must be "mm", "cm" or "m")");
    return 1e-3;
  }

  void point(const JsonValue& control, const std::string& path, double metres, LandmarkFile& found) const {
    const JsonValue* status = control.find("positionStatus");
    if (status && status->text != "defined") return;
    const JsonValue* label = control.find("label");
    const JsonValue* position = control.find("position");
    const bool named = label && label->kind == JsonValue::Kind::string && !label->text.empty();
    if (!named) refuse(label ? *label : control, Code::missing_key, path + ".label", "must name the point");
    if (!position) refuse(control, Code::missing_key, path + ".position", "is missing");
    if (!position) return;
    if (position->kind != JsonValue::Kind::array || position->children.size() != 3)
      return refuse(*position, Code::wrong_form, path + ".position", "must be three numbers");
    Landmark landmark{named ? label->text : "", Vec3::Zero(), {}, {file, (label ? *label : control).at}};
    bool good = named;
    for (std::size_t k = 0; k < 3; ++k) {
      const JsonValue& x = position->children[k];
      const std::string key = fmt::format("{}.position[{}]", path, k);
      const bool number = x.kind == JsonValue::Kind::number;
      if (!number) refuse(x, Code::wrong_form, key, "must be a number");
      if (number && !(std::abs(x.number) <= kFarthestLandmark))
        refuse(x, Code::out_of_range, key, fmt::format("must be within {:g} of 0", kFarthestLandmark));
      good = good && number && std::abs(x.number) <= kFarthestLandmark;
      landmark.at[static_cast<Eigen::Index>(k)] = metres * x.number;
    }
    if (good) found.points.push_back(std::move(landmark));
  }

  /// Both frames have up in common: one is the other turned about it.
  static void into(const std::string& space, const std::string& other, LandmarkFile& found, std::size_t from) {
    if (space == other) return;
    for (std::size_t i = from; i < found.points.size(); ++i) found.points[i].at.head<2>() *= -1;
  }
};

}  // namespace

LandmarkFile read_markups(const std::string& file, const std::string& text, Diagnostics& out) {
  LandmarkFile found;
  const auto root = read_json(file, text, out);
  if (!root) return found;
  const Markups reader{file, out};
  const JsonValue* markups = root->find("markups");
  if (!markups || markups->kind != JsonValue::Kind::array) {
    reader.refuse(markups ? *markups : *root, Code::missing_key, "markups",
                  "is missing: this is no file of markups of 3D Slicer");
    return found;
  }
  for (std::size_t m = 0; m < markups->children.size(); ++m) {
    const JsonValue& markup = markups->children[m];
    const std::string path = fmt::format("markups[{}]", m);
    const std::string space = reader.space(markup, path);
    const double metres = reader.unit(markup, path);
    if (found.space.empty()) found.space = space;
    const JsonValue* points = markup.find("controlPoints");
    if (!points || points->kind != JsonValue::Kind::array) {
      reader.refuse(points ? *points : markup, Code::missing_key, path + ".controlPoints", "must list the points");
      continue;
    }
    const std::size_t first = found.points.size();
    for (std::size_t i = 0; i < points->children.size(); ++i)
      reader.point(points->children[i], fmt::format("{}.controlPoints[{}]", path, i), metres, found);
    Markups::into(space, found.space, found, first);
  }
  return found;
}

}  // namespace genu
