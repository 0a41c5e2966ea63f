#include "genu/assemble/given_poses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "genu/assemble/long_errors.h"
#include "genu/assemble/rigid_transform.h"
#include "genu/assemble/tolerances.h"
#include "genu/core/units.h"
#include "genu/mesh_files/text_words.h"
#include "genu/scene/tolerances.h"

namespace genu {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kTurn = 2 * std::numbers::pi;

class GivenPosesReader {
 public:
  GivenPosesReader(const SceneTables& scene, const PoseFile& file, const PoseColumns& columns, Diagnostics& out)
      : scene_(scene), file_(file), columns_(columns), errors_(file.path, out), out_(out) {
    for (const JointDef& joint : scene.joints) held_.push_back(joint.reference);
    largest_.resize(columns.coordinates.size());
  }

  std::optional<GivenPoses> read() {
    if (!time_is_known()) return std::nullopt;
    for (const PoseFile::Row& row : file_.rows) {
      ++rows_;
      const bool solved = !columns_.status || row.cells[*columns_.status].text == "ok" ||
                          row.cells[*columns_.status].text == "undetermined";
      if (solved)
        add(row);
      else
        ++given_.left_out;
    }
    if (errors_.count() > 0) return std::nullopt;
    warn_held();
    for (std::size_t k = 0; k < largest_.size(); ++k) warn_unit(columns_.coordinates[k], largest_[k]);
    if (given_.poses.empty()) {
      out_.error(Code::not_solved, file_.path, "holds no pose that was solved: the status of every row says so");
      return std::nullopt;
    }
    return std::move(given_);
  }

 private:
  bool time_is_known() const {
    const auto load = std::find_if(scene_.loads.begin(), scene_.loads.end(), [](const auto& l) { return l.in_time(); });
    if (columns_.time || load == scene_.loads.end()) return true;
    out_.error(
        Code::missing_key, file_.path,
        "has no column time, over which load." + load->name + " changes: name it so, or say --columns \"time=COLUMN\"");
    return false;
  }

  /// Finite and not beyond `largest` in SI; NaN otherwise, and said.
  double number(const PoseFile::Row& row, std::size_t column, double unit, double largest) {
    const PoseFile::Cell& cell = row.cells[column];
    const std::string& name = file_.names.cells[column].text;
    double value = 0;
    const auto refuse = [&](Code code, const std::string& rule) {
      errors_.add({row.line, cell.column}, code, name, in_quotes(cell.text), rule);
      return kNone;
    };
    if (cell.text.empty()) return refuse(Code::wrong_form, "is empty: a number is expected");
    if (!TextWords::number(cell.text, value)) {
      if (has_decimal_comma(cell.text) && std::exchange(comma_refused_, true)) return kNone;  // said once a file
      return refuse(Code::wrong_form, file_.no_number(cell.text));
    }
    if (!std::isfinite(value)) return refuse(Code::out_of_range, "must be a finite number");
    if (!(std::abs(unit * value) <= largest)) return refuse(Code::out_of_range, "is too large for a joint");
    return unit * value;
  }

  void add(const PoseFile::Row& row) {
    GivenPose pose;
    pose.coordinates = held_;
    for (std::size_t k = 0; k < largest_.size(); ++k) {
      const PoseColumns::Match& m = columns_.coordinates[k];
      const double value = number(row, m.column, m.unit, m.coordinate.index < 3 ? kMaxAngle : kMaxLength);
      pose.coordinates[at(m.coordinate.joint)][at(m.coordinate.index)] = value;
      if (std::abs(value) > std::abs(largest_[k].value)) largest_[k] = {value, &row};
    }
    for (const TransformColumns& t : columns_.transforms) add_transform(row, t, pose);
    pose.load_factors.assign(scene_.loads.size(), 1);
    for (const auto& f : columns_.factors)
      pose.load_factors[static_cast<std::size_t>(f.load)] = number(row, f.column, 1, kMaxNumber);
    pose.time = columns_.time ? number(row, *columns_.time, 1, kMaxNumber) : kNone;
    if (columns_.time && !columns_.own_results()) check_time(row, pose.time);
    pose.increment = static_cast<int>(given_.poses.size());
    if (columns_.own_results()) {
      const double step = number(row, *columns_.step, 1, kMaxStepNumber),
                   increment = number(row, *columns_.increment, 1, kMaxStepNumber);
      if (std::isfinite(step + increment)) {
        pose.step = static_cast<int>(step);
        pose.increment = static_cast<int>(increment);
      }
    }
    given_.poses.push_back(std::move(pose));
  }

