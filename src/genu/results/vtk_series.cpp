#include "genu/results/vtk_series.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "genu/core/units.h"

namespace genu {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kUnitsTold = "mm, N, MPa";

/// "bone under femur" as a file may be called everywhere.
std::string file_stem(const std::string& name) {
  std::string stem;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    stem += plain ? c : '_';
  }
  return stem;
}

/// A field of one word.
VtkWords one_word(const char* name, const std::string& word) { return {name, {word}}; }

void append(std::vector<double>& values, const Vec3& v) { values.insert(values.end(), v.data(), v.data() + 3); }

VtkCells lines_of(const PlacedScene& scene) {
  std::vector<std::vector<int>> lines;
  int next = 0;
  for (const LigamentDef& l : scene.ligaments) {
    lines.emplace_back();
    for (std::size_t k = 0; k < l.path_points().size(); ++k) lines.back().push_back(next++);
  }
  return vtk_cells(lines);
}

}  // namespace

VtkSeries::VtkSeries(const ReportRun& run, int digits, WriteFile write)
    : run_(run), digits_(digits), write_(std::move(write)), ligament_lines_(lines_of(*run.scene)) {
  for (const JointModel::Body& body : run.model->bodies)
    if (body.moving < 0) origin_ = body.centre;  // all fixed bodies keep one frame
  std::vector<std::string> taken{"ligaments", "contacts"};
  for (const ReportMesh& mesh : run.meshes) {
    std::string file = file_stem(mesh.name);
    while (std::find(taken.begin(), taken.end(), file) != taken.end()) file += '_';
    taken.push_back(file);
    shapes_.push_back({mesh.name, file, vtk_cells(mesh.triangles)});
  }
}

Vec3 VtkSeries::shown(const VtkRow& row, int body, const Vec3& p) const {
  return to::kMillimetre * (run_.body_poses[row.row][at(body)] * p + origin_);
}

double VtkSeries::number_or_nan(const VtkRow& row, const std::string& column) const {
  return run_.poses->has_column(column) ? run_.poses->number(row.row, column) : kNoNumber;
}

std::string VtkSeries::numbered(const std::string& file, const VtkRow& row) const {
  return fmt::format("vtp/{}.{:0{}}.vtp", file, row.number, digits_);
}

void VtkSeries::list(const VtkRow& row, const std::string& name, const std::string& file) {
  const auto place = std::find(parts_.begin(), parts_.end(), name);
  const auto part = static_cast<int>(place - parts_.begin());
  if (place == parts_.end()) parts_.push_back(name);
  entries_.push_back({row.time, part, name, file});
}

std::string VtkSeries::write_part(const std::string& name, const std::string& file, VtkPolyData data,
                                  const VtkRow& row) {
  data.field_data.words.push_back(one_word("units", kUnitsTold));
  data.field_data.numbers.push_back({"row", {static_cast<double>(row.number)}});
  data.field_data.numbers.push_back({"TimeValue", {row.time}});
  const std::string path = numbered(file, row);
  list(row, name, path);
  return write_(path, vtp_text(data));
}

std::string VtkSeries::add_shape(std::size_t k, const VtkRow& row) {
  const ReportMesh& mesh = run_.meshes[k];
  Shape& shape = shapes_[k];
  const TrianglePressures* pressed = nullptr;
  if (mesh.kind == ReportMesh::Kind::surface && mesh.triangles.size() == mesh.triangles_in_full)
    for (const TrianglePressures& p : row.pressures)
      if (run_.scene->surfaces[at(p.surface)].name == mesh.name) pressed = &p;
  const bool rests = run_.model->bodies[at(mesh.body)].moving < 0 && pressed == nullptr;
  const std::string once = fmt::format("vtp/{}.vtp", shape.file);
  if (rests && shape.written) return list(row, shape.name, once), std::string();
  VtkPolyData data;
  data.points.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) data.points.push_back(shown(row, mesh.body, v));
  data.triangles = shape.cells;
  data.field_data.words = {one_word("body", run_.model->bodies[at(mesh.body)].name),
                           one_word(mesh.kind == ReportMesh::Kind::bone ? "bone" : "surface", mesh.name)};
  if (pressed != nullptr) {
    VtkArray pressure{"pressure_MPa", std::vector<double>(mesh.triangles.size())},
        depth{"depth_mm", std::vector<double>(mesh.triangles.size())};
    for (std::size_t t = 0; t < std::min(pressed->pressure.size(), mesh.triangles.size()); ++t) {
      pressure.values[t] = pressed->pressure[t] / units::kMegapascal;
      depth.values[t] = to::kMillimetre * pressed->depth[t];
    }
    data.cell_data.numbers = {std::move(pressure), std::move(depth)};
  }
  if (!rests) return write_part(shape.name, shape.file, std::move(data), row);
  shape.written = true;
  data.field_data.words.push_back(one_word("units", kUnitsTold));
  list(row, shape.name, once);
  return write_(once, vtp_text(data));
}

