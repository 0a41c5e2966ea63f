#include "genu/results/bundle_columns.h"

namespace genu {

void add_bundle_columns(const SceneTables& scene, ResultTable& table) {
  for (const BundleDef& bundle : scene.bundles)
    for (const char* quantity : {"strain", "force_N"})
      if (!bundle.members.empty()) table.add_column(bundle.name + "." + quantity);
}

void set_bundle_columns(const SceneTables& scene, ResultTable& table) {
  for (const BundleDef& bundle : scene.bundles) {
    if (bundle.members.empty()) continue;
    double strain = 0, force = 0;
    for (const int member : bundle.members) {
      const std::string& fibre = scene.ligaments[static_cast<std::size_t>(member)].name;
      strain += table.number(table.rows() - 1, fibre + ".strain");
      force += table.number(table.rows() - 1, fibre + ".force_N");
    }
    table.set(bundle.name + ".strain", strain / static_cast<double>(bundle.members.size()));
    table.set(bundle.name + ".force_N", force);
  }
}

}  // namespace genu
