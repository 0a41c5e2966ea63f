// What a laxity test found: the long table, the short one, the printed tables, pictures and page.
#pragma once

#include <string>
#include <vector>

#include "genu/results/chart.h"
#include "genu/results/result_table.h"
#include "genu/study/laxity_result.h"

namespace genu {

/// Columns of results.csv that are of use here: not steps, reactions, factors and what the solver counts.
bool is_laxity_column(const std::string& column);

/// One row a pose: scene, flexion, test, leg's load, displacement from the neutral pose, stiffness, the clinical
/// motion, the joint's coordinates, forces of contacts, bundles and fibres.
ResultTable laxity_rows(const std::vector<LaxityOfScene>& scenes);
/// The same as the text of laxity.csv.
std::string laxity_csv(const std::vector<LaxityOfScene>& scenes);

/// One row a curve: displacement each way and in total, stiffness near zero and at both ends, coupled motions there.
ResultTable laxity_summary(const std::vector<LaxityOfScene>& scenes);

/// Aligned tables for the terminal: laxity of each test, coupled motions, forces of ligaments at the full loads.
std::string laxity_text(const std::vector<LaxityOfScene>& scenes);

/// Displacement over load, one line an angle, one panel a scene.
Chart laxity_chart(const LaxityResult& result, const LaxityChoice& choice, const LaxityTest& test);

/// All of it as one page.
std::string laxity_page(const LaxityResult& result, const std::string& pictures);

}  // namespace genu
