// Columns BUNDLE.strain (mean of its fibres) and BUNDLE.force_N (sum) of [bundle.NAME].
#pragma once

#include "genu/results/result_table.h"
#include "genu/scene/scene.h"

namespace genu {

/// Bundles without an enabled fibre have no columns.
void add_bundle_columns(const SceneTables& scene, ResultTable& table);

/// In the last row, from the columns of the fibres there.
void set_bundle_columns(const SceneTables& scene, ResultTable& table);

}  // namespace genu
