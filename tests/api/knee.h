// The knee that the tests of the API solve, and files as texts.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

#include "genu/api/problem.h"
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

}  // namespace genu::api
