// Lengths, strains and tensions of ligaments.
#include <algorithm>
#include <cmath>
#include <optional>

#include "genu/core/units.h"
#include "genu/judge/pose.h"
#include "genu/judge/tolerances.h"
#include "genu/judge/wrapping.h"

namespace genu::judge {
namespace {

/// Where the slack length of a wrapping ligament follows from the reference pose, of which there is no row, it is that
/// of the row's strain: all rows have to agree with the law through it.
LigamentDef with_slack_length(const PoseCase& pose, LigamentDef def) {
  const double strain = pose.row(def.name + ".strain");
  if (def.rest == LigamentDef::Rest::slack_length || !std::isfinite(strain)) return def;
  def.rest = LigamentDef::Rest::slack_length;
  def.rest_value = units::kMillimetre * pose.row(def.name + ".length_mm") / (1 + strain);
  return def;
}

}  // namespace

void check_ligaments(const PoseCase& pose, const std::vector<Motion>* velocities, PoseForces& forces) {
  const Scene& scene = pose.scene();
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const LigamentDef& def = scene.ligaments[i];
    const WrittenPath written = written_path(pose, def.name, def.path_points(), def.wraps);
    const std::vector<Vec3>& path = written.points;
    const std::vector<int>& bodies = written.bodies;
    const double length = written.length;
    const double sure = kFormulaRounding * length + pose.rounding + written.unsure;
    LigamentDef in_row;
    std::optional<TensionLaw> of_row;
    if (!def.wraps.empty()) of_row.emplace(in_row = with_slack_length(pose, def), length);
    const TensionLaw& law = of_row ? *of_row : pose.subject->laws[i];
    pose.out->expect("ligament lengths", "mm", std::abs(pose.row(def.name + ".length_mm") - to::kMillimetre * length),
                     to::kMillimetre * sure, def.name);
    if (law.slack_length() > 0)
      pose.out->expect("ligament strains", "1", std::abs(pose.row(def.name + ".strain") - law.strain(length)),
                       2 * (1 + std::abs(law.strain(length))) * sure / law.slack_length() + kFormulaRounding, def.name);
    else if (std::isfinite(pose.row(def.name + ".strain")))
      pose.out->expect("ligament strains", "1", std::nan(""), 0, def.name + " has none");
    const double force = pose.row(def.name + ".force_N");
    const double stiffness = law.stiffness(length);
    Tension tension = law.at(length, pose.length_tolerance());
    double unsure = kFormulaRounding * std::abs(tension.high) + 4 * stiffness * sure;
    if (velocities != nullptr && def.damping > 0) {
      double rate = 0;
      for (std::size_t k = 0; k + 1 < path.size(); ++k) {
        if (written.arc[k]) continue;
        const auto velocity = [&](std::size_t at_point) -> Vec3 {
          const int b = bodies[at_point];
          const Motion& m = (*velocities)[at(b)];
          return m.v + m.w.cross(path[at_point] - pose.poses[at(b)].p);
        };
        rate += (path[k + 1] - path[k]).normalized().dot(velocity(k + 1) - velocity(k));
      }
      const bool pushes = def.law == "spring" || law.force_when_slack() > 0;
      const bool slack = !pushes && tension.high <= 0;
      const double damper = slack ? 0 : def.damping * rate;
      tension.low = pushes ? tension.low + damper : std::max(0.0, tension.low + damper);
      tension.high = pushes ? tension.high + damper : std::max(0.0, tension.high + damper);
      if (!slack) unsure += 1e-9 * std::abs(damper);
      if (!pushes && std::abs(length - law.slack_length()) < sure) {  // about to become taut: either side
        tension.low = std::min(tension.low, 0.0);
        tension.high = std::max(tension.high, std::max(0.0, def.damping * rate));
      }
      pose.out->expect("ligament velocities", "mm/s",
                       std::abs(pose.row(def.name + ".velocity_mm_s") - to::kMillimetre * rate),
                       1e-9 * (1 + to::kMillimetre * std::abs(rate)), def.name);
    }
    const double off = std::max({0.0, tension.low - force, force - tension.high});
    pose.out->expect("ligament forces", "N", std::isfinite(force) ? off : force, unsure + 1e-12, def.name);
    // Tension along the path from the table: balance is judged with the written numbers.
    add_pulls(written, force, forces);
  }
}

}  // namespace genu::judge
