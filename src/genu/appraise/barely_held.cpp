#include "genu/appraise/barely_held.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/appraise/place.h"
#include "genu/appraise/tolerances.h"
#include "genu/appraise/unstable.h"
#include "genu/equilibrium/undetermined.h"
#include "genu/results/columns.h"

namespace genu {
namespace {

/// Whether the body of a surface takes part in a motion.
bool takes_part(const Prepared& prepared, const VecX& mode, int surface) {
  constexpr double kPart = 0.1;
  const int moving = prepared.model.bodies[at(prepared.scene.surfaces[at(surface)].body)].moving;
  return moving >= 0 && mode.segment<6>(Eigen::Index{6} * moving).norm() > kPart;
}

/// J: stiffness below which the softest motion of a pose counts as barely held: a share of what the layers carry
/// between the bodies that it moves, times the size of the joint.
double hardly_any(const Prepared& prepared, const ResultTable& poses, std::size_t row, const VecX& mode) {
  double force = 0;
  for (const LayerDef& layer : prepared.scene.layers) {
    if (!takes_part(prepared, mode, layer.pair.surface_a) && !takes_part(prepared, mode, layer.pair.surface_b))
      continue;
    const double f = poses.number(row, layer.pair.name + ".force_N");
    if (std::isfinite(f)) force += f;
  }
  return kHardlyAnyStiffness * force * prepared.model.scales.length;
}

bool is_barely_held(const Prepared& prepared, const ResultTable& poses, std::size_t row, const PosePoint& point) {
  const VecX& mode = point.stability.mode;
  if (mode.size() != Eigen::Index{6} * prepared.model.moving_count) return false;
  const double most = hardly_any(prepared, poses, row, mode);
  if (!(std::abs(point.stability.smallest) < most)) return false;
  // That eigenvalue falls with the distance of the bodies' own origins. About those of the poses:
  Linearization here;
  linearize(prepared.model, point.pose.state, point.target, here);
  return std::abs(mode.dot(free_stiffness(here, prepared.model.scales.length).stiffness * mode)) < most;
}

/// "hip.adduction and hip.rotation": what changes along the softest motion.
std::string softest_motion(const Prepared& prepared, const PosePoint& point) {
  Stability softest = point.stability;
  softest.neutral = point.stability.mode;
  softest.redundant.clear();
  std::vector<std::string> names;
  for (const CoordinateRef& c : find_undetermined(prepared.model, point.pose.state, point.target, softest).free_motion)
    names.push_back(coordinate_name(prepared.scene, c));
  return joined_with_and(names);
}

}  // namespace

std::vector<std::string> barely_held_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                               const ResultTable& poses) {
  const PosePoint* first = nullptr;
  int barely = 0, solved = 0;
  for (std::size_t row = 0; row < records.size(); ++row) {
    const PosePoint& point = records[row].point;
    if (!point.solved()) continue;
    ++solved;
    if (point.stability.verdict == Stability::Verdict::neutral || !why_unstable(prepared, point).empty()) continue;
    if (!is_barely_held(prepared, poses, row, point)) continue;
    if (++barely == 1) first = &point;
  }
  if (barely == 0 || barely < std::min(2, solved)) return {};  // one among others is near a limit point
  return {fmt::format(
      "{} of {} poses {} barely held, {}at {}: 0.01 % of the contact force would move {} by 10 deg or 2 mm. "
      "Prescribe it, or add a ligament or load that holds it",
      barely, solved, barely == 1 ? "is" : "are", barely == 1 ? "" : "the first ",
      place(prepared, first->step, first->target), softest_motion(prepared, *first))};
}

}  // namespace genu
