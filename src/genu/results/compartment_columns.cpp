#include "genu/results/compartment_columns.h"

#include <algorithm>

namespace genu {
namespace {

/// The sum of a quantity over contacts, of the last row.
double sum_of(const std::vector<std::string>& contacts, const char* quantity, const ResultTable& table) {
  double sum = 0;
  for (const std::string& contact : contacts)
    if (table.has_column(contact + quantity)) sum += table.number(table.rows() - 1, contact + quantity);
  return sum;
}

bool all_are_layers(const CompartmentDef& compartment, const ResultTable& table) {
  const auto has_area = [&](const std::string& contact) {
    return !table.has_column(contact + ".force_N") || table.has_column(contact + ".area_mm2");
  };
  return std::all_of(compartment.direct.begin(), compartment.direct.end(), has_area) &&
         std::all_of(compartment.meniscal.begin(), compartment.meniscal.end(), has_area);
}

}  // namespace

void add_compartment_columns(const SceneTables& scene, ResultTable& table) {
  for (const CompartmentDef& compartment : scene.compartments) {
    table.add_column(compartment.name + ".force_N");
    if (all_are_layers(compartment, table)) table.add_column(compartment.name + ".area_mm2");
    table.add_column(compartment.name + ".meniscal_share");
  }
}

void set_compartment_columns(const SceneTables& scene, ResultTable& table) {
  for (const CompartmentDef& c : scene.compartments) {
    const double through = sum_of(c.meniscal, ".force_N", table), force = through + sum_of(c.direct, ".force_N", table);
    table.set(c.name + ".force_N", force);
    if (table.has_column(c.name + ".area_mm2"))
      table.set(c.name + ".area_mm2", sum_of(c.meniscal, ".area_mm2", table) + sum_of(c.direct, ".area_mm2", table));
    if (force > 0) table.set(c.name + ".meniscal_share", through / force);
  }
}

}  // namespace genu
