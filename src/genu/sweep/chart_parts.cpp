#include "genu/sweep/chart_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "genu/results/svg_axes.h"
#include "genu/results/svg_text.h"

namespace genu {
namespace {

constexpr std::array kCaseColours = {"#1f5fa8", "#c4541a", "#2e8b57", "#7b4fa3", "#8a6d1f", "#b03a6a"};

}  // namespace

const char* case_colour(std::size_t k) { return kCaseColours[k % kCaseColours.size()]; }

std::string chart_opening(const std::string& title, double height) {
  const std::string style = std::string(kSvgLetters) + kSvgAxesStyle +
                            "path{fill:none}.title{font-weight:600;font-size:13px}.line{stroke-width:1.8}";
  return svg_opening(kPictureWidth, height, style) + svg_text(kLeftEdge, 20, title, "class=\"title\"");
}

std::string chart_legend(const SweepTable& sweep, const std::vector<std::size_t>& cases) {
  std::string out;
  double x = kLeftEdge;
  for (std::size_t k = 0; k < cases.size() && cases.size() > 1; ++k) {
    const std::string& name = sweep.record.cases[cases[k]].what_if;
    out += svg_text(x, 38, name, fmt::format("style=\"fill:{}\"", case_colour(k)));
    constexpr double kLegendLetter = 7, kBetween = 20;
    x += kLegendLetter * static_cast<double>(name.size()) + kBetween;
  }
  return out;
}

std::vector<std::size_t> cases_of(const SweepTable& sweep, const std::string& scene) {
  std::vector<std::size_t> cases;
  for (std::size_t c = 0; c < sweep.cases.size(); ++c)
    if (sweep.record.cases[c].scene == scene) cases.push_back(c);
  return cases;
}

std::string chart_bar(double x1, double x2, double y, double height, const char* colour, double opacity,
                      const std::string& attributes) {
  return fmt::format(
      "<rect {}x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" style=\"fill:{};fill-opacity:{}\"/>\n",
      attributes.empty() ? std::string() : attributes + " ", std::min(x1, x2), y, std::abs(x2 - x1), height, colour,
      opacity);
}

}  // namespace genu
