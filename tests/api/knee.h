// The knee that the tests of the API solve, and files as texts.
#pragma once

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "genu/api/scene.h"
#include "support/places.h"

namespace genu::api {

inline std::string knee_file() { return genu::test::source_folder() + "/meshes/dortmans1984/scene.toml"; }

inline std::string text_of(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What SceneError says; empty where nothing is thrown.
template <typename F>
std::string refusal_of(const F& f) {
  try {
    f();
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto place = text.find(what);
  EXPECT_NE(place, std::string::npos) << what;
  return place == std::string::npos ? text : text.replace(place, what.size(), with);
}

/// The text without the table [ligament.NAME].
inline std::string without_table(const std::string& text, const std::string& header) {
  const auto begin = text.find("[" + header + "]");
  EXPECT_NE(begin, std::string::npos) << header;
  return text.substr(0, begin) + text.substr(std::min(text.size(), text.find("\n[", begin) + 1));
}

inline std::string csv(const Scene& scene) { return scene.run().poses().csv(); }

}  // namespace genu::api
