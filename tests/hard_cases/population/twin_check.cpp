#include "hard_cases/population/twin_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "hard_cases/population/energy_twin.h"

namespace genu::population {
namespace {

// mm + deg, N: what derivatives by differences leave of a minimum that is not too flat.
constexpr double kSame = 5e-3, kSameForce = 0.05;

TwinPose pose_of(const RunTable& results, std::size_t row) {
  return {results.number(row, "knee.adduction_deg"),
          results.number(row, "knee.rotation_deg"),
          {results.number(row, "knee.x_mm"), results.number(row, "knee.y_mm"), results.number(row, "knee.z_mm")}};
}

TwinPose beside(TwinPose pose, double by, int which) {
  const double s = which % 2 == 0 ? by : -by;
  pose.translation += Vec3(0.6 * s, -0.5 * s, 0.4 * by);
  pose.adduction += 0.5 * s;
  pose.rotation -= 0.7 * s;
  return pose;
}

/// "" where the twin agrees about an ok row.
std::string check_row(const EnergyTwin& twin, const Knee& knee, const RunTable& results, std::size_t row) {
  const double flexion = results.number(row, "knee.flexion_deg");
  const TwinPose pose = pose_of(results, row);
  const bool stable = results.text(row, "stability") == "stable";
  if (!stable && results.text(row, "stability") != "unstable") return "";
  double nearest = 1e300;
  // First from no contact forces and soft contact, which sinks in by millimetres where forces are large, and may slide
  // into another valley; then stiff, from the forces said, which are found anew.
  std::vector<double> said;
  for (const Contact& c : knee.contacts) said.push_back(results.number(row, c.name + ".force_N"));
  constexpr double kSoft = 300, kStiff = 3e3;  // N/mm
  for (int start = 0; start < 12; ++start) {
    const bool soft = start < 6;
    const double by = std::array{0.3, 0.03, 0.003}[static_cast<std::size_t>(start % 6 / 2)];
    const auto found =
        twin.minimise(flexion, beside(pose, by, start % 2), soft ? std::vector<double>{} : said, soft ? kSoft : kStiff);
    if (!found) continue;
    const double apart = distance(found->pose, pose);
    nearest = std::min(nearest, apart);
    if (apart > kSame) continue;
    if (!stable) return "";  // an unstable pose is a saddle: the way there from beside it may be level
    for (std::size_t i = 0; i < knee.contacts.size(); ++i) {
      const double force = results.number(row, knee.contacts[i].name + ".force_N");
      if (std::abs(force - found->forces[i]) > kSameForce + 1e-4 * std::abs(force))
        return fmt::format("at {:.4g} deg {} carries {:.6g} N, least energy says {:.6g}", flexion,
                           knee.contacts[i].name, force, found->forces[i]);
    }
    return "";
  }
  return stable ? fmt::format(
                      "at {:.4g} deg the pose said to be stable is no minimum of energy (the nearest is {:.3g} "
                      "mm + deg away)",
                      flexion, nearest)
                : "";
}

}  // namespace

TwinVerdict compare_with_twin(const Knee& knee, const RunTable& results) {
  TwinVerdict out;
  const EnergyTwin twin(knee);
  const std::size_t rows = results.rows.size();
  std::size_t last_ok = rows;
  for (std::size_t row = 0; row < rows && results.text(row, "step") == "1"; ++row) {
    if (results.text(row, "status") != "ok") {
      const double flexion = results.number(row, "knee.flexion_deg");
      const auto found = twin.minimise(flexion, last_ok < rows ? pose_of(results, last_ok) : twin.reference());
      const double way =
          found ? distance(found->pose, last_ok < rows ? pose_of(results, last_ok) : twin.reference()) : 0;
      ++out.compared;
      constexpr double kNear = 1;  // mm + deg: the same branch beyond doubt
      if (found && last_ok < rows && way < kNear)
        out.wrong = fmt::format("{} at {:.4g} deg, but the energy has a minimum {:.3g} mm + deg from the last pose",
                                results.text(row, "status"), flexion, way);
      if (found && last_ok == rows && way < 3)
        out.wrong = fmt::format("no pose at {:.4g} deg, but the energy has a minimum {:.3g} mm + deg from the start",
                                flexion, way);
      return out;
    }
    last_ok = row;
    if (row % std::max<std::size_t>(1, rows / 6) != 0) continue;
    ++out.compared;
    out.wrong = check_row(twin, knee, results, row);
    if (!out.wrong.empty()) return out;
  }
  return out;
}

}  // namespace genu::population
