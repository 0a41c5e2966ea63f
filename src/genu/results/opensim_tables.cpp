#include "genu/results/opensim_tables.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/results/columns.h"

namespace genu {
namespace {

constexpr double kAreaUnit = 1e-6;  // m^2
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Column after column, each over all rows.
class OpenSimTable {
 public:
  OpenSimTable(const ReportRun& run, const std::vector<std::size_t>& rows, const std::vector<double>& times)
      : run_(run), rows_(rows), times_(times) {}

  /// Values by row of the run; NaN leaves a cell empty.
  void add(const std::string& name, std::vector<double> values) {
    names_.push_back(name);
    values_.push_back(std::move(values));
  }

  /// A column of results.csv in another unit. Without it, or without any number in it, nothing is added.
  void take(const std::string& column, const std::string& name, double factor) {
    if (!run_.poses->has_column(column)) return;
    bool any = false;
    std::vector<double> values(run_.poses->rows(), kNoNumber);
    for (const std::size_t row : rows_) {
      values[row] = factor * run_.poses->number(row, column);
      any = any || std::isfinite(values[row]);
    }
    if (any) add(name, std::move(values));
  }

  ResultTable table() const {
    ResultTable out;
    std::vector<std::size_t> places{out.add_column("time")};
    for (const std::string& name : names_) places.push_back(out.add_column(name));
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      out.add_row();
      out.set(std::size_t{0}, times_[k]);
      for (std::size_t c = 0; c < names_.size(); ++c) out.set(places[c + 1], values_[c][rows_[k]]);
    }
    return out;
  }

 private:
  const ReportRun& run_;
  const std::vector<std::size_t>& rows_;
  const std::vector<double>& times_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> values_;
};

void take_layer(const std::string& name, const std::string& centre, OpenSimTable& out) {
  struct Taken {
    const char *column, *name;
    double factor;
  };
  for (const Taken& t : {Taken{"force_x_N", "contact_force_x", 1},
                         {"force_y_N", "contact_force_y", 1},
                         {"force_z_N", "contact_force_z", 1},
                         {"moment_x_Nm", "contact_moment_x", 1},
                         {"moment_y_Nm", "contact_moment_y", 1},
                         {"moment_z_Nm", "contact_moment_z", 1},
                         {"area_mm2", "contact_area", kAreaUnit},
                         {"mean_pressure_MPa", "pressure_mean", units::kMegapascal},
                         {"max_pressure_MPa", "pressure_max", units::kMegapascal},
                         {"max_depth_mm", "proximity_max", units::kMillimetre}})
    out.take(name + "." + t.column, name + "." + t.name, t.factor);
  for (const char* axis : kAxisNames)
    out.take(fmt::format("{}{}_mm", centre, axis), fmt::format("{}.center_of_pressure_{}", name, axis),
             units::kMillimetre);
}

void take_layers(const PlacedScene& scene, OpenSimTable& out) {
  for (const LayerDef& layer : scene.layers) {
    const std::string& name = layer.pair.name;
    take_layer(name, fmt::format("{}.{}.", name, scene.surfaces[at(layer.pair.surface_b)].name), out);
    for (const RegionDef& region : layer.pair.regions) {
      const std::string part = name + "." + region.name;
      take_layer(part, part + ".", out);
    }
  }
}

bool is_of_layer(const PlacedScene& scene, const std::string& contact) {
  for (const LayerDef& layer : scene.layers)
    if (contact == layer.pair.name || contact.starts_with(layer.pair.name + ".")) return true;
  return false;
}

/// Rigid contacts one by one: no force where one is not closed.
void add_rigid_forces(const ReportRun& run, OpenSimTable& out) {
  for (const ReportContact& c : run.contacts) {
    if (is_of_layer(*run.scene, c.name)) continue;
    const std::size_t rows = run.poses->rows();
    std::vector<std::vector<double>> force(3, std::vector<double>(rows)),
        moment = force, point(3, std::vector<double>(rows, kNoNumber));
    for (std::size_t row = 0; row < rows; ++row) {
      if (!c.point[row].allFinite() || !c.force[row].allFinite()) continue;
      const Vec3 place = c.point[row] - own_origin(*run.model, c.body_b), m = place.cross(c.force[row]);
      for (std::size_t i = 0; i < 3; ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        force[i][row] = c.force[row][k];
        moment[i][row] = m[k];
        point[i][row] = place[k];
      }
    }
    const auto add = [&](const char* quantity, const std::vector<std::vector<double>>& values) {
      for (std::size_t i = 0; i < 3; ++i) out.add(fmt::format("{}.{}_{}", c.name, quantity, kAxisNames[i]), values[i]);
    };
    add("contact_force", force);
    add("contact_moment", moment);
    add("center_of_pressure", point);
  }
}

}  // namespace

ResultTable opensim_motion(const ReportRun& run, const OpenSimNames& names, const std::vector<std::size_t>& rows,
                           const std::vector<double>& times) {
  OpenSimTable out(run, rows, times);
  for (const auto& [c, name] : names)
    out.take(coordinate_column(*run.scene, {c}), name, c.index < 3 ? 1 : units::kMillimetre);
  return out.table();
}

ResultTable opensim_forces(const ReportRun& run, const OpenSimNames& names, const std::vector<std::size_t>& rows,
                           const std::vector<double>& times) {
  OpenSimTable out(run, rows, times);
  for (const LigamentDef& l : run.scene->ligaments) {
    out.take(l.name + ".force_N", l.name + ".force_total", 1);
    out.take(l.name + ".length_mm", l.name + ".length", units::kMillimetre);
    out.take(l.name + ".strain", l.name + ".strain", 1);
  }
  add_rigid_forces(run, out);
  take_layers(*run.scene, out);
  for (const auto& [c, name] : names)
    out.take(reaction_column(*run.scene, {c}), name + (c.index < 3 ? "_moment" : "_force"), 1);
  for (const JointDef& joint : run.scene->joints)
    for (std::size_t i = 0; joint.type != JointDef::Type::free && i < 6; ++i)
      out.take(held_column(joint.name, i),
               fmt::format("{}.reaction_{}_{}", joint.name, i < 3 ? "force" : "moment", kAxisNames[i % 3]), 1);
  return out.table();
}

}  // namespace genu
