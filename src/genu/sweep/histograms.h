// How often kept numbers have which value, as charts: of one number, and of one column at the slider's value of the
// main coordinate.
#pragma once

#include <cstddef>
#include <string>

#include "genu/sweep/sweep_table.h"

namespace genu {

/// A kept number in every case of a scene, as SVG. Empty where it does not vary.
std::string histogram_picture(const SweepTable& sweep, const std::string& scene, std::size_t kept);

/// A column that has bands, at the value in the middle, with what histogram_slider() needs to show every other one.
/// Empty where it does not vary.
std::string moving_histogram(const SweepTable& sweep, const std::string& scene, const std::string& column);

/// The slider over the values of the main coordinate, for all moving histograms behind it on the page.
std::string histogram_slider(const SweepTable& sweep);

}  // namespace genu
