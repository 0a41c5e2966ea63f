// What Hertz's half spaces would carry where a layer is pressed: a check of the elastic foundation, where there is one.
//
// Hertz knows no thickness and an elastic foundation no spreading: they belong to contacts that are small against the
// layer and to contacts that are large against it. The check is given where the area in contact is one ellipse round
// the deepest point, as wide as the curvatures there say, narrow against the surfaces' radii and against the layer;
// elsewhere it says why not.
#pragma once

#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/pose_table.h"
#include "genu/results/summary.h"

namespace genu {

/// One entry for each layer that some row presses: of the row with the largest force among those where Hertz applies
/// (found by halving: what forbids it grows with the force), else of that with the largest force at all, with the
/// reason. `poses` is the pose_table() of the records.
std::vector<HertzCheck> hertz_checks(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                     const ResultTable& poses);

/// A sentence on each that applies.
std::vector<std::string> hertz_sentences(const std::vector<HertzCheck>& checks);

}  // namespace genu
