// What the surfaces and bones of a scene look like, as triangles for report.html.
#pragma once

#include "genu/assemble/prepare.h"
#include "genu/results/report.h"

namespace genu {

/// Meshes as they were read, thinned out above `most` triangles; formulas as triangles, cut off where they go far
/// beyond what the joint is. what touches (contacts and poses of `run`) stays in the picture. A bone whose file cannot
/// be read any more is left out.
std::vector<ReportMesh> report_meshes(const Prepared& prepared, const ReportRun& run, std::size_t most);

}  // namespace genu
