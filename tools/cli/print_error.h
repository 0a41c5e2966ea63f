// Output to standard error. If that cannot be written the program continues; its exit code reports the failure.
#pragma once

#include <cstdio>
#include <utility>

#include <fmt/format.h>

namespace genu::cli {

template <typename... T>
void print_error(fmt::format_string<T...> format, T&&... arguments) {
  const std::string text = fmt::format(format, std::forward<T>(arguments)...);
  std::fputs(text.c_str(), stderr);
}

}  // namespace genu::cli
