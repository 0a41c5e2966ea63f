#include "genu/assemble/pose_columns.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "genu/assemble/opensim_names.h"
#include "genu/assemble/plain_text.h"
#include "genu/assemble/refuse_option.h"
#include "genu/core/units.h"
#include "genu/results/columns.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

struct Unit {
  const char* name;
  double si;
  bool angle;
};
constexpr Unit kUnits[] = {{"rad", units::kRadian, true},
                           {"deg", units::kDegree, true},
                           {"m", units::kMetre, false},
                           {"mm", units::kMillimetre, false}};

const Unit* unit_called(const std::string& name) {
  for (const Unit& u : kUnits)
    if (name == u.name) return &u;
  return nullptr;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

class Matcher {
 public:
  Matcher(const SceneTables& scene, const PoseFile& file, Diagnostics& out) : scene_(scene), file_(file), out_(out) {
    for (std::size_t c = 0; c < file.names.cells.size(); ++c) by_name_[file.names.cells[c].text] = c;
    for (int j = 0; j < static_cast<int>(scene.joints.size()); ++j)
      for (int i = 0; i < 6; ++i)
        if (scene.joints[at(j)].leaves(i)) wanted_.push_back({j, i});
  }

  std::optional<PoseColumns> match(const PoseColumnOptions& options) {
    const std::size_t before = out_.count(Diagnostic::Severity::error);
    read_units(options.units);
    read_explicit(options.columns);
    for (const CoordinateRef& c : wanted_) match_one(c);
    match_rest();
    if (!missing_.empty()) tell_missing();
    if (out_.count(Diagnostic::Severity::error) > before) return std::nullopt;
    return std::move(found_);
  }

 private:
  const std::string& name(std::size_t column) const { return file_.names.cells[column].text; }

  void read_units(const std::string& text) {
    if (file_.in_degrees.value_or(false)) {
      angle_ = unit_called("deg");
      angle_why_ = "inDegrees=yes";
    } else if (file_.in_degrees) {
      angle_why_ = "inDegrees=no";
    }
    if (trimmed(text).empty()) return;
    for (const std::string& part : split(text, ',')) {
      const Unit* unit = unit_called(std::string(trimmed(part)));
      if (unit == nullptr) {
        refuse_option(out_, Code::wrong_form, "--units", text,
                      "must be an angle's unit (deg or rad), a length's (mm or m), or both: deg,mm");
        return;
      }
      (unit->angle ? angle_ : length_) = unit;
      (unit->angle ? angle_why_ : length_why_) = "--units";
    }
  }

  const CoordinateRef* coordinate_called(const std::string& text) const {
    const auto c = std::find_if(wanted_.begin(), wanted_.end(),
                                [&](const CoordinateRef& x) { return coordinate_name(scene_, x) == text; });
    return c == wanted_.end() ? nullptr : &*c;
  }

  std::vector<std::string> known_quantities() const {
    std::vector<std::string> names;
    for (const CoordinateRef& c : wanted_) names.push_back(coordinate_name(scene_, c));
    names.emplace_back("time");
    return names;
  }

  /// By its whole name, else by the last part of its path where one column alone has that.
  std::optional<std::size_t> column_called(const std::string& text) const {
    if (const auto it = by_name_.find(text); it != by_name_.end()) return it->second;
    std::optional<std::size_t> found;
    for (std::size_t c = 0; c < file_.names.cells.size(); ++c) {
      if (last_part_of_path(name(c)) != text) continue;
      if (found) return std::nullopt;
      found = c;
    }
    return found;
  }

  void read_explicit(const std::string& text) {
    if (trimmed(text).empty()) return;
    for (const std::string& part : split(text, ',')) {
      const std::size_t equals = part.find('=');
      if (equals == std::string::npos)
        refuse_option(out_, Code::wrong_form, "--columns", std::string(trimmed(part)),
                      "must be QUANTITY=COLUMN, such as knee.flexion=knee_flex_r[rad]");
      else
        add_explicit(std::string(trimmed(part.substr(0, equals))), std::string(trimmed(part.substr(equals + 1))));
    }
  }

  void add_explicit(const std::string& quantity, std::string column) {
    const CoordinateRef* coordinate = coordinate_called(quantity);
    if (coordinate == nullptr && quantity != "time")
      return refuse_option(out_, Code::unknown_name, "--columns", quantity,
                           "is no coordinate that a column can give" + did_you_mean(quantity, known_quantities()) +
                               " (known: " + quoted_list(known_quantities()) + ")");
    const Unit* unit = nullptr;
    const std::size_t bracket = column.rfind('[');
    if (!column_called(column) && bracket != std::string::npos && column.back() == ']') {
      const std::string word = column.substr(bracket + 1, column.size() - bracket - 2);
      unit = unit_called(word);
      if (coordinate == nullptr || unit == nullptr || unit->angle != (coordinate->index < 3))
        return refuse_option(out_, Code::wrong_form, "--columns", quantity + "=" + column,
                             coordinate == nullptr   ? "time has no unit: it is in s"
                             : coordinate->index < 3 ? "the unit of an angle is [deg] or [rad]"
                                                     : "the unit of a length is [mm] or [m]");
      column = std::string(trimmed(column.substr(0, bracket)));
    }
    const auto c = column_called(column);
    if (!c)
      return refuse_option(out_, Code::unknown_name, "--columns", column,
                           "is no column of " + file_.path + did_you_mean(column, names()) + ", or that of several");
    if (coordinate == nullptr) {
      if (found_.time) return refuse_option(out_, Code::duplicate, "--columns", quantity, "is given twice");
      found_.time = c;
      return;
    }
    if (!explicit_.emplace(std::pair{coordinate->joint, coordinate->index}, std::pair{*c, unit}).second)
      refuse_option(out_, Code::duplicate, "--columns", quantity, "is given twice");
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const PoseFile::Cell& cell : file_.names.cells) all.push_back(cell.text);
    return all;
  }

  void add(const CoordinateRef& c, std::size_t column, const Unit* unit, const std::string& how) {
    const bool angle = c.index < 3;
    std::string why = how;
    const Unit* const own = unit;
    if (unit == nullptr) {
      unit = angle ? angle_ : length_;
      why += std::string(", unit: ") + (angle ? angle_why_ : length_why_);
    }
    if (own == nullptr)  // knee_flexion_deg says it, whoever chose the column
      for (const Unit& u : kUnits)
        if (const std::string end = std::string("_") + u.name, text = name(column);
            u.angle == angle && text.size() > end.size() &&
            text.compare(text.size() - end.size(), end.size(), end) == 0) {
          unit = &u;
          why = how + ", unit: its name";
        }
    found_.coordinates.push_back({c, column, unit->si, unit->name, why});
    used_.push_back(column);
  }

  void match_one(const CoordinateRef& c) {
    if (const auto e = explicit_.find({c.joint, c.index}); e != explicit_.end())
      return add(c, e->second.first, e->second.second, "--columns");
    if (const auto it = by_name_.find(coordinate_column(scene_, c)); it != by_name_.end())
      return add(c, it->second, unit_called(c.index < 3 ? "deg" : "mm"), "as in results.csv");
    if (const auto it = by_name_.find(coordinate_name(scene_, c)); it != by_name_.end())
      return add(c, it->second, nullptr, "its name");
    std::vector<std::size_t> columns;
    for (std::size_t k = 0; k < file_.names.cells.size(); ++k) {
      const std::vector<CoordinateRef> meant = opensim_coordinates(scene_, name(k));
      if (std::find(meant.begin(), meant.end(), c) == meant.end()) continue;
      if (meant.size() > 1)
        return refuse_several(c, name(k),
                              fmt::format("may as well be {}", coordinate_name(scene_, meant[meant[0] == c])));
      columns.push_back(k);
    }
    if (columns.size() > 1)
      return refuse_several(c, name(columns[0]), fmt::format("and {} may both be it", name(columns[1])));
    if (columns.empty())
      missing_.push_back(coordinate_name(scene_, c));
    else
      add(c, columns[0], nullptr, "OpenSim's habit");
  }

  void refuse_several(const CoordinateRef& c, const std::string& column, const std::string& what) {
    out_.add(
        error_at({file_.path, {file_.names.line, file_.names.cells[by_name_.at(column)].column}}, Code::conflict,
                 coordinate_name(scene_, c), {},
                 fmt::format("{} {}: say which by --columns \"{}=...\"", column, what, coordinate_name(scene_, c))));
  }

  void match_rest() {
    const auto find = [&](const std::string& text) {
      const auto it = by_name_.find(text);
      return it == by_name_.end() ? std::optional<std::size_t>() : it->second;
    };
    found_.step = find("step");
    found_.increment = find("increment");
    found_.status = find("status");
    if (!found_.own_results()) found_.step = found_.increment = found_.status = std::nullopt;
    if (!found_.time) found_.time = find("time_s");
    for (std::size_t c = 0; !found_.time && c < file_.names.cells.size(); ++c)
      if (lower_case(name(c)) == "time") found_.time = c;
    for (int i = 0; i < static_cast<int>(scene_.loads.size()); ++i)
      if (const auto c = find(scene_.loads[at(i)].name + ".factor")) found_.factors.push_back({i, *c});
    for (const auto& c : {found_.step, found_.increment, found_.status, found_.time})
      if (c) used_.push_back(*c);
    for (const auto& f : found_.factors) used_.push_back(f.column);
    for (std::size_t c = 0; c < file_.names.cells.size(); ++c)
      if (std::find(used_.begin(), used_.end(), c) == used_.end()) found_.ignored.push_back(c);
  }

  void tell_missing() {
    constexpr std::size_t kPoseColumnsListed = 40;
    std::vector<std::string> all = names();
    const std::size_t more = all.size() > kPoseColumnsListed ? all.size() - kPoseColumnsListed : 0;
    all.resize(all.size() - more);
    out_.add(
        error_at({file_.path, {file_.names.line, 1}}, Code::missing_key, {}, {},
                 fmt::format("no column gives {}: name it so (or {}), or say --columns \"{}=COLUMN[{}]\"; the columns "
                             "here: {}{}",
                             quoted_list(missing_), coordinate_column(scene_, *coordinate_called(missing_[0])),
                             missing_[0], coordinate_called(missing_[0])->index < 3 ? "rad" : "m", quoted_list(all),
                             more > 0 ? fmt::format(" and {} more", more) : "")));
  }

  const SceneTables& scene_;
  const PoseFile& file_;
  Diagnostics& out_;
  std::map<std::string, std::size_t> by_name_;
  std::vector<CoordinateRef> wanted_;
  std::map<std::pair<int, int>, std::pair<std::size_t, const Unit*>> explicit_;
  const Unit *angle_ = unit_called("rad"), *length_ = unit_called("m");
  std::string angle_why_ = "SI", length_why_ = "SI";
  std::vector<std::string> missing_;
  std::vector<std::size_t> used_;
  PoseColumns found_;
};

}  // namespace

std::optional<PoseColumns> match_columns(const SceneTables& scene, const PoseFile& file,
                                         const PoseColumnOptions& options, Diagnostics& out) {
  return Matcher(scene, file, out).match(options);
}

}  // namespace genu
