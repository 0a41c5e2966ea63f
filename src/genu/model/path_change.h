// How a path changes, at fixed poses, by a number of the scene: one of its points moves, or a surface that it wraps
// round moves as a whole or changes shape (wrap/arc_change.h).
#pragma once

#include "genu/model/ligament_path.h"
#include "genu/model/parameters.h"

namespace genu {

/// Whether a number of a surface moves it as a whole.
bool is_origin(const SurfaceDef& def, const Parameter& parameter);

/// Whether a path of these wraps touches that surface.
bool touches(const std::vector<WrapDef>& defs, const LigamentPath& path, const Wraps& wraps, int surface);

/// Per SI unit of a number of a surface, `wraps` at `poses`. NaN where an arc leaves its surface.
LigamentPath::Change change_by_surface(const std::vector<WrapDef>& defs, const LigamentPath& path,
                                       const std::vector<Pose>& poses, const Wraps& wraps, const Parameter& parameter,
                                       const std::vector<SurfaceDef>& surfaces);

/// The same where point `index` of the path, from end to end, moves along an axis of its body.
LigamentPath::Change change_by_point(const LigamentPath& path, const std::vector<Pose>& poses, std::size_t index,
                                     int axis);

/// m: rate of the length.
double length_rate(const LigamentPath& path, const std::vector<Pose>& poses, const Wraps& wraps,
                   const LigamentPath::Change& change);

/// Adds `tension` times the rate of the pull P of unit tension, 6 for each moving body.
void add_pull_rate(const LigamentPath& path, const std::vector<Pose>& poses, const Wraps& wraps,
                   const LigamentPath::Change& change, double tension, VecX& wrench);

}  // namespace genu
