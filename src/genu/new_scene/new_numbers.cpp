#include "genu/new_scene/new_numbers.h"

#include <cmath>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include "genu/new_scene/tolerances.h"

namespace genu {

std::string tenths(double metres) {
  const double mm = std::round(1e4 * metres) / 10;
  return fmt::format("{:g}", mm == 0 ? 0.0 : mm);
}

std::string point_text(const Vec3& p) {
  return fmt::format("[{}, {}, {}]", tenths(p.x()), tenths(p.y()), tenths(p.z()));
}

std::string length_word(const std::string& fibre) { return "length of " + fibre; }

std::string stiffness_word(const std::string& fibre) { return "stiffness of " + fibre; }

std::string stiffness_text(double stiffness) { return fmt::format("stiffness = {:.4g}", stiffness); }

std::optional<double> length_in(const ResultTable& poses, std::size_t row, const std::string& fibre) {
  const std::string column = fibre + ".length_mm";
  const double length = poses.has_column(column) ? poses.number(row, column) : NAN;
  return std::isfinite(length) ? std::optional(1e-3 * length) : std::nullopt;
}

bool set_slack(std::string& text, double slack) {
  const std::string_view key = "slack_length = ";
  const double old = text.starts_with(key) ? 1e-3 * std::atof(text.c_str() + key.size()) : 0;
  text = fmt::format("{}{:.2f}", key, 1e3 * slack);
  return std::abs(slack - old) > kSettledLength;
}

}  // namespace genu
