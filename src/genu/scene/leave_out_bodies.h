// Leaving out bodies with everything that is on them, as for a knee without its menisci.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/scene/scene.h"

namespace genu {

/// A body that cannot be left out, and why: it is fixed, carries a body that stays, is the last one that moves, or
/// takes all loads with it that drive a coordinate.
struct BodyThatStays {
  int body = -1;  ///< index into SceneTables::bodies
  std::string why;
};
/// Of bodies that are to be left out, the first that cannot be.
std::optional<BodyThatStays> cannot_leave_out(const SceneTables& scene, const std::vector<int>& bodies);

/// Whether `pattern` of --without means a body. It goes with all that is on it, so a pattern means one only by its
/// whole name, or where it begins with "body.".
bool means_body(const std::string& pattern, const std::string& name);

/// Takes bodies out of a checked scene, and what needs them: their joints (with combinations, prescribed values and
/// loads on these), surfaces, contacts, paths that end on them or wrap round them, bushings and loads.
void leave_out_bodies(SceneTables& scene, const std::vector<int>& bodies);

}  // namespace genu
