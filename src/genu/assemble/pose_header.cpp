#include "genu/assemble/pose_header.h"

#include <string_view>

#include "genu/assemble/plain_text.h"

namespace genu {
namespace {

class HeaderReader {
 public:
  explicit HeaderReader(LongErrors& errors) : errors_(errors) {}

  void read(const TextLine& line) {
    const std::size_t first = line.text.find_first_not_of(" \t");
    std::size_t end = line.text.find('=');
    read_sentence(line);
    if (end == std::string_view::npos) end = line.text.find_first_of(" \t", first);
    if (end == std::string_view::npos) return;
    const std::string key = lower_case(std::string(trimmed(line.text.substr(first, end - first))));
    const std::string value = lower_case(std::string(trimmed(line.text.substr(end + 1))));
    read_entry(key, value, {line.number, static_cast<int>(end) + 2});
  }

  PoseHeader finish() {
    if (simm_ && !header_.angles.degrees) {
      header_.angles.degrees = true;
      header_.angles.why = "a SIMM motion";
      header_.angles.assumed = true;
    }
    return header_;
  }

 private:
  void read_entry(const std::string& key, const std::string& value, SourceLocation where) {
    if (key == "indegrees") {
      if (value == "yes" || value == "no")
        angles_are(value == "yes", "inDegrees=" + value, where.line);
      else
        errors_.add(where, Code::unknown_name, "inDegrees", value, "must be yes or no");
    }
    if (key == "nrows") read_promise("nRows", value, where, header_.rows);
    if (key == "ncolumns") read_promise("nColumns", value, where, header_.columns);
    if (key == "datarows") read_promise(key, value, where, header_.rows);
    if (key == "datacolumns") read_promise(key, value, where, header_.columns);
    if (key == "datarows" || key == "datacolumns" || key == "otherdata" || key == "range")
      simm_ = simm_ || is_number(value.substr(0, value.find_first_of(" \t")));  // else words of a title
    if (key == "datatype" && value != "double")
      errors_.add(where, Code::unknown_name, "DataType", value, "must be double: one number a cell");
  }

  /// "Angles are in degrees."
  void read_sentence(const TextLine& line) {
    const std::string text = lower_case(std::string(line.text));
    const auto has = [&](const char* word) { return text.find(word) != std::string::npos; };
    if (!has("angle") || has("degree") == has("radian")) return;
    angles_are(has("degree"), '"' + std::string(trimmed(line.text)) + '"', line.number);
  }

  /// The first word counts; another that says the opposite is remembered.
  void angles_are(bool degrees, const std::string& why, int line) {
    AngleUnit& angles = header_.angles;
    if (angles.degrees && *angles.degrees != degrees)
      angles.against = why;
    else if (!angles.degrees)
      angles = {degrees, why, false, {}, line};
  }

  void read_promise(const std::string& key, const std::string& value, SourceLocation where,
                    std::optional<PoseHeader::Promise>& out) {
    constexpr std::size_t kMostDigits = 9;
    if (value.empty() || value.size() > kMostDigits || value.find_first_not_of("0123456789") != std::string::npos)
      errors_.add(where, Code::wrong_form, key, value, "must be a whole number >= 0");
    else
      out = {key, static_cast<std::size_t>(std::stol(value)), where};
  }

  LongErrors& errors_;
  PoseHeader header_;
  bool simm_ = false;
};

}  // namespace

const ColumnUnit& unsaid_unit(const AngleUnit& angles, bool angle) {
  if (!angle) return *column_unit("m");
  return *column_unit(angles.degrees.value_or(false) ? "deg" : "rad");
}

PoseHeader read_pose_header(const std::vector<TextLine>& lines, LongErrors& errors) {
  HeaderReader reader(errors);
  for (const TextLine& line : lines) reader.read(line);
  return reader.finish();
}

}  // namespace genu
