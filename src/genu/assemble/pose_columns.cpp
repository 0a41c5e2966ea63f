#include "genu/assemble/pose_columns.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "genu/assemble/column_names.h"
#include "genu/assemble/opensim_names.h"
#include "genu/assemble/plain_text.h"
#include "genu/assemble/refuse_option.h"
#include "genu/results/columns.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

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
  Matcher(const SceneTables& scene, const PoseFile& file, Diagnostics& out)
      : scene_(scene), file_(file), out_(out), names_(file.names) {
    for (int j = 0; j < static_cast<int>(scene.joints.size()); ++j)
      for (int i = 0; i < 6; ++i)
        if (scene.joints[at(j)].leaves(i)) wanted_.push_back({j, i});
  }

  std::optional<PoseColumns> match(const PoseColumnOptions& options) {
    const std::size_t before = out_.count(Diagnostic::Severity::error);
    read_units(options.units);
    read_explicit(options.columns);
    read_transforms(options.transforms);
    for (const CoordinateRef& c : wanted_) match_one(c);
    match_rest();
    if (!missing_.empty()) tell_missing();
    if (unit_of_file_used_) check_unit_of_file();
    refuse_repeated_names(file_, used_, out_);
    if (out_.count(Diagnostic::Severity::error) > before) return std::nullopt;
    return std::move(found_);
  }

 private:
  FilePlace place(std::size_t column) const {
    return {file_.path, {file_.names.line, file_.names.cells[column].column}};
  }

  void read_units(const std::string& text) {
    angle_ = &unsaid_unit(file_.angles, true);
    length_ = &unsaid_unit(file_.angles, false);
    if (file_.angles.degrees) angle_why_ = file_.angles.why;
    if (trimmed(text).empty()) return;
    for (const std::string& part : split(text, ',')) {
      const ColumnUnit* unit = column_unit(std::string(trimmed(part)));
      if (unit == nullptr || (unit->angle ? angle_why_ : length_why_) == "--units") {
        refuse_option(out_, Code::wrong_form, "--units", text,
                      "must be an angle's unit (deg or rad), a length's (mm or m), or both: deg,mm");
        return;
      }
      (unit->angle ? angle_ : length_) = unit;
      (unit->angle ? angle_why_ : length_why_) = "--units";
    }
  }

  /// Their joints need no other columns.
  void read_transforms(const std::string& text) {
    const bool assumed = length_why_ == kAssumed;
    found_.transforms = match_transforms(scene_, names_, text, {length_, length_why_, assumed}, out_);
    for (const TransformColumns& t : found_.transforms) {
      used_.insert(used_.end(), t.columns.begin(), t.columns.end());
      std::erase_if(wanted_, [&](const CoordinateRef& c) { return c.joint == t.joint; });
      for (int i = 0; i < 6; ++i)
        if (explicit_.contains({t.joint, i}))
          refuse_option(out_, Code::conflict, "--columns", coordinate_name(scene_, {t.joint, i}),
                        "is given by --transforms already");
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
    const bool angle = coordinate != nullptr && coordinate->index < 3;
    const ColumnUnit* unit = nullptr;
    const std::size_t bracket = column.rfind('[');
    if (names_.called(column, angle).empty() && bracket != std::string::npos && column.back() == ']') {
      unit = column_unit(bare_unit(column.substr(bracket)));
      if (coordinate == nullptr || unit == nullptr || unit->angle != angle)
        return refuse_option(out_, Code::wrong_form, "--columns", quantity + "=" + column,
                             coordinate == nullptr ? "time has no unit: it is in s"
                             : angle               ? "the unit of an angle is [deg] or [rad]"
                                                   : "the unit of a length is [mm], [cm] or [m]");
      column = std::string(trimmed(column.substr(0, bracket)));
    }
    const std::vector<std::size_t> found = names_.called(column, angle);
    if (found.empty())
      return refuse_option(out_, Code::unknown_name, "--columns", column,
                           "is no column of " + file_.path + names_.near(column));
    if (found.size() > 1)
      return refuse_option(out_, Code::conflict, "--columns", column,
                           fmt::format("may be {} or {}: give the whole name", with_quotes(names_[found[0]]),
                                       with_quotes(names_[found[1]])));
    const std::size_t c = found[0];
    if (coordinate == nullptr) {
      if (found_.time) return refuse_option(out_, Code::duplicate, "--columns", quantity, "is given twice");
      found_.time = c;
      return;
    }
    if (!explicit_.emplace(std::pair{coordinate->joint, coordinate->index}, std::pair{c, unit}).second)
      refuse_option(out_, Code::duplicate, "--columns", quantity, "is given twice");
  }

  /// `unit`: where the user says one, or results.csv has it; else null.
  void add(const CoordinateRef& c, std::size_t column, const ColumnUnit* unit, std::string how) {
    const bool angle = c.index < 3;
    const ColumnLabel& label = names_.label(column, angle);
    const std::string& why = angle ? angle_why_ : length_why_;
    bool assumed = false;
    if (unit == nullptr && label.unit != nullptr) {
      unit = label.unit;
      how += ", unit: its name";
      if (unit->angle != angle) refuse_unit(c, column, *unit);
    } else if (unit == nullptr) {
      unit = angle ? angle_ : length_;
      assumed = why == kAssumed;
      unit_of_file_used_ = unit_of_file_used_ || (angle && why == file_.angles.why);
      how += ", unit: " + why;
      const ColumnUnit* other = names_.label(column, !angle).unit;
      if (other != nullptr && other != column_unit("m"))  // the ending _m has other meanings
        refuse_unit(c, column, *other);
      else if (!label.unknown.empty())
        warn_unknown_unit(c, column, *unit);
    }
    found_.coordinates.push_back({c, column, unit->si, unit->name, how, assumed});
    used_.push_back(column);
  }

  void refuse_unit(const CoordinateRef& c, std::size_t column, const ColumnUnit& unit) {
    out_.add(error_at(place(column), Code::conflict, names_[column], {},
                      fmt::format("is taken for {}, and {} is no unit of {}", coordinate_name(scene_, c), unit.name,
                                  c.index < 3 ? "an angle" : "a length")));
  }

  void warn_unknown_unit(const CoordinateRef& c, std::size_t column, const ColumnUnit& unit) {
    out_.add(warning_at(place(column), Code::unknown_name, names_[column], {},
                        fmt::format("is read in {}: ({}) is no unit that is known. Say --columns \"{}={}[{}]\" if that "
                                    "is right",
                                    unit.name, names_.label(column, c.index < 3).unknown, coordinate_name(scene_, c),
                                    names_[column], unit.name)));
  }

  /// What a header says about angles is not always clear.
  void check_unit_of_file() {
    const AngleUnit& angles = file_.angles;
    const FilePlace place{file_.path, {std::max(angles.line, 1), 1}};
    if (angles.against)
      out_.add(error_at(place, Code::conflict, {}, {},
                        fmt::format("{} and {} say the opposite of each other: say --units deg or --units rad",
                                    angles.why, *angles.against)));
    if (angles.assumed)
      out_.add(warning_at(place, Code::missing_key, {}, {},
                          "the header is that of a SIMM motion and does not say the unit of angles: they are read in "
                          "deg, as SIMM writes them. Say --units rad if they are in rad"));
  }

  void match_one(const CoordinateRef& c) {
    const bool angle = c.index < 3;
    if (const auto e = explicit_.find({c.joint, c.index}); e != explicit_.end())
      return add(c, e->second.first, e->second.second, "--columns");
    if (const auto own = names_.exact(coordinate_column(scene_, c)))
      return add(c, *own, column_unit(angle ? "deg" : "mm"), "as in results.csv");
    const std::string name = coordinate_name(scene_, c);
    if (const auto whole = names_.exact(name)) return add(c, *whole, nullptr, "its name");
    std::vector<std::size_t> columns, named;
    for (std::size_t k = 0; k < names_.size(); ++k) {
      if (names_.label(k, angle).path == name) named.push_back(k);
      const std::vector<CoordinateRef> meant = opensim_coordinates(scene_, names_.label(k, angle).word);
      if (std::find(meant.begin(), meant.end(), c) == meant.end()) continue;
      if (meant.size() > 1 && named.empty())
        return refuse_several(c, k, fmt::format("may as well be {}", coordinate_name(scene_, meant[meant[0] == c])));
      columns.push_back(k);
    }
    const char* how = named.empty() ? "OpenSim's habit" : "its name";
    if (!named.empty()) columns = named;
    if (columns.size() > 1)
      return refuse_several(c, columns[0], fmt::format("and {} may both be it", names_[columns[1]]));
    if (columns.empty())
      missing_.push_back(name);
    else
      add(c, columns[0], nullptr, how);
  }

  void refuse_several(const CoordinateRef& c, std::size_t column, const std::string& what) {
    const std::string quantity = coordinate_name(scene_, c);
    out_.add(error_at(place(column), Code::conflict, quantity, {},
                      fmt::format("{} {}: say which by --columns \"{}=...\"", names_[column], what, quantity)));
  }

  void match_rest() {
    found_.step = names_.exact("step");
    found_.increment = names_.exact("increment");
    found_.status = names_.exact("status");
    if (!found_.own_results()) found_.step = found_.increment = found_.status = std::nullopt;
    if (!found_.time) found_.time = names_.time();
    for (int i = 0; i < static_cast<int>(scene_.loads.size()); ++i)
      if (const auto c = names_.exact(scene_.loads[at(i)].name + ".factor")) found_.factors.push_back({i, *c});
    for (const auto& c : {found_.step, found_.increment, found_.status, found_.time})
      if (c) used_.push_back(*c);
    for (const auto& f : found_.factors) used_.push_back(f.column);
    for (std::size_t c = 0; c < names_.size(); ++c)
      if (std::find(used_.begin(), used_.end(), c) == used_.end()) found_.ignored.push_back(c);
  }

  void tell_missing() {
    constexpr std::size_t kPoseColumnsListed = 40;
    std::vector<std::string> all = names_.all();
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
  ColumnNames names_;
  std::vector<CoordinateRef> wanted_;
  std::map<std::pair<int, int>, std::pair<std::size_t, const ColumnUnit*>> explicit_;
  const ColumnUnit *angle_ = nullptr, *length_ = nullptr;  // of columns that do not say their own
  static constexpr const char* kAssumed = "SI";            // why a unit is taken that nobody says
  std::string angle_why_ = kAssumed, length_why_ = kAssumed;
  bool unit_of_file_used_ = false;
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
