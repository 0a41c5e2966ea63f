#include "genu/assemble/transform_columns.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "genu/assemble/plain_text.h"
#include "genu/assemble/refuse_option.h"

namespace genu {
namespace {

using Places = std::vector<std::size_t>;
constexpr std::size_t kWhole = 16, kRows = 12;  // numbers with the last row of the matrix and without

/// "2-17" as 1, ..., 16.
std::optional<Places> places_of(const std::string& text) {
  const std::size_t dash = text.find('-');
  if (dash == std::string::npos) return {};
  std::size_t first = 0, last = 0;
  const char *begin = text.data(), *middle = begin + dash, *end = begin + text.size();
  const auto a = std::from_chars(begin, middle, first), b = std::from_chars(middle + 1, end, last);
  if (a.ec != std::errc() || a.ptr != middle || b.ec != std::errc() || b.ptr != end) return {};
  if (first < 1 || last < first || last - first >= kWhole) return Places();
  Places places;
  for (std::size_t k = first; k <= last; ++k) places.push_back(k - 1);
  return places;
}

/// The letters and digits of a name's rest; R11, M11 and T11 are 11.
std::string index_of(const std::string& rest) {
  std::string index;
  for (const char c : lower_case(rest))
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) index += c;
  const bool lettered = index.size() > 1 && std::string("rmt").find(index[0]) != std::string::npos &&
                        std::isdigit(static_cast<unsigned char>(index[1])) != 0;
  return lettered ? index.substr(1) : index;
}

/// Ways to number the elements of the matrix; `k` counts row by row from 0.
enum class Style { row_column, row_column_from_0, count, count_from_0, rotation_and_x, rotation_and_tx };
constexpr Style kStyles[] = {Style::row_column,   Style::row_column_from_0, Style::count,
                             Style::count_from_0, Style::rotation_and_x,    Style::rotation_and_tx};

std::string index_in(Style style, std::size_t k) {
  const std::size_t row = k / 4, column = k % 4;
  const bool apart = column == 3 && row < 3;
  switch (style) {
    case Style::row_column:
      return fmt::format("{}{}", row + 1, column + 1);
    case Style::row_column_from_0:
      return fmt::format("{}{}", row, column);
    case Style::count:
      return fmt::format("{}", k + 1);
    case Style::count_from_0:
      return fmt::format("{}", k);
    case Style::rotation_and_x:
      return apart ? std::string(1, "xyz"[row]) : index_in(Style::row_column, k);
    case Style::rotation_and_tx:
      break;
  }
  return apart ? std::string("t") + "xyz"[row] : index_in(Style::row_column, k);
}

class TransformMatcher {
 public:
  TransformMatcher(const SceneTables& scene, const ColumnNames& names, const OtherUnit& length, Diagnostics& out)
      : scene_(scene), names_(names), length_(length), out_(out) {}

  /// "knee=T[mm]"
  void read(const std::string& entry) {
    const std::size_t equals = std::min(entry.find('='), entry.size());
    std::string left(trimmed(entry.substr(0, equals)));
    std::string right = equals < entry.size() ? std::string(trimmed(entry.substr(equals + 1))) : std::string();
    TransformColumns found;
    const auto unit = take_unit(right.empty() ? left : right);
    if (!unit) return refuse(Code::wrong_form, entry, "the unit of the translation is [mm], [cm] or [m]");
    const int joint = joint_called(left);
    if (joint < 0)
      return refuse(Code::unknown_name, left,
                    "is no joint of the scene, nor the child of one" + did_you_mean(left, known()) +
                        " (known: " + quoted_list(known()) + ")");
    found.joint = joint;
    if (std::any_of(found_.begin(), found_.end(), [&](const auto& t) { return t.joint == joint; }))
      return refuse(Code::duplicate, left, "is given twice");
    found.columns = right.empty() ? guess(joint) : columns_called(right);
    if (found.columns.size() != kWhole && found.columns.size() != kRows) return refuse_columns(left, right);
    set_unit(found, *unit);
    found_.push_back(std::move(found));
  }

  std::vector<TransformColumns> take() { return std::move(found_); }

 private:
  void refuse(Code code, const std::string& found, const std::string& rule) {
    refuse_option(out_, code, "--transforms", found, rule);
  }

