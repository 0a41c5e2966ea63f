// Surfaces that only guide ligaments and cables, as a page shows them: faint, and no farther than paths come.
#pragma once

#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/report_run.h"
#include "genu/surface/surface.h"

namespace genu {

/// Of each surface of the scene: whether paths wrap round it, no contact has it, and its body has more to be seen.
std::vector<bool> only_wrapped(const PlacedScene& scene);

/// Where the paths of a run lie on a surface of `body`, in the body's frame: one place (m) in each cell of 2 mm.
std::vector<Vec3> places_of_paths(const ReportRun& run, int body, const Surface& surface);

/// Drops triangles without a corner nearer than `distance` (m) to one of `places`.
void keep_near_places(Mesh& mesh, const std::vector<Vec3>& places, double distance);

/// Of run.meshes as report_meshes() makes them: those of only_wrapped() get their kind and are cut to where paths lie
/// on them; whole where none does. What they were made from counts as they are.
void cut_wrapped(const Prepared& p, ReportRun& run);

}  // namespace genu
