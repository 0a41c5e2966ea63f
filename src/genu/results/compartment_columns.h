// Columns of compartments: sums over their contacts, and the share of the menisci.
#pragma once

#include "genu/results/result_table.h"
#include "genu/scene/scene.h"

namespace genu {

/// NAME.force_N, the sum of the forces' sizes; NAME.area_mm2 where all are layers; NAME.meniscal_share of the force, in
/// [0, 1], empty where nothing is carried. Contacts that have been left out carry nothing.
void add_compartment_columns(const SceneTables& scene, ResultTable& table);
/// Of the last row, whose columns of contacts are set.
void set_compartment_columns(const SceneTables& scene, ResultTable& table);

}  // namespace genu
