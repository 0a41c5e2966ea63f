// Loads held while the knee bends, as tables and pictures: the envelope of its motion.
#pragma once

#include <string>
#include <vector>

#include "genu/results/chart.h"
#include "genu/results/result_table.h"
#include "genu/study/laxity_result.h"

namespace genu {

/// One row a pose, with the columns of laxity_rows(); displacements are from the path without load at the same flexion.
ResultTable envelope_rows(const std::vector<LaxityOfScene>& scenes);

/// One aligned table a test: at the flexions of `choice` how far the loads hold the joint from the path without load.
std::string envelope_text(const std::vector<LaxityOfScene>& scenes, const LaxityChoice& choice);

/// Displacement over flexion in both directions, one panel a scene.
Chart envelope_chart(const LaxityResult& result, const LaxityTest& test);

/// Sentences: paths that end, each counted in `ended`; then where a held load ends elsewhere than the same load put on
/// at the same flexion, so that more than one pose is in equilibrium.
std::vector<std::string> envelope_notes(const LaxityOfScene& tested, int& ended);

}  // namespace genu
