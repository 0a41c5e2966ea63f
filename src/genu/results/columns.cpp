#include "genu/results/columns.h"

#include <fmt/format.h>

namespace genu {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

}  // namespace

std::string coordinate_column(const Scene& scene, const QuantityRef& c) {
  return quantity_name(scene, c) + (c.is_rotation() ? "_deg" : "_mm");
}

std::string reaction_column(const Scene& scene, const QuantityRef& c) {
  return quantity_name(scene, c) + ".reaction" + (c.is_rotation() ? "_Nm" : "_N");
}

std::string clinical_column(const std::string& joint, std::size_t i) { return joint + ".gs." + kClinical[i]; }

std::string held_column(const std::string& joint, std::size_t i) {
  return fmt::format("{}.reaction.{}_{}", joint, i < 3 ? "force" : "moment", kAxes[i % 3]) + (i < 3 ? "_N" : "_Nm");
}

std::string point_column(const Scene& scene, std::size_t pair, bool second, std::size_t axis) {
  const ContactDef& c = scene.contacts[pair];
  const int surface = second ? c.surface_b : c.surface_a;
  return fmt::format("{}.{}_mm", scene.surfaces[static_cast<std::size_t>(surface)].name, kAxes[axis]);
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
