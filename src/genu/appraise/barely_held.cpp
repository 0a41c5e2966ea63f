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

/// J: stiffness that the tolerance of the layers may make up in a row.
double made_up(const Prepared& prepared, const ResultTable& poses, std::size_t row) {
  double force = 0;
  for (const LayerDef& layer : prepared.scene.layers) {
    const double f = poses.number(row, layer.pair.name + ".force_N");
    const double tolerance = layer.tolerance > 0 ? layer.tolerance : LayerDef().tolerance;
    if (std::isfinite(f)) force += tolerance * f;
  }
  return kRippleStiffness * force * prepared.model.scales.length;
}

/// "hip.adduction and hip.rotation": what changes along the softest motion.
std::string softest_motion(const Prepared& prepared, const PosePoint& point) {
  Stability softest = point.stability;
  softest.neutral = point.stability.mode;
  softest.redundant.clear();
  std::string names;
  const auto moves = find_undetermined(prepared.model, point.pose.state, point.target, softest).free_motion;
  for (std::size_t k = 0; k < moves.size(); ++k)
    names += (k == 0 ? "" : k + 1 == moves.size() ? " and " : ", ") + coordinate_name(prepared.scene, moves[k]);
  return names;
}

}  // namespace

std::vector<std::string> barely_held_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                               const ResultTable& poses) {
  if (prepared.scene.layers.empty()) return {};
  const PosePoint* first = nullptr;
  int barely = 0, solved = 0;
  for (std::size_t row = 0; row < records.size(); ++row) {
    const PosePoint& point = records[row].point;
    if (!point.solved()) continue;
    ++solved;
    if (point.stability.verdict == Stability::Verdict::neutral || !why_unstable(prepared, point).empty()) continue;
    if (!(std::abs(point.stability.smallest) < made_up(prepared, poses, row))) continue;
    if (++barely == 1) first = &point;
  }
  if (barely == 0 || barely < std::min(2, solved)) return {};  // one alone is near a limit point
  return {
      fmt::format("{} of {} poses {} barely held, {}at {}: a motion of {} meets no more stiffness than the layers' "
                  "tolerance makes up. Prescribe it, or add a ligament or load that holds it",
                  barely, solved, barely == 1 ? "is" : "are", barely == 1 ? "" : "the first ",
                  place(prepared, first->step, first->target), softest_motion(prepared, *first))};
}

}  // namespace genu
