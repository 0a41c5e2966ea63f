#include "genu/study/laxity_doubts.h"

#include <cmath>

#include <fmt/format.h>

#include "genu/appraise/implausible.h"
#include "genu/core/units.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

/// "30 deg, 134 N anterior"
std::string place_of(double angle, const LaxityTest& test, double load) {
  const std::string flexion = fmt::format("{:.4g} deg", to::kDegree * angle);
  if (std::abs(load) <= kSameLoad * test.load) return flexion + ", no load";
  return fmt::format("{}, {:.4g} {} {}", flexion, std::abs(load), test.load_unit(), test.direction(load > 0));
}

}  // namespace

std::vector<std::string> laxity_doubts(const LaxityOfScene& tested) {
  const Prepared& prepared = tested.knee.prepared;
  std::vector<PoseRecord> records;
  std::vector<std::string> places;
  for (const LaxityAngle& angle : tested.angles)
    for (const LaxityCurve& curve : angle.curves)  // which begin with the neutral pose
      for (const LaxityRow& row : curve.rows) {
        records.push_back(row.record);
        places.push_back(place_of(angle.flexion, curve.test, row.load));
      }
  for (const EnvelopePath& path : tested.envelope)
    for (const EnvelopePath::Row& row : path.rows) {
      records.push_back(row.pose.record);
      places.push_back(place_of(row.flexion, path.test, path.held));
    }
  const ResultTable table = pose_table(prepared.scene, prepared.model, prepared.steps, records);
  return implausible(prepared, records, table, [&](std::size_t row) { return places[row]; });
}

}  // namespace genu
