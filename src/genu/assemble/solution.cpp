#include "genu/assemble/solution.h"

#include <algorithm>

namespace genu {

int Solved::solved() const {
  return static_cast<int>(
      std::count_if(records.begin(), records.end(), [](const PoseRecord& r) { return r.point.solved(); }));
}

}  // namespace genu