  void add_transform(const PoseFile::Row& row, const TransformColumns& t, GivenPose& pose) {
    constexpr std::size_t kMatrixColumns = 4;
    const JointDef& joint = scene_.joints[at(t.joint)];
    Mat4 transform = Mat4::Identity();
    for (std::size_t k = 0; k < t.columns.size(); ++k) {
      const bool length = k % kMatrixColumns == 3 && k < 3 * kMatrixColumns;
      transform(static_cast<int>(k / kMatrixColumns), static_cast<int>(k % kMatrixColumns)) =
          number(row, t.columns[k], length ? t.unit : 1, length ? kMaxLength : kMaxNumber);
    }
    if (!transform.allFinite()) return;
    const SourceLocation where{row.line, row.cells[t.columns[0]].column};
    if (const std::string fault = fault_of_transform(transform); !fault.empty())
      return errors_.add(where, Code::wrong_form, fmt::format("transform of {} in row {}", joint.name, rows_), {},
                         fault);
    const Pose X_PC = pose_of_transform(transform);
    if (t.assumed && X_PC.p.norm() > kMostTranslation && !std::exchange(far_said_, true))
      errors_.warn(where, Code::unlikely, "transform of " + joint.name, {},
                   fmt::format("moves by {:.3g} m, as no unit of its translation is said: was mm meant? Then say [mm] "
                               "after its columns in --transforms, or --units mm",
                               X_PC.p.norm()));
    const JointValues& near = given_.poses.empty() ? joint.reference : given_.poses.back().coordinates[at(t.joint)];
    const JointValues found = JointCoordinates(joint).coordinates(X_PC, near);
    for (int i = 0; i < 6; ++i)
      if (joint.leaves(i))
        pose.coordinates[at(t.joint)][at(i)] = found[at(i)];
      else
        note_held(i < 3, std::abs(found[at(i)] - joint.reference[at(i)]), joint, where);
  }

  /// How far transforms are from what a joint holds.
  struct HeldMiss {
    double angle = 0, length = 0;  ///< rad, m
    const JointDef* joint = nullptr;
    SourceLocation where;
  };

  void note_held(bool angle, double miss, const JointDef& joint, SourceLocation where) {
    double& largest = angle ? held_miss_.angle : held_miss_.length;
    if (miss <= largest) return;
    largest = miss;
    held_miss_.joint = &joint;
    held_miss_.where = where;
  }

  void warn_held() {
    if (held_miss_.angle <= kHeldAngle && held_miss_.length <= kHeldLength) return;
    errors_.warn(held_miss_.where, Code::no_effect, "transform of " + held_miss_.joint->name, {},
                 fmt::format("is up to {:.3g} deg and {:.3g} mm away from what the joint holds, which is taken",
                             to::kDegree * held_miss_.angle, to::kMillimetre * held_miss_.length));
  }

  /// A path by arc length turns back, and its time with it: not called for those.
  void check_time(const PoseFile::Row& row, double time) {
    const PoseFile::Cell& cell = row.cells[*columns_.time];
    const std::string& name = file_.names.cells[*columns_.time].text;
    const double before = given_.poses.empty() ? -std::numeric_limits<double>::infinity() : given_.poses.back().time;
    if (time < before)
      errors_.add({row.line, cell.column}, Code::out_of_range, name, cell.text,
                  fmt::format("must be > {:g}, the time before it", before));
    else if (time == before)
      errors_.warn({row.line, cell.column}, Code::duplicate, name, cell.text,
                   fmt::format("is the time of the row in line {}, too: both are taken", line_before_));
    line_before_ = row.line;
  }

  struct Largest {
    double value = 0;  ///< SI
    const PoseFile::Row* row = nullptr;
  };

  /// Angles beyond a turn and translations of metres are probably in another unit.
  void warn_unit(const PoseColumns::Match& m, const Largest& largest) {
    const double size = std::abs(largest.value);
    const bool angle = m.coordinate.index < 3;
    if (angle ? size <= kTurn : !m.assumed || size <= kMostTranslation) return;
    const bool in_degrees = angle && m.unit != units::kRadian;
    if (in_degrees && columns_.own_results()) return;  // a joint that has turned so far
    const PoseFile::Cell& cell = largest.row->cells[m.column];
    const std::string& name = file_.names.cells[m.column].text;
    const std::string much =
        angle ? fmt::format("{:.3g} turns", size / kTurn) : fmt::format("{:.3g} mm", to::kMillimetre * largest.value);
    const char* meant = angle ? "deg" : "mm";
    const std::string advice = in_degrees
                                   ? "check that it is the right column"
                                   : fmt::format("was {} meant? Then say --units {}, or --columns \"{}={}[{}]\"", meant,
                                                 meant, coordinate_name(scene_, m.coordinate), name, meant);
    errors_.warn({largest.row->line, cell.column}, Code::unlikely, name, cell.text,
                 fmt::format("is read in {} ({}), which makes {}: {}", m.unit_name, m.how, much, advice));
  }

  const SceneTables& scene_;
  const PoseFile& file_;
  const PoseColumns& columns_;
  LongErrors errors_;
  Diagnostics& out_;
  std::vector<JointValues> held_;
  std::vector<Largest> largest_;  ///< of each of columns_.coordinates
  int line_before_ = 0;
  HeldMiss held_miss_;
  std::size_t rows_ = 0;  ///< read until now
  bool comma_refused_ = false, far_said_ = false;
  GivenPoses given_;
};

}  // namespace

std::optional<GivenPoses> read_given_poses(const SceneTables& scene, const PoseFile& file, const PoseColumns& columns,
                                           Diagnostics& out) {
  return GivenPosesReader(scene, file, columns, out).read();
}

}  // namespace genu
