// A knee of hand-made polynomials, as Wismans et al. 1980 have them, with its polynomials cut into mesh files.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "genu/assemble/build_surface.h"
#include "genu/mesh_files/mesh_writer.h"
#include "genu/scene/reader.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace genu::test {

/// The wismans knee, whose surfaces are cut into meshes and fitted again.
inline const std::string kWismans = genu::test::source_folder() + "/tests/support/polynomial_knee.toml";

inline std::string text_of(const std::string& path) { return read_file(path); }

/// A scene with the plateaus and condyles of polynomial_knee.toml as meshes, flexed from 0 to 30 deg; `extra` at its
/// end.
inline std::string meshed_scene(const TemporaryFolder& folder) {
  Diagnostics out;
  const auto scene = read_scene(kWismans, out);
  std::string text = text_of(kWismans);
  text = text.substr(0, text.find("[[step]]"));
  for (const SurfaceDef& def : scene->surfaces) {
    const auto surface = within_patch(make_analytic_surface(def), def);
    EXPECT_EQ(write_ply(surface->triangles(1e-3, def.placement.p, 0.05), folder / (def.name + ".ply"), 1e-3, ""), "");
    const std::string header = "[surface." + def.name + "]";
    const std::size_t first = text.find(header), last = text.find("\n[", first + 1) + 1;
    const std::string body = def.body == 0 ? scene->bodies[0].name : scene->bodies[1].name;
    text.replace(
        first, last - first,
        header + "\nbody = \"" + body + "\"\nshape = \"mesh\"\nfile = \"" + def.name + ".ply\"\nunits = \"mm\"\n\n");
  }
  text += "[[step]]\nprescribe = { \"knee.flexion\" = [0, 30] }\nload = { drawer = 0 }\nincrements = 6\n";
  return folder.write("scene.toml", text);
}

}  // namespace genu::test
