// The angle of a knee that a sine of 0.125 Hz drives from 1 s on, over two periods and more, as in the experiments of
// Guess et al. 2010 and Leskovar et al. 2019.
#pragma once

#include <vector>

namespace genu::studies {

/// An angle over time.
struct DrivenCurve {
  std::vector<double> time, angle;  ///< s; deg, since the start
  std::vector<double> harmonics;    ///< deg, of the drive's frequency: 1, 2, 3; over the second period
  double steepest = 0;              ///< largest rate over that of a sine with the same range
  bool complete = false;
};

/// Fills in harmonics, steepest and complete: the last where the curve covers enough of the second period.
void measure(DrivenCurve& curve);

}  // namespace genu::studies
