// A number as options and tables say it.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "genu/scene/tolerances.h"

namespace genu {

/// The whole of `text` as a finite number of at most 1e20; empty where it is none. A sign + is allowed.
inline std::optional<double> finite_number(const std::string& text) {
  double value = 0;
  const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, code] = std::from_chars(first, text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !(std::abs(value) <= kMaxNumber)) return std::nullopt;
  return value;
}

}  // namespace genu
