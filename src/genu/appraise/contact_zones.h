// Where the contacts of a solved scene were: the zones for which surfaces are fitted.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/assemble/solution.h"

namespace genu {

/// The contacts of one pair that belong together: one region, or the whole pair.
struct ContactZone {
  std::string name;  ///< the region's, or the contact's
  int contact = 0;   ///< index into Scene::contacts
  /// Points (m) and outward normals on surfaces A and B, in their bodies as the solver has them (centre_bodies.h).
  std::vector<Vec3> points_a, normals_a, points_b, normals_b;
};

/// The zones that contacts were in, in the order of the scene's contacts and regions. A contact in none of a pair's
/// regions is left out. Without regions, contacts of a pair that stay farther than `apart` (m) from each other on the
/// second surface are zones of their own, numbered.
std::vector<ContactZone> contact_zones(const Prepared& prepared, const Solution& solution, double apart);

}  // namespace genu
