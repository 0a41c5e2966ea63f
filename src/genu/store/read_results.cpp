#include "genu/store/read_results.h"

#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "genu/assemble/given_poses.h"
#include "genu/assemble/long_errors.h"
#include "genu/core/units.h"
#include "genu/mesh_files/text_words.h"
#include "genu/results/columns.h"
#include "genu/results/wrap_columns.h"
#include "genu/store/tolerances.h"

namespace genu {
namespace {

bool holds_pose(const std::string& status) { return status == "ok" || status == "undetermined"; }

/// Takes the rows without a pose out of `file`; the numbers of those that stay.
std::vector<std::size_t> keep_poses(PoseFile& file, std::size_t status) {
  std::vector<std::size_t> numbers;
  std::vector<PoseFile::Row> kept;
  for (std::size_t r = 0; r < file.rows.size(); ++r) {
    if (!holds_pose(file.rows[r].cells[status].text)) continue;
    numbers.push_back(r + 1);
    kept.push_back(std::move(file.rows[r]));
  }
  file.rows = std::move(kept);
  return numbers;
}

ResultTable table_of(const PoseFile& file, Diagnostics& out) {
  LongErrors errors(file.path, out);
  ResultTable table;
  for (const PoseFile::Cell& cell : file.names.cells) table.add_column(cell.text);
  for (const PoseFile::Row& row : file.rows) {
    table.add_row();
    for (std::size_t c = 0; c < row.cells.size(); ++c) {
      const PoseFile::Cell& cell = row.cells[c];
      const std::string& name = table.columns()[c];
      double value = 0;
      if (name == "status" || name == "stability")
        table.set(c, cell.text);
      else if (TextWords::number(cell.text, value) && std::isfinite(value))
        table.set(c, value);
      else if (!cell.text.empty())
        errors.add({row.line, cell.column}, Code::wrong_form, name, in_quotes(cell.text), "is no finite number");
    }
  }
  return table;
}

class RigidContacts {
 public:
  RigidContacts(const Prepared& prepared, const ResultTable& table) : p_(prepared), table_(table) {}

  /// Those that carry load in a row.
  std::vector<ActiveContact> in_row(std::size_t row) {
    std::vector<ActiveContact> found;
    for (std::size_t pair = 0; pair < p_.model.pairs.size(); ++pair) {
      const std::string& name = p_.model.pairs[pair].name;
      if (!table_.has_column(name + ".1.force_N")) {
        add(row, pair, 1, name, found);
        continue;
      }
      for (int k = 1; table_.has_column(fmt::format("{}.{}.force_N", name, k)); ++k)
        add(row, pair, k, fmt::format("{}.{}", name, k), found);
    }
    return found;
  }

  /// An error where a contact is nowhere where it should be.
  void tell_lost(const std::string& file, Diagnostics& out) const {
    for (const auto& [name, rows] : lost_) {
      const bool always = rows == loaded_.at(name);
      const auto severity = always ? Diagnostic::Severity::error : Diagnostic::Severity::warning;
      out.add({severity,
               Code::other_scene,
               {file},
               name,
               {},
               fmt::format("lies off its surface in {} row{}{}", rows, rows == 1 ? "" : "s",
                           always ? ", all in which it carries load: do these results belong to this scene?"
                                  : ", and is left out there: has the scene changed?")});
    }
  }

 private:
  void add(std::size_t row, std::size_t pair, int number, const std::string& name, std::vector<ActiveContact>& found) {
    const std::string force = name + ".force_N";
    if (!table_.has_column(force) || !(table_.number(row, force) > 0)) return;
    ++loaded_[name];
    ActiveContact c{static_cast<int>(pair), number, {}, table_.number(row, force)};
    const JointModel::Pair& both = p_.model.pairs[pair];
    const auto put = [&](bool second, const Surface& surface, int body, SurfacePoint& at_surface) {
      Vec3 x;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::string column = name + "." + point_column(p_.scene, pair, second, i);
        if (!table_.has_column(column)) return false;
        x[static_cast<Eigen::Index>(i)] = units::kMillimetre * table_.number(row, column);
      }
      x -= p_.model.bodies[at(body)].centre;
      return x.allFinite() && surface.project(x, at_surface) && (at_surface.p - x).norm() < kSameSurface;
    };
    if (put(false, *both.a, both.body_a, c.geometry.a) && put(true, *both.b, both.body_b, c.geometry.b))
      found.push_back(c);
    else
      ++lost_[name];
  }

  const Prepared& p_;
  const ResultTable& table_;
  std::map<std::string, int> lost_, loaded_;  // rows of each contact
};

}  // namespace

std::optional<ResultsRead> read_results(const SceneSource& scene, const std::string& text, const std::string& file,
                                        Diagnostics& out) {
  auto prepared = prepare(scene, out);
  auto words = parse_pose_file(text, file, out);
  if (!prepared || !words) return std::nullopt;
  const auto columns = match_columns(prepared->scene, *words, {}, out);
  if (!columns) return std::nullopt;
  if (!columns->own_results()) {
    out.error(Code::no_results, file, "has no columns step, increment and status: it is no results.csv of genu");
    return std::nullopt;
  }
  std::vector<std::size_t> all(words->names.cells.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  refuse_repeated_names(*words, all, out);
  if (out.has_errors()) return std::nullopt;
  ResultsRead read;
  const std::size_t rows = words->rows.size();
  read.numbers = keep_poses(*words, *columns->status);
  read.left_out = rows - read.numbers.size();
  const auto given = read_given_poses(prepared->scene, *words, *columns, out);
  read.solution.poses = table_of(*words, out);
  if (!given || out.has_errors()) return std::nullopt;
  read.prepared = std::move(*prepared);
  RigidContacts contacts(read.prepared, read.solution.poses);
  for (std::size_t row = 0; row < given->poses.size(); ++row) {
    const GivenPose& pose = given->poses[row];
    PoseRecord& record = read.solution.records.emplace_back();
    record.point.step = pose.step;
    record.point.increment = pose.increment;
    record.point.target.time = pose.time;
    record.point.target.load_factors = pose.load_factors;
    State& state = record.point.pose.state;
    state.coordinates = pose.coordinates;
    state.poses = poses_from_coordinates(read.prepared.model, pose.coordinates);
    settle_shown_wraps(read.prepared.model, state);
    state.contacts = contacts.in_row(row);
  }
  contacts.tell_lost(file, out);
  if (out.has_errors()) return std::nullopt;
  read.solution.summary = begin_summary(read.prepared);
  return read;
}

}  // namespace genu
