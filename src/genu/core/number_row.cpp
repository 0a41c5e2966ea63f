#include "genu/core/number_row.h"

#include <cmath>

#include <fmt/format.h>

namespace genu {
namespace {

/// A fixed unit times powers of the chosen units of length and angle.
struct Composed {
  Unit unit;  ///< as its place in the table
  const char* fixed;
  int length = 0, angle = 0;
  double change = 1;  ///< standard change, in units of results
};

constexpr Composed kComposed[] = {{Unit::number, "", 0, 0, 0.01},
                                  {Unit::length, "", 1, 0},
                                  {Unit::angle, "", 0, 1},
                                  {Unit::force, "N"},
                                  {Unit::moment, "N m", 0, 0, 0.01},
                                  {Unit::mass, "kg"},
                                  {Unit::force_per_length, "N", -1},
                                  {Unit::force_per_area, "N", -2},
                                  {Unit::moment_per_angle, "N m", 0, -1},
                                  {Unit::force_per_speed, "N s", -1},
                                  {Unit::moment_per_rate, "N m s", 0, -1},
                                  {Unit::time_per_length, "s", -1}};

const Composed& composed(Unit unit) { return kComposed[static_cast<int>(unit)]; }

double power(double x, int n) { return n == 0 ? 1 : n > 0 ? x * power(x, n - 1) : 1 / power(x, -n); }

std::string power_name(const std::string& name, int n) {
  if (n == 0) return {};
  const int size = std::abs(n);
  return (n < 0 ? "/" : "") + name + (size == 1 ? std::string() : "^" + std::to_string(size));
}

}  // namespace

double si(Unit unit, const ChosenUnits& chosen) {
  return power(chosen.length, composed(unit).length) * power(chosen.angle, composed(unit).angle);
}

std::string unit_name(Unit unit, const ChosenUnits& chosen) {
  const Composed& u = composed(unit);
  return u.fixed + power_name(chosen.length_name, u.length) + power_name(chosen.angle_name, u.angle);
}

std::string unit_in_results(Unit unit) {
  std::string name = unit_name(unit);
  if (name.starts_with("N m")) name.erase(1, 1);
  return name.empty() ? "1" : name;
}

std::string NumberRow::fault(double value) const {
  const bool with_zero = range == Range::at_least_zero || range == Range::above_zero_or_limit;
  if (std::isfinite(value) && (range == Range::any || (with_zero ? value >= 0 : value > 0))) return {};
  return std::string(key) + (range == Range::any ? " must be finite" : with_zero ? " must be >= 0" : " must be > 0");
}

double standard_change(Unit unit) { return composed(unit).change * si(unit); }

std::string standard_change_text(Unit unit) {
  const std::string name = unit == Unit::number ? std::string() : " " + unit_in_results(unit);
  return fmt::format("{:g}{}", composed(unit).change, name);
}

}  // namespace genu
