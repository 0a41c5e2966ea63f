// What goes to standard error. Where that cannot be written, nothing is left to say it with: the program goes on, and
// its exit code tells.
#pragma once

#include <cstdio>
#include <utility>

#include <fmt/format.h>

namespace genu::cli {

template <typename... T>
void tell(fmt::format_string<T...> format, T&&... arguments) {
  const std::string text = fmt::format(format, std::forward<T>(arguments)...);
  std::fputs(text.c_str(), stderr);
}

}  // namespace genu::cli
