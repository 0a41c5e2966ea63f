#include "genu/calibrate/laxity_target.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "genu/assemble/long_errors.h"
#include "genu/assemble/pose_file.h"
#include "genu/calibrate/finite_number.h"
#include "genu/core/units.h"
#include "genu/scene/words.h"

namespace genu {

void LaxityTarget::add(double flexion, LaxityTest::Kind kind, double load, const std::string& column, double value) {
  const auto same_curve = [&](const Curve& c) { return c.flexion == flexion && c.kind == kind; };
  auto curve = std::find_if(curves.begin(), curves.end(), same_curve);
  if (curve == curves.end()) curve = curves.insert(curves.end(), {flexion, kind, {}});
  if (load != 0 && std::find(curve->loads.begin(), curve->loads.end(), load) == curve->loads.end())
    curve->loads.push_back(load);
  auto named = std::find(columns.begin(), columns.end(), column);
  if (named == columns.end()) named = columns.insert(columns.end(), column);
  values.push_back({static_cast<std::size_t>(curve - curves.begin()), load,
                    static_cast<std::size_t>(named - columns.begin()), value});
}

void LaxityTarget::arrange() {
  std::vector<std::size_t> order(curves.size()), place(curves.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return curves[a].flexion != curves[b].flexion ? curves[a].flexion < curves[b].flexion
                                                  : curves[a].kind < curves[b].kind;
  });
  std::vector<Curve> sorted;
  for (std::size_t k = 0; k < order.size(); ++k) {
    place[order[k]] = k;
    sorted.push_back(curves[order[k]]);
    std::sort(sorted.back().loads.begin(), sorted.back().loads.end(),
              [](double a, double b) { return (a > 0) != (b > 0) ? a > 0 : std::abs(a) < std::abs(b); });
  }
  curves = std::move(sorted);
  for (Value& v : values) v.curve = place[v.curve];
}

namespace {

class LaxityReader {
 public:
  LaxityReader(const PoseFile& file, Diagnostics& out) : file_(file), errors_(file.path, out) {}

  void choose(const std::vector<std::string>& patterns, const std::vector<std::string>& known) {
    flexion_ = column("flexion_deg");
    test_ = column("test");
    loads_[0] = column("load_N");
    loads_[1] = column("load_Nm");
    for (const auto& [found, name] : {std::pair(flexion_, "flexion_deg"), std::pair(test_, "test")})
      if (!found) errors_.add({file_.names.line, 1}, Code::missing_key, name, {}, "is missing: a laxity table has it");
    for (std::size_t c = 0; c < file_.names.cells.size(); ++c) choose_column(c, patterns, known);
    for (const std::string& pattern : patterns)
      if (std::none_of(file_.names.cells.begin(), file_.names.cells.end(),
                       [&](const PoseFile::Cell& cell) { return matches(pattern, cell.text); }))
        errors_.add({file_.names.line, 1}, Code::unknown_name, "--columns", with_quotes(pattern),
                    "is no column of the target");
    if (errors_.count() == 0 && followed_.empty())
      errors_.add({file_.names.line, 1}, Code::missing_key, {}, {},
                  "has no column to follow: displacement_mm, displacement_deg, or those that --columns names");
  }

  std::vector<std::size_t> used() const {
    std::vector<std::size_t> out = followed_;
    for (const auto& c : {flexion_, test_, loads_[0], loads_[1]})
      if (c) out.push_back(*c);
    return out;
  }

  std::optional<LaxityTarget> read() {
    if (errors_.count() > 0) return std::nullopt;
    refuse_two_scenes();
    for (const PoseFile::Row& row : file_.rows) add_row(row);
    if (errors_.count() == 0 && target_.values.empty())
      errors_.add({file_.names.line, 1}, Code::missing_key, {}, {}, "holds no values below its column names");
    if (errors_.count() > 0) return std::nullopt;
    target_.arrange();
    return std::move(target_);
  }

 private:
  std::optional<std::size_t> column(const std::string& name) const {
    for (std::size_t c = 0; c < file_.names.cells.size(); ++c)
      if (file_.names.cells[c].text == name) return c;
    return std::nullopt;
  }

