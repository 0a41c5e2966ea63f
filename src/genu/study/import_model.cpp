#include "genu/study/import_model.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "genu/assemble/opensim_names.h"
#include "genu/assemble/pose_file.h"
#include "genu/core/atomic_output.h"
#include "genu/core/units.h"
#include "genu/osim/read_model.h"
#include "genu/scene/reader.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

std::optional<double> number_in(const std::string& word) {
  double value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// A file of named columns, and its row.
struct TableRow {
  PoseFile file;
  const PoseFile::Row& row(int number) const { return file.rows[static_cast<std::size_t>(number - 1)]; }
};

std::optional<TableRow> read_row(const std::string& path, int row, Diagnostics& out) {
  auto file = read_pose_file(path, out);
  if (!file) return std::nullopt;
  if (row >= 1 && static_cast<std::size_t>(row) <= file->rows.size()) return TableRow{std::move(*file)};
  out.add(error_at({}, Code::out_of_range, "--row", fmt::format("{}", row),
                   fmt::format("must be a row of {}, which has 1 to {}", path, file->rows.size())));
  return std::nullopt;
}

/// The number in a cell; an error where it is none.
std::optional<double> number_at(const TableRow& table, int row, std::size_t column, Diagnostics& out) {
  const PoseFile::Cell& cell = table.row(row).cells[column];
  const auto value = number_in(cell.text);
  if (!value)
    out.add(error_at({table.file.path, {table.row(row).line, cell.column}}, Code::wrong_form,
                     table.file.names.cells[column].text, cell.text, "is no finite number"));
  return value;
}

/// Coordinates of the model in the row, in rad and m.
osim::CoordinateValues read_pose(const osim::Model& model, const ModelImport& asked,
                                 const std::optional<TableRow>& table, Diagnostics& out) {
  osim::CoordinateValues values;
  if (!table) return values;
  std::set<std::string> known;
  for (const osim::Joint& joint : model.joints)
    for (const osim::Coordinate& c : joint.coordinates) known.insert(c.name);
  const bool degrees = table->file.angles.degrees.value_or(false);
  for (std::size_t c = 0; c < table->file.names.cells.size(); ++c) {
    const std::string name = last_part_of_path(table->file.names.cells[c].text);
    if (known.count(name) == 0) continue;
    const auto value = number_at(*table, asked.row, c, out);
    if (value) values[name] = *value * (degrees && osim::is_angle(model, name) ? units::kDegree : 1);
  }
  if (values.empty() && !out.has_errors())
    out.error(Code::missing_key, asked.pose, "has no column that is a coordinate of " + asked.model);
  return values;
}

/// Muscle forces in the row, N.
std::map<std::string, double> read_tensions(const osim::Model& model, const ModelImport& asked,
                                            const std::optional<TableRow>& table, Diagnostics& out) {
  std::map<std::string, double> tensions;
  if (!table) return tensions;
  std::set<std::string> known;
  for (const osim::Muscle& m : model.muscles) known.insert(m.name);
  for (std::size_t c = 0; c < table->file.names.cells.size(); ++c) {
    std::string path = table->file.names.cells[c].text;
    for (const char* quantity : {"/actuation", "/tendon_force", "/tension"})
      if (path.ends_with(quantity)) path.resize(path.size() - std::string(quantity).size());
    const std::string name = osim::last_name(path);
    if (known.count(name) == 0) continue;
    const auto value = number_at(*table, asked.row, c, out);
    if (value) tensions[name] = *value;
  }
  if (tensions.empty() && !out.has_errors())
    out.error(Code::missing_key, asked.forces, "has no column that is a muscle of " + asked.model);
  return tensions;
}

/// The cell of the column `time`, where the file has one.
const PoseFile::Cell* time_of(const std::optional<TableRow>& table, int row) {
  if (!table) return nullptr;
  const auto& names = table->file.names.cells;
  const auto time =
      std::find_if(names.begin(), names.end(), [](const PoseFile::Cell& cell) { return cell.text == "time"; });
  return time == names.end() ? nullptr : &table->row(row).cells[static_cast<std::size_t>(time - names.begin())];
}

/// One row of two files is one moment.
void refuse_different_times(const std::optional<TableRow>& pose, const std::optional<TableRow>& forces,
                            const ModelImport& asked, Diagnostics& out) {
  const PoseFile::Cell *here = time_of(forces, asked.row), *there = time_of(pose, asked.row);
  if (here == nullptr || there == nullptr) return;
  const auto of_forces = number_in(here->text), of_pose = number_in(there->text);
  if (of_forces && of_pose && std::abs(*of_forces - *of_pose) <= kSameMoment) return;
  out.add(error_at({asked.forces, {forces->row(asked.row).line, here->column}}, Code::conflict, "time", here->text,
                   fmt::format("is not the time of row {} of {}, {}: --row counts in both files", asked.row, asked.pose,
                               there->text)));
}

/// Coordinates and muscle forces of the files beside the model.
void read_tables(const osim::Model& model, const ModelImport& asked, osim::CoordinateValues& values,
                 std::map<std::string, double>& tensions, Diagnostics& out) {
  std::optional<TableRow> pose, forces;
  if (!asked.pose.empty()) pose = read_row(asked.pose, asked.row, out);
  if (!asked.forces.empty()) forces = read_row(asked.forces, asked.row, out);
  refuse_different_times(pose, forces, asked, out);
  values = read_pose(model, asked, pose, out);
  tensions = read_tensions(model, asked, forces, out);
}

/// Folders where a mesh of the model may be.
std::vector<fs::path> folders_of(const ModelImport& asked) {
  std::vector<fs::path> folders;
  if (!asked.geometry.empty()) folders.emplace_back(asked.geometry);
  const fs::path beside = fs::path(asked.model).parent_path();
  folders.push_back(beside.empty() ? "." : beside);
  folders.push_back(beside / "Geometry");
  return folders;
}

/// The file as a scene in `folder` names it.
std::string seen_from(const fs::path& file, const std::string& folder) {
  std::error_code failed;
  const fs::path from = fs::weakly_canonical(fs::absolute(folder, failed), failed),
                 to = fs::weakly_canonical(fs::absolute(file, failed), failed);
  const fs::path relative = to.lexically_relative(from);
  return (relative.empty() ? to : relative).string();
}

/// Where a mesh is; empty, with an error that lists the places, where it is in none.
std::string find_mesh(const osim::NeededMesh& mesh, const ModelImport& asked, Diagnostics& out) {
  std::string name = mesh.file;
  for (char& c : name)
    if (c == '\\') c = '/';  // written on Windows
  std::string places;
  for (const fs::path& folder : folders_of(asked)) {
    const fs::path file = folder / name;
    std::error_code failed;
    if (fs::is_regular_file(file, failed)) return seen_from(file, asked.folder);
    places += (places.empty() ? "" : ", ") + file.string();
    if (fs::path(name).is_absolute()) break;
  }
  out.add(error_at({asked.model, mesh.where}, Code::no_such_file, "mesh_file", mesh.file,
                   "is not there: looked for " + places + "; --geometry names another folder"));
  return {};
}

std::map<std::string, std::string> find_meshes(const osim::Model& model, const osim::Skeleton& skeleton,
                                               const ModelImport& asked, Diagnostics& out) {
  std::map<std::string, std::string> found;
  for (const osim::NeededMesh& mesh : osim::needed_meshes(model, skeleton)) {
    if (mesh.scaled)
      out.add(error_at({asked.model, mesh.where}, Code::not_built, "mesh_file", mesh.file,
                       "is stretched by scale_factors, which a scene cannot: scale the file, and write 1 1 1"));
    if (found.count(mesh.file) == 0) found[mesh.file] = find_mesh(mesh, asked, out);
  }
  return found;
}

/// Reads the scene before it takes its place: what a scene cannot have is found now, not later, and said of the model,
/// for the scene is not kept.
void check_written(const fs::path& written, const ImportReport& report, const std::string& model, Diagnostics& out) {
  Diagnostics found;
  const auto scene = read_scene(written.string(), found);
  for (Diagnostic d : found.items()) {
    if (d.file == written.string()) d.file = report.file;
    if (!scene)
      d = error_at({model, {}}, d.code, "line " + std::to_string(d.line) + " of its scene: " + d.key, d.found, d.rule);
    if (!scene || d.severity == Diagnostic::Severity::warning) out.add(std::move(d));
  }
}

/// Empty, or why the files cannot be written.
std::string write_files(const osim::ImportedScene& scene, const StagedFolder& staged) {
  const std::string error = write_file_atomically(staged.path() / "scene.toml", scene.text);
  return error.empty() ? write_file_atomically(staged.path() / "import.csv", scene.table) : error;
}

}  // namespace