  void refuse_columns(const std::string& joint, const std::string& columns) {
    refuse(Code::unknown_name, columns.empty() ? joint : columns,
           fmt::format("must name 12 or 16 of the {} columns: say \"{}=2-17\" (places of columns, from 1) or \"{}=T\" "
                       "(names T11 ... T44, T1 ... T16, or T_r11 ... T_r33 with T_tx, T_ty, T_tz)",
                       names_.size(), joint, joint));
  }

  /// Takes "[mm]" off the end. Null: there is none; empty: it is no length.
  static std::optional<const ColumnUnit*> take_unit(std::string& text) {
    const std::size_t open = text.rfind('[');
    if (open == std::string::npos || text.back() != ']') return nullptr;
    const ColumnUnit* unit = column_unit(bare_unit(text.substr(open)));
    if (unit == nullptr || unit->angle) return std::nullopt;
    text = std::string(trimmed(text.substr(0, open)));
    return unit;
  }

  std::vector<std::string> known() const {
    std::vector<std::string> names;
    for (const JointDef& joint : scene_.joints) {
      names.push_back(joint.name);
      names.push_back(scene_.bodies[at(joint.child)].name);
    }
    return names;
  }

  int joint_called(const std::string& name) const {
    for (std::size_t j = 0; j < scene_.joints.size(); ++j)
      if (scene_.joints[j].name == name) return static_cast<int>(j);
    for (std::size_t j = 0; j < scene_.joints.size(); ++j)
      if (scene_.bodies[at(scene_.joints[j].child)].name == name) return static_cast<int>(j);
    return -1;
  }

  Places columns_called(const std::string& text) const {
    const auto places = places_of(text);
    if (!places) return beginning_with(text);
    return !places->empty() && places->back() < names_.size() ? *places : Places();
  }

  Places guess(int joint) const {
    for (const std::string& name :
         {scene_.joints[at(joint)].name, scene_.bodies[at(scene_.joints[at(joint)].child)].name})
      if (Places found = beginning_with(name); !found.empty()) return found;
    Places all;
    const auto time = names_.time();
    for (std::size_t c = 0; c < names_.size(); ++c)
      if (c != time) all.push_back(c);
    return all;
  }

  Places beginning_with(const std::string& prefix) const {
    std::map<std::string, std::size_t> at_index;
    for (std::size_t c = 0; c < names_.size(); ++c) {
      const std::string& name = names_.label(c, false).path;
      if (name.size() > prefix.size() && name.starts_with(prefix))
        at_index.emplace(index_of(name.substr(prefix.size())), c);
    }
    for (const std::size_t count : {kWhole, kRows})
      for (const Style style : kStyles) {
        Places places;
        for (std::size_t k = 0; k < count; ++k)
          if (const auto it = at_index.find(index_in(style, k)); it != at_index.end()) places.push_back(it->second);
        if (places.size() == count) return places;
      }
    return {};
  }

  void set_unit(TransformColumns& found, const ColumnUnit* said) const {
    const ColumnUnit* named = names_.label(found.columns[3], false).unit;
    const ColumnUnit* unit = said != nullptr ? said : named != nullptr && !named->angle ? named : nullptr;
    found.how =
        said != nullptr ? "--transforms" : "--transforms, unit: " + (unit != nullptr ? "its name" : length_.why);
    found.assumed = unit == nullptr && length_.assumed;
    if (unit == nullptr) unit = length_.unit;
    found.unit = unit->si;
    found.unit_name = unit->name;
  }

  const SceneTables& scene_;
  const ColumnNames& names_;
  const OtherUnit& length_;
  Diagnostics& out_;
  std::vector<TransformColumns> found_;
};

}  // namespace

std::vector<TransformColumns> match_transforms(const SceneTables& scene, const ColumnNames& names,
                                               const std::string& option, const OtherUnit& length, Diagnostics& out) {
  TransformMatcher matcher(scene, names, length, out);
  for (std::size_t begin = 0; begin < option.size();) {
    const std::size_t end = std::min(option.find(',', begin), option.size());
    matcher.read(option.substr(begin, end - begin));
    begin = end + 1;
  }
  return matcher.take();
}

}  // namespace genu
