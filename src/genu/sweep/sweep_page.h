// report.html of a sweep: counts, charts, and the samples that jumped or failed. One file, without a network.
#pragma once

#include <string>

#include "genu/sweep/sweep_table.h"

namespace genu {

std::string sweep_page(const SweepTable& sweep);

}  // namespace genu
