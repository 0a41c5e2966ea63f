// The knee in meshes/leskovar2019, as text.
#pragma once

#include <string>

#include "support/places.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu::test {

inline const std::string kLeskovar = genu::test::source_folder() + "/meshes/leskovar2019/";

/// calibration.toml with the numbers of scene.toml.
inline std::string leskovar_truth() {
  std::string text = read_file(kLeskovar + "calibration.toml");
  for (const auto& [start, truth] : {std::pair{"= 0.8 ", "= 0.5535 "},
                                     {"= 0.0006 ", "= 0.001 "},
                                     {"= 0.022 ", "= 0.033 "},
                                     {"= 0.0014 ", "= 0.001 "}})
    text = with_first(std::move(text), start, truth);
  return text;
}

}  // namespace genu::test
