// Knees from a seed: number `index` of the population is the same knee whatever else is drawn.
#pragma once

#include <cstdint>
#include <string>

#include "hard_cases/population/knee_spec.h"

namespace genu::population {

/// `data`: where the shape-model knees lie; without it, "" , other knees stand in their places.
Knee draw_knee(std::uint64_t seed, int index, const std::string& data);

}  // namespace genu::population
