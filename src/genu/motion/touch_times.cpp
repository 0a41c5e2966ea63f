#include "genu/motion/touch_times.h"

#include <algorithm>
#include <utility>

#include "genu/equilibrium/piece_changes.h"
#include "genu/motion/tolerances.h"

namespace genu {

std::vector<PathEvent> touches_between(const JointModel& model, const MotionPoint& before, const MotionPoint& after,
                                       const std::function<bool(double t, MotionPoint& out)>& at_time) {
  std::vector<PathEvent> events;
  if (after.state.wraps.empty()) return events;
  for (const auto& passed : touch_events(model, before.state, after.state)) {
    MotionPoint low = before, high = after, middle = after;
    while (high.time - low.time > kTouchTime * after.time) {
      if (!at_time(low.time + (high.time - low.time) / 2, middle)) break;
      const auto until = touch_events(model, before.state, middle.state);
      const bool over = std::find(until.begin(), until.end(), passed) != until.end();
      (over ? high : low) = middle;
    }
    PathEvent& event = events.emplace_back();
    event.kind = passed.first;
    event.step = 1;
    event.target.time = high.time;
    event.what = passed.second;
    event.coordinates = high.state.coordinates;
  }
  return events;
}

}  // namespace genu
