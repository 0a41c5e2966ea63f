// Numbers written as what they follow from: "20 + sqrt(20^2 - [knee.x_mm]^2)".
//
// + - * / ^ ( ), numbers, pi, deg (pi / 180), abs sqrt cbrt exp log sin cos tan asin acos atan, atan2 min max, and in
// brackets names that whoever asks gives a value to.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace genu {

/// The value of a name in brackets; empty where there is none.
using NameValue = std::function<std::optional<double>(const std::string& name)>;

/// The value; empty with a reason in `why` for what is no formula, or where a name has no value.
std::optional<double> evaluate_formula(const std::string& text, const NameValue& value_of, std::string& why);

}  // namespace genu
