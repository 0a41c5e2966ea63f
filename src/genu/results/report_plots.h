// The plots of report.html: those of curves.svg and what a page has room for besides.
#pragma once

#include "genu/results/chart.h"
#include "genu/results/result_table.h"
#include "genu/scene/scene.h"

namespace genu {

/// Adds panels to a run's curves(), after the ones they belong to: the clinical description of each joint, the mean
/// strain of each ligament whose force is drawn, area and pressure of elastic layers, the force of joints that hold.
void add_report_plots(const PlacedScene& scene, const ResultTable& poses, Chart& chart);

}  // namespace genu
