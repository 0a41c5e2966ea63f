// The public knee data: where GENU_DATA says, else where the build was told. Tests that need it are skipped, visibly,
// where it is not there.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/places.h"

namespace genu::test {

inline std::string data_path(const std::string& file) {
  const char* folder = std::getenv("GENU_DATA");
  return std::string(folder != nullptr ? folder : genu::test::data_default()) + "/" + file;
}

}  // namespace genu::test

#define GENU_NEEDS_DATA(file)                                                  \
  if (!std::filesystem::exists(genu::test::data_path(file))) {                 \
    GTEST_SKIP() << "no " << genu::test::data_path(file) << "; set GENU_DATA"; \
  }
