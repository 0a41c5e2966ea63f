// Knees of the shape model and the measured one, with ligaments and loads of their own.
#pragma once

#include "hard_cases/population/knee_spec.h"
#include "hard_cases/population/random_source.h"

namespace genu::population {

Knee draw_measured_knee(RandomSource& random);

}  // namespace genu::population