/// The course of a ligament that wraps, in this row; null for all others.
const std::vector<ReportPath::Point>* VtkSeries::wrapped(const VtkRow& row, std::size_t ligament) const {
  for (const ReportPath& path : run_.wrapped)
    if (at(path.ligament) == ligament && !path.rows[row.row].empty()) return &path.rows[row.row];
  return nullptr;
}

std::string VtkSeries::add_ligaments(const VtkRow& row) {
  if (run_.scene->ligaments.empty()) return {};
  VtkPolyData data;
  if (run_.wrapped.empty()) data.lines = ligament_lines_;
  std::vector<std::vector<int>> lines;
  VtkWords names{"name", {}};
  VtkArray strain{"strain", {}}, force{"force_N", {}}, length{"length_mm", {}};
  for (std::size_t i = 0; i < run_.scene->ligaments.size(); ++i) {
    const LigamentDef& l = run_.scene->ligaments[i];
    const auto first = static_cast<int>(data.points.size());
    if (const auto* path = wrapped(row, i))
      for (const ReportPath::Point& point : *path) data.points.push_back(shown(row, point.body, point.p));
    else
      for (const LigamentDef::End& end : l.path_points()) data.points.push_back(shown(row, end.body, end.point));
    lines.emplace_back();
    for (int k = first; k < static_cast<int>(data.points.size()); ++k) lines.back().push_back(k);
    names.values.push_back(l.name);
    strain.values.push_back(number_or_nan(row, l.name + ".strain"));
    force.values.push_back(number_or_nan(row, l.name + ".force_N"));
    length.values.push_back(number_or_nan(row, l.name + ".length_mm"));
  }
  if (!run_.wrapped.empty()) data.lines = vtk_cells(lines);
  data.cell_data = {{std::move(strain), std::move(force), std::move(length)}, {std::move(names)}};
  return write_part("ligaments", "ligaments", std::move(data), row);
}

std::string VtkSeries::add_contacts(const VtkRow& row) {
  if (run_.scene->contacts.empty() && run_.scene->layers.empty()) return {};
  VtkPolyData data;
  VtkWords names{"name", {}}, bodies{"on_body", {}};
  VtkArray force{"force_N", {}, 3}, normal{"normal", {}, 3}, magnitude{"force_magnitude_N", {}},
      mean{"mean_pressure_MPa", {}}, most{"max_pressure_MPa", {}}, area{"area_mm2", {}}, depth{"max_depth_mm", {}};
  std::vector<std::vector<int>> vertices;
  for (const ReportContact& c : run_.contacts) {
    if (!c.point[row.row].allFinite() || !c.force[row.row].allFinite()) continue;
    const Vec3 f = run_.body_poses[row.row][at(c.body_b)].R * c.force[row.row];
    vertices.push_back({static_cast<int>(data.points.size())});
    data.points.push_back(shown(row, c.body_b, c.point[row.row]));
    names.values.push_back(c.name);
    bodies.values.push_back(run_.model->bodies[at(c.body_b)].name);
    append(force.values, f);
    append(normal.values, f.norm() > 0 ? Vec3(-f.normalized()) : Vec3::Zero());
    magnitude.values.push_back(f.norm());
    for (auto& [array, column] : {std::pair(&mean, ".mean_pressure_MPa"), std::pair(&most, ".max_pressure_MPa"),
                                  std::pair(&area, ".area_mm2"), std::pair(&depth, ".max_depth_mm")})
      array->values.push_back(number_or_nan(row, c.name + column));
  }
  data.vertices = vtk_cells(vertices);
  data.point_data = {{std::move(magnitude), std::move(force), std::move(normal)},
                     {std::move(names), std::move(bodies)}};
  if (!run_.scene->layers.empty())
    for (VtkArray* array : {&mean, &most, &area, &depth}) data.point_data.numbers.push_back(std::move(*array));
  return write_part("contacts", "contacts", std::move(data), row);
}

std::string VtkSeries::add(const VtkRow& row) {
  for (std::size_t k = 0; k < shapes_.size(); ++k)
    if (std::string error = add_shape(k, row); !error.empty()) return error;
  if (std::string error = add_ligaments(row); !error.empty()) return error;
  return add_contacts(row);
}

std::string VtkSeries::finish() { return write_("poses.pvd", pvd_text(entries_)); }

}  // namespace genu
