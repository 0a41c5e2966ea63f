#include "genu/results/starts_table.h"

#include "genu/core/units.h"
#include "genu/results/columns.h"

namespace genu {
namespace {

/// Calls visit(coordinate) for every coordinate that some joint leaves free.
template <typename Visit>
void for_coordinates(const PlacedScene& scene, Visit visit) {
  for (int j = 0; j < static_cast<int>(scene.joints.size()); ++j)
    for (int i = 0; i < 6; ++i)
      if (scene.joints[static_cast<std::size_t>(j)].leaves(i)) visit(CoordinateRef{j, i});
}

void add_equilibrium(const PlacedScene& scene, const JointModel& model, const Equilibrium& e, long number,
                     ResultTable& table) {
  const State& state = e.pose.state;
  table.add_row();
  table.set("equilibrium", number);
  table.set("starts", static_cast<long>(e.starts.size()));
  table.set("first_start", static_cast<long>(e.first_start));
  table.set("status", std::string(to_string(e.report.status)));
  table.set("found", std::string(to_string(e.found)));
  for_coordinates(scene, [&](const CoordinateRef& c) {
    table.set(coordinate_column(scene, c), shown_value(c, quantity_value(model, state.coordinates, c)));
  });
  table.set("contacts", static_cast<long>(state.contacts.size()));
  if (e.energy) table.set("energy_Nmm", *e.energy * to::kMillijoule);
  table.set("stability.min_eigenvalue_Nmm", e.stability.smallest * to::kMillijoule);
  table.set("stability", std::string(to_string(e.stability)));
  table.set("residual", e.report.certificate.residual);
}

}  // namespace

ResultTable starts_table(const PlacedScene& scene, const JointModel& model, const StartSearch& search) {
  ResultTable table;
  for (const char* name : {"equilibrium", "starts", "first_start", "status", "found"}) table.add_column(name);
  for_coordinates(scene, [&](const CoordinateRef& c) { table.add_column(coordinate_column(scene, c)); });
  for (const char* name : {"contacts", "energy_Nmm", "stability.min_eigenvalue_Nmm", "stability", "residual"})
    table.add_column(name);
  long number = 0;
  for (const Equilibrium& e : search.equilibria) add_equilibrium(scene, model, e, ++number, table);
  for (const FailedStart& f : search.failed) {
    table.add_row();
    table.set("starts", 1L);
    table.set("first_start", static_cast<long>(f.start));
    table.set("status", std::string(to_string(f.report.status)));
  }
  return table;
}

}  // namespace genu
