// Results of a knee beside those of its mirror image.
#pragma once

#include <string>

#include "hard_cases/population/knee_spec.h"
#include "hard_cases/population/run_table.h"

namespace genu::population {

/// The error_bars.csv of both runs, empty for none.
struct BarsOfBoth {
  RunTable results, mirrored;
};

struct MirrorVerdict {
  int compared = 0;   ///< rows, until the pose is one of many
  std::string wrong;  ///< "" where all is well
};

/// `mirrored` is what a run of the same knee has written, as View{true} has it: the same rows and words, and numbers
/// that are the same once seen in the mirror. Poses of meshes may differ by what the bars of both add up to.
MirrorVerdict compare_with_mirror(const Knee& knee, const RunTable& results, const RunTable& mirrored,
                                  const BarsOfBoth& bars = {});

}  // namespace genu::population
