#include "genu/appraise/contact_zones.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace genu {
namespace {

void add(ContactZone& zone, const ContactGeometry& contact) {
  zone.points_a.push_back(contact.a.p);
  zone.normals_a.push_back(contact.a.n);
  zone.points_b.push_back(contact.b.p);
  zone.normals_b.push_back(contact.b.n);
}

/// Group of each point: points nearer than `apart` are in one (single linkage), numbered by first appearance.
std::vector<int> groups(const std::vector<Vec3>& points, double apart) {
  std::vector<int> of(points.size());
  std::iota(of.begin(), of.end(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if ((points[i] - points[j]).norm() > apart || of[i] == of[j]) continue;
      const int keep = std::min(of[i], of[j]), drop = std::max(of[i], of[j]);
      std::replace(of.begin(), of.end(), drop, keep);
    }
  }
  return of;
}

std::vector<ContactZone> parted(const ContactZone& all, double apart) {
  const std::vector<int> of = groups(all.points_b, apart);
  std::vector<int> numbers = of;
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  if (numbers.size() == 1) return {all};
  std::vector<ContactZone> out;
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    ContactZone zone{fmt::format("{}_{}", all.name, n + 1), all.contact, {}, {}, {}, {}};
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (of[i] != numbers[n]) continue;
      zone.points_a.push_back(all.points_a[i]);
      zone.normals_a.push_back(all.normals_a[i]);
      zone.points_b.push_back(all.points_b[i]);
      zone.normals_b.push_back(all.normals_b[i]);
    }
    out.push_back(std::move(zone));
  }
  return out;
}

}  // namespace

std::vector<ContactZone> contact_zones(const Prepared& prepared, const Solution& solution, double apart) {
  std::vector<ContactZone> out;
  for (std::size_t k = 0; k < prepared.scene.contacts.size(); ++k) {
    const ContactDef& def = prepared.scene.contacts[k];
    std::vector<ContactZone> zones;
    for (const RegionDef& region : def.regions) zones.push_back({region.name, static_cast<int>(k), {}, {}, {}, {}});
    if (zones.empty()) zones.push_back({def.name, static_cast<int>(k), {}, {}, {}, {}});
    for (const PoseRecord& record : solution.records) {
      if (!record.point.solved()) continue;
      for (const ActiveContact& c : record.point.pose.state.contacts) {
        if (c.pair != static_cast<int>(k)) continue;
        for (std::size_t r = 0; r < zones.size(); ++r)
          if (def.regions.empty() || def.regions[r].contains(c.geometry.b.p)) add(zones[r], c.geometry);
      }
    }
    for (const ContactZone& zone : zones) {
      if (zone.points_b.empty()) continue;
      const auto parts = def.regions.empty() ? parted(zone, apart) : std::vector<ContactZone>{zone};
      out.insert(out.end(), parts.begin(), parts.end());
    }
  }
  return out;
}

}  // namespace genu
