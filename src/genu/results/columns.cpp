#include "genu/results/columns.h"

#include <fmt/format.h>

#include "genu/core/units.h"

namespace genu {

std::string coordinate_column(const SceneTables& scene, const QuantityRef& c) {
  return quantity_name(scene, c) + (c.is_rotation() ? "_deg" : "_mm");
}

double shown_value(const QuantityRef& c, double value) {
  return value * (c.is_rotation() ? to::kDegree : to::kMillimetre);
}

std::string reaction_column(const SceneTables& scene, const QuantityRef& c) {
  return quantity_name(scene, c) + ".reaction" + (c.is_rotation() ? "_Nm" : "_N");
}

const char* clinical_name(const JointDef& joint, std::size_t i) {
  constexpr std::array kTibia = {"flexion_deg", "adduction_deg", "external_rotation_deg",
                                 "lateral_mm",  "anterior_mm",   "distraction_mm"};
  constexpr std::array kPatella = {"flexion_deg",      "medial_rotation_deg", "lateral_tilt_deg",
                                   "lateral_shift_mm", "anterior_mm",         "proximal_mm"};
  return joint.grood_suntay && joint.grood_suntay->patella ? kPatella[i] : kTibia[i];
}

std::string clinical_column(const JointDef& joint, std::size_t i) {
  return joint.name + ".gs." + clinical_name(joint, i);
}

std::array<double, kClinicalColumns> clinical_numbers(const JointDef& joint, const KneeMotion& m) {
  const bool patella = joint.grood_suntay && joint.grood_suntay->patella;
  return {m.flexion, m.adduction, m.external_rotation, m.lateral, m.anterior, patella ? -m.distraction : m.distraction};
}

std::string held_column(const std::string& joint, std::size_t i) {
  return fmt::format("{}.reaction.{}_{}", joint, i < 3 ? "force" : "moment", kAxisNames[i % 3]) +
         (i < 3 ? "_N" : "_Nm");
}

std::string residual_column(const std::string& body, std::size_t i) {
  return fmt::format("{}.residual_{}_{}", body, i < 3 ? "force" : "moment", kAxisNames[i % 3]) + (i < 3 ? "_N" : "_Nm");
}

std::string point_column(const SceneTables& scene, std::size_t pair, bool second, std::size_t axis) {
  return centre_column(scene, scene.contacts[pair], second, axis);
}

const std::array<LayerColumn, 13> kLayerColumns = {{
    {"force_N", [](const LayerTotals& t) { return t.force.norm(); }},
    {"force_x_N", [](const LayerTotals& t) { return t.force.x(); }},
    {"force_y_N", [](const LayerTotals& t) { return t.force.y(); }},
    {"force_z_N", [](const LayerTotals& t) { return t.force.z(); }},
    {"moment_x_Nm", [](const LayerTotals& t) { return t.moment.x(); }},
    {"moment_y_Nm", [](const LayerTotals& t) { return t.moment.y(); }},
    {"moment_z_Nm", [](const LayerTotals& t) { return t.moment.z(); }},
    {"area_mm2", [](const LayerTotals& t) { return to::kSquareMillimetre * t.area; }},
    {"mean_pressure_MPa", [](const LayerTotals& t) { return t.mean_pressure / units::kMegapascal; }},
    {"max_pressure_MPa", [](const LayerTotals& t) { return t.max_pressure / units::kMegapascal; }},
    {"max_depth_mm", [](const LayerTotals& t) { return to::kMillimetre * t.max_depth; }},
    {"max_strain", [](const LayerTotals& t) { return t.most_used; }},
    {"points", [](const LayerTotals& t) { return static_cast<double>(t.points); }},
}};

std::string centre_column(const SceneTables& scene, const ContactDef& c, bool second, std::size_t axis) {
  const int surface = second ? c.surface_b : c.surface_a;
  return fmt::format("{}.{}_mm", scene.surfaces[static_cast<std::size_t>(surface)].name, kAxisNames[axis]);
}

std::string without_unit(const std::string& column) {
  for (const char* unit : {"_deg", "_mm", "_Nm", "_Nmm", "_N", "_s"}) {
    const std::string end = unit;
    if (column.size() > end.size() && column.compare(column.size() - end.size(), end.size(), end) == 0)
      return column.substr(0, column.size() - end.size());
  }
  return column;
}

}  // namespace genu
