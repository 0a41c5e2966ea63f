// Scenes of measured knees for tests: the published scene with other meshes, and scenes of the shape model's knees.
#pragma once

#include <fstream>
#include <sstream>
#include <string>

#include "support/data.h"
#include "support/places.h"

namespace genu::test {

inline std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
  return text;
}

/// The Lenhart 2015 tibiofemoral knee with meshes of the given resolution ("", "-medium", "-coarse", "-wicked-coarse"),
/// flexed from `from` to `to` degrees; its mesh paths are absolute.
inline std::string lenhart_scene(const std::string& resolution, double from, double to, int increments) {
  std::string text = read_text(genu::test::source_folder() + "/meshes/lenhart2015/scene.toml");
  text = replaced(text, "../../../shared/data/lenhart2015/", data_path("lenhart2015/"));
  text = replaced(text, "-cart.stl", "-cart" + resolution + ".stl");
  std::ostringstream step;
  step << "[[step]]\nprescribe = { \"knee.flexion\" = [" << from << ", " << to << "] }\nincrements = " << increments
       << "\n";
  return text.substr(0, text.find("[[step]]")) + step.str();
}

}  // namespace genu::test
