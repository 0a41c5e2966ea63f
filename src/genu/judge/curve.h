// The curve through a table's points: Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5 (1984) 300-304), with the
// three-point end slopes of PCHIP. Written for the judge from the paper; law/monotone_table has its own.
#pragma once

#include <utility>
#include <vector>

#include "genu/scene/scene.h"

namespace genu::judge {

using Points = std::vector<std::pair<double, double>>;

/// The value at x. Linear beyond the ends; a table without negative values never becomes negative.
double curve_at(const Points& points, double x);

/// A scale or course (docs/scene-reference.md, Loads) at x: s, or the value of its coordinate.
double scale_at(const ScaleDef& scale, double x);

/// A scale with feedback, at its coordinate, the coordinate's rate and a time (s). `side`: 1 or -1, of that time: the
/// rate of its target may jump there.
double feedback_at(const ScaleDef& scale, double x, double rate, double time, int side);

}  // namespace genu::judge