  void choose_column(std::size_t c, const std::vector<std::string>& patterns, const std::vector<std::string>& known) {
    const std::string& name = file_.names.cells[c].text;
    const bool displacement = name == kDisplacementColumns[0] || name == kDisplacementColumns[1];
    const bool asked = std::any_of(patterns.begin(), patterns.end(),
                                   [&](const std::string& pattern) { return matches(pattern, name); });
    const bool is_known = std::find(known.begin(), known.end(), name) != known.end();
    if (patterns.empty() ? displacement : asked && (displacement || is_known))
      followed_.push_back(c);
    else if (asked && !is_known)
      errors_.add({file_.names.line, file_.names.cells[c].column}, Code::unknown_name, name, {},
                  "is no column of this scene's results.csv" + did_you_mean(name, known));
  }

  void refuse_two_scenes() {
    const auto scene = column("scene");
    if (!scene) return;
    for (const PoseFile::Row& row : file_.rows)
      if (row.cells[*scene].text != file_.rows.front().cells[*scene].text) {
        errors_.add({row.line, row.cells[*scene].column}, Code::conflict, "scene", with_quotes(row.cells[*scene].text),
                    "is a second scene: a target is of one, keep the rows of " +
                        with_quotes(file_.rows.front().cells[*scene].text));
        return;
      }
  }

  std::optional<double> number(const PoseFile::Row& row, std::size_t c) {
    const PoseFile::Cell& cell = row.cells[c];
    const auto value = finite_number(cell.text);
    if (!value)
      errors_.add(
          {row.line, cell.column}, Code::out_of_range, file_.names.cells[c].text, with_quotes(cell.text),
          has_decimal_comma(cell.text) ? file_.no_number(cell.text) : "must be a finite number, of at most 1e20");
    return value;
  }

  /// The load of a row; empty where it is missing, which is said.
  std::optional<double> load_of(const PoseFile::Row& row, LaxityTest::Kind kind) {
    const auto c = loads_[kind == LaxityTest::Kind::drawer ? 0 : 1];
    if (c && !row.cells[*c].text.empty()) return number(row, *c);
    errors_.add({row.line, 1}, Code::missing_key, kind == LaxityTest::Kind::drawer ? "load_N" : "load_Nm", {},
                "is missing: each row of a test has its load");
    return std::nullopt;
  }

  void add_row(const PoseFile::Row& row) {
    const std::string& name = row.cells[*test_].text;
    const bool neutral = name == "neutral";
    auto kind = LaxityTest::Kind::drawer;
    bool found = neutral;
    for (std::size_t k = 0; k < kLaxityTests && !found; ++k) {
      kind = static_cast<LaxityTest::Kind>(k);
      found = name == LaxityTest{kind, 0}.name();
    }
    if (!found)
      errors_.add({row.line, row.cells[*test_].column}, Code::unknown_name, "test", with_quotes(name),
                  "is none of \"drawer\", \"varus-valgus\", \"rotation\", \"neutral\"");
    const auto flexion = number(row, *flexion_);
    if (!found || !flexion) return;
    const auto load = neutral ? std::optional(0.0) : load_of(row, kind);
    if (!load) return;
    for (const std::size_t c : followed_) {
      const std::string& column = file_.names.cells[c].text;
      const bool displacement = column == kDisplacementColumns[0] || column == kDisplacementColumns[1];
      if (row.cells[c].text.empty() || (displacement && *load == 0)) continue;
      if (displacement && (column == kDisplacementColumns[1]) != LaxityTest{kind, 0}.turns()) continue;
      if (const auto value = number(row, c)) target_.add(units::kDegree * *flexion, kind, *load, column, *value);
    }
  }

  const PoseFile& file_;
  LongErrors errors_;
  std::optional<std::size_t> flexion_, test_, loads_[2];
  std::vector<std::size_t> followed_;
  LaxityTarget target_;
};

}  // namespace

bool is_laxity_table(const std::string& path) {
  Diagnostics unused;
  const auto file = read_pose_file(path, unused);
  if (!file) return false;
  const auto has = [&](const char* name) {
    return std::any_of(file->names.cells.begin(), file->names.cells.end(),
                       [&](const PoseFile::Cell& cell) { return cell.text == name; });
  };
  return has("test") && has("flexion_deg");
}

std::optional<LaxityTarget> read_laxity_target(const std::string& path, const std::vector<std::string>& patterns,
                                               const std::vector<std::string>& known, Diagnostics& out) {
  const auto file = read_pose_file(path, out);
  if (!file) return std::nullopt;
  LaxityReader reader(*file, out);
  reader.choose(patterns, known);
  const std::size_t before = out.count(Diagnostic::Severity::error);
  refuse_repeated_names(*file, reader.used(), out);
  if (out.count(Diagnostic::Severity::error) > before) return std::nullopt;
  return reader.read();
}

}  // namespace genu
