#include "genu/appraise/unstable.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/appraise/place.h"

namespace genu {
namespace {

bool asked_for(const Prepared& prepared, const PosePoint& point) {
  if (point.step > 0 && prepared.steps[at(point.step - 1)].arc_length) return true;
  return std::any_of(point.target.prescribed.begin(), point.target.prescribed.end(),
                     [](const auto& p) { return !p.drivers.empty(); });
}

}  // namespace

std::vector<std::string> unstable_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records) {
  const PosePoint* first = nullptr;
  int unstable = 0, solved = 0;
  for (const PoseRecord& record : records) {
    const PosePoint& point = record.point;
    if (!point.solved()) continue;
    ++solved;
    if (point.stability.verdict != Stability::Verdict::unstable || asked_for(prepared, point)) continue;
    if (++unstable == 1) first = &point;
  }
  if (unstable == 0) return {};
  return {fmt::format("{} of {} poses {} unstable, {}at {}: the joint would not stay there", unstable, solved,
                      unstable == 1 ? "is" : "are", unstable == 1 ? "" : "the first ",
                      place(prepared, first->step, first->target))};
}

}  // namespace genu
