#include "genu/appraise/unstable.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/appraise/place.h"

namespace genu {

std::string why_unstable(const Prepared& prepared, const PosePoint& point) {
  if (point.step > 0 && prepared.steps[at(point.step - 1)].arc_length) return "arc length follows the path there too";
  const auto is_driven = [](const auto& p) { return !p.drivers.empty(); };
  const auto& prescribed = point.target.prescribed;
  return std::any_of(prescribed.begin(), prescribed.end(), is_driven)
             ? "the load that holds the joint, kept constant, would not hold it there"
             : "";
}

std::vector<std::string> unstable_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records) {
  const PosePoint* first = nullptr;
  int unstable = 0, solved = 0;
  for (const PoseRecord& record : records) {
    const PosePoint& point = record.point;
    if (!point.solved()) continue;
    ++solved;
    if (point.stability.verdict != Stability::Verdict::unstable || !why_unstable(prepared, point).empty()) continue;
    if (++unstable == 1) first = &point;
  }
  if (unstable == 0) return {};
  return {fmt::format("{} of {} poses {} unstable, {}at {}: the joint would not stay there", unstable, solved,
                      unstable == 1 ? "is" : "are", unstable == 1 ? "" : "the first ",
                      place(prepared, first->step, first->target))};
}

}  // namespace genu
