// Where the tests of accuracy leave their tables.
#pragma once

#include <cstdlib>
#include <fstream>
#include <string>

#include <fmt/format.h>

namespace genu::test {

/// Prints a table of Markdown under its title, and appends it to the file that GENU_ACCURACY_TABLE names.
inline void write_down(const std::string& title, const std::string& table) {
  const std::string text = "## " + title + "\n\n" + table + "\n";
  fmt::print("{}", text);
  if (const char* file = std::getenv("GENU_ACCURACY_TABLE")) std::ofstream(file, std::ios::app) << text;
}

}  // namespace genu::test
