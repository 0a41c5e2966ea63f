// What the charts of a sweep have in common.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "genu/sweep/sweep_table.h"

namespace genu {

/// px: size of a chart, and where its axes end.
inline constexpr double kPictureWidth = 640, kPictureHeight = 320, kLeftEdge = 70, kRightEdge = 620, kTopEdge = 50,
                        kBottomEdge = 270;

/// Of the k-th case of a chart.
const char* case_colour(std::size_t k);

/// The opening of a chart's SVG, with its title.
std::string chart_opening(const std::string& title, double height = kPictureHeight);

/// Names of cases in their colours, above the axes; nothing where there is one.
std::string chart_legend(const SweepTable& sweep, const std::vector<std::size_t>& cases);

/// A bar from x1 to x2; `attributes` such as class="b".
std::string chart_bar(double x1, double x2, double y, double height, const char* colour, double opacity,
                      const std::string& attributes = {});

/// The cases of a scene.
std::vector<std::size_t> cases_of(const SweepTable& sweep, const std::string& scene);

}  // namespace genu
