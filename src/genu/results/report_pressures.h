// Pressure maps of cartilage for report.html.
#pragma once

#include "genu/model/state.h"
#include "genu/results/report_run.h"

namespace genu {

/// More samples (a triangle or place that carries load in a row) than this leave rows out: the page grows by about
/// 5 bytes for each.
inline constexpr std::size_t kMostPressureSamples = 250'000;

/// Of each surface that casts in an elastic layer, what its triangles carry in each row: the rows of
/// pressures_CONTACT.csv (results/pressure_map.h), the largest of the points of a triangle. `states` is null where a
/// row has no pose; `meshes` are those of the page, in the order of Scene::surfaces, then bones.
std::vector<ReportPressure> report_pressures(const PlacedScene& scene, const JointModel& model,
                                             const std::vector<const State*>& states,
                                             const std::vector<ReportMesh>& meshes,
                                             std::size_t most = kMostPressureSamples);

}  // namespace genu