std::optional<ImportReport> import_model(const ModelImport& asked, Diagnostics& out) {
  const auto model = osim::read_model(asked.model, out);
  if (!model) return std::nullopt;
  osim::CoordinateValues values;
  osim::SceneRequest request;
  read_tables(*model, asked, values, request.tensions, out);
  if (out.has_errors()) return std::nullopt;
  const auto skeleton = osim::Skeleton::build(*model, asked.joints, values, out);
  if (!skeleton) return std::nullopt;
  request.meshes = find_meshes(*model, *skeleton, asked, out);
  if (out.has_errors()) return std::nullopt;
  ImportReport report;
  report.coordinates = values.size();
  report.tensions = request.tensions.size();
  report.scene = osim::import_scene(*model, *skeleton, request);
  report.file = (fs::path(asked.folder) / "scene.toml").string();
  StagedFolder staged("");  // it will be edited: never to be replaced
  if (const auto refused = staged.open(asked.folder)) {
    out.error(refused->code, {}, refused->text);
    return std::nullopt;
  }
  std::string error = write_files(report.scene, staged);
  if (error.empty()) check_written(staged.path() / "scene.toml", report, asked.model, out);
  if (out.has_errors()) return std::nullopt;
  if (error.empty()) error = staged.commit();
  report.written = error.empty();
  if (!report.written) out.error(Code::cannot_write, {}, error);
  return report;
}

}  // namespace genu
