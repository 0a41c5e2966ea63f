// The paths of a laxity test: loads up, down and back at fixed flexion, and loads held while the knee bends.
#pragma once

#include <vector>

#include "genu/study/laxity_result.h"

namespace genu {

/// The same numbers on any number of threads.
std::vector<LaxityAngle> solve_laxity(const LaxityJoint& knee, const LaxityChoice& choice);

/// The path without load, then those with each test's full load held, positive and negative. The load is put on at the
/// smallest flexion of `choice`; then the knee bends through the others to the largest, with a pose every
/// kEnvelopeStep or less. The same numbers on any number of threads.
std::vector<EnvelopePath> solve_envelope(const LaxityJoint& knee, const LaxityChoice& choice);

}  // namespace genu
