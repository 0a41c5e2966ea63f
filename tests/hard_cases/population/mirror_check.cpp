#include "hard_cases/population/mirror_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "hard_cases/population/knee_files.h"

namespace genu::population {
namespace {

/// How far numbers may be apart: of the largest number of their column, and of its unit.
struct Tolerance {
  double share, least;
};
constexpr Tolerance kRounding = {1e-6, 1e-6};
// Of layers, whose sums are to 1e-4 of their load: what small ligaments or the tilt make of that is more.
constexpr Tolerance kQuadrature = {1e-3, 1e-4};
// Nodes of a mesh's fits stand elsewhere in the mirror: the pose alone is told.
constexpr Tolerance kFits = {0.02, 0.05};

/// "medial.force_" and "_N" of "medial.force_x_N"; no axis where the column is no component of a vector in a body.
struct Component {
  std::string before, after;
  int axis = -1;
};

Component component(const std::string& column) {
  for (int axis = 0; axis < 3; ++axis)
    for (const char* const unit : {"_mm", "_N", "_Nm"}) {
      const std::string end = std::string(1, "xyz"[axis]) + unit;
      if (!column.ends_with(end)) continue;
      Component out{column.substr(0, column.size() - end.size()), unit, axis};
      // The joint's translations are told by name.
      if (out.before != "knee.") return out;
    }
  return {};
}

/// Numbers that tell of the way to a pose, not of the pose.
bool of_the_way(const std::string& column) {
  return column == "residual" || column == "newton.iterations" || column.ends_with(".points");
}

class Mirror {
 public:
  Mirror(const Knee& knee, const RunTable& results, const RunTable& mirrored, const BarsOfBoth& bars)
      : a_(results),
        b_(mirrored),
        bars_(bars),
        meshed_(knee.meshed()),
        tolerance_(meshed_               ? kFits
                   : knee.cartilage.soft ? kQuadrature
                                         : kRounding) {}

  std::string compare() const {
    // A mesh that runs through itself is cleaned triangle by triangle, in another order there.
    if (b_.rows.empty()) return meshed_ && leans_on_flaws() ? "" : "in the mirror it is refused";
    // A search that wandered: where it ends, and with which cause, the rounding decides.
    if (common_rows() > 0 && !ok(0) && b_.text(0, "status") != "ok") return "";
    if (meshed_) return compare_poses();
    if (a_.columns.size() != b_.columns.size()) return "in the mirror it has more columns, or fewer";
    for (const std::string& column : a_.columns)  // translations stand in another order there
      if (!b_.has(column)) return "in the mirror it has no column " + column;
    const std::size_t rows = compared_rows();
    if (rows == common_rows() && a_.rows.size() != b_.rows.size())
      return fmt::format("in the mirror it has {} rows, not {}", b_.rows.size(), a_.rows.size());
    for (const std::string& column : a_.columns) {
      if (of_the_way(column)) continue;
      const double scale = largest(column);
      for (std::size_t row = 0; row < rows; ++row)
        if (const std::string wrong = compare_cell(column, row, scale); !wrong.empty()) return wrong;
    }
    return "";
  }

  /// Until both say that a motion costs no force: then the pose is one of many, and which one it is the rounding
  /// decides, for the poses after it too.
  std::size_t compared_rows() const {
    const auto one_of_many = [](const RunTable& table, std::size_t row) {
      return table.text(row, "stability") == "neutral" || table.text(row, "status") == "undetermined";
    };
    std::size_t row = 0;
    if (common_rows() > 0 && !ok(0)) return 0;
    while (row < common_rows() && !(one_of_many(a_, row) && one_of_many(b_, row))) ++row;
    return row;
  }

 private:
  bool leans_on_flaws() const {
    for (std::size_t row = 0; row < a_.rows.size(); ++row)
      if (a_.text(row, "status") == "flawed_mesh") return true;
    return false;
  }

  std::size_t common_rows() const { return std::min(a_.rows.size(), b_.rows.size()); }

  /// Where both found one.
  std::string compare_poses() const {
    for (const char* const column :
         {"knee.flexion_deg", "knee.adduction_deg", "knee.rotation_deg", "knee.x_mm", "knee.y_mm", "knee.z_mm"})
      for (std::size_t row = 0; row < compared_rows(); ++row) {
        if (!ok(row) || b_.text(row, "status") != "ok") continue;
        if (const std::string wrong = compare_cell(column, row, largest(column)); !wrong.empty()) return wrong;
      }
    return "";
  }

  static bool is_number(const std::string& text, double& value) {
    if (text.empty()) return false;
    char* end = nullptr;
    value = std::strtod(text.c_str(), &end);
    return *end == 0;
  }

  bool ok(std::size_t row) const { return a_.text(row, "status") == "ok"; }

  /// Of all three components, where it is one.
  double largest(const std::string& column) const {
    double out = 0, value = 0;
    const Component c = component(column);
    for (std::size_t row = 0; row < a_.rows.size(); ++row)
      for (const char axis : {'x', 'y', 'z'}) {
        const std::string name = c.axis < 0 ? column : c.before + axis + c.after;
        if (ok(row) && is_number(a_.text(row, name), value)) out = std::max(out, std::abs(value));
      }
    return out;
  }

  /// What the mirrored run says, seen in the mirror; false for an empty cell or a word.
  bool seen(const std::string& column, std::size_t row, double& value) const {
    const Component c = component(column);
    if (c.axis < 0) {
      if (!is_number(b_.text(row, column), value)) return false;
      if (column == "knee.x_mm") value = -value;
      return true;
    }
    Vec3 v;
    for (int i = 0; i < 3; ++i)
      if (!is_number(b_.text(row, c.before + "xyz"[i] + c.after), v[i])) return false;
    const View view{true};
    value = (c.after == "_Nm" ? view.turn_back(v) : view.place_back(v))[c.axis];
    return true;
  }

  std::string compare_cell(const std::string& column, std::size_t row, double scale) const {
    double here = 0, there = 0;
    const std::string& text = a_.text(row, column);
    const bool number = is_number(text, here);
    if (number != seen(column, row, there) || (!number && text != b_.text(row, column)))
      return fmt::format("in the mirror row {} has {} {}, not {}", row + 1, column, b_.text(row, column), text);
    if (!number || !ok(row)) return "";
    // Both runs may be off by as much as their bars say.
    const double by_bars = bar(bars_.results, column, row) + bar(bars_.mirrored, column, row);
    const double allowed = std::max(tolerance_.share * scale + tolerance_.least, by_bars);
    if (std::abs(here - there) <= allowed) return "";
    return fmt::format("in the mirror row {} has {} {:.12g}, not {:.12g}", row + 1, column, there, here);
  }

  static double bar(const RunTable& bars, const std::string& column, std::size_t row) {
    double out = 0;
    return row < bars.rows.size() && bars.has(column) && is_number(bars.text(row, column), out) ? out : 0;
  }

  const RunTable &a_, &b_;
  const BarsOfBoth& bars_;
  bool meshed_;
  Tolerance tolerance_;
};

}  // namespace

MirrorVerdict compare_with_mirror(const Knee& knee, const RunTable& results, const RunTable& mirrored,
                                  const BarsOfBoth& bars) {
  const Mirror mirror(knee, results, mirrored, bars);
  return {static_cast<int>(mirror.compared_rows()), mirror.compare()};
}

}  // namespace genu::population
