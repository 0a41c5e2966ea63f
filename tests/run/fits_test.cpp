// Fits of a scene's surfaces: zones from a solved scene, the edited scene, the surfaces of a mesh file.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "genu/geometry/mesh_writer.h"
#include "genu/run/build_surface.h"
#include "genu/run/contact_zones.h"
#include "genu/run/fit_mesh.h"
#include "genu/run/fit_scene.h"
#include "genu/run/scene_edit.h"
#include "genu/scene/reader.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

/// The wismans knee, whose surfaces are cut into meshes and fitted again.
const std::string kWismans = std::string(GENU_SOURCE_DIR) + "/meshes/wismans1980/scene.toml";

std::string text_of(const std::string& path) { return test::read_file(path); }

/// A scene with the plateaus and condyles of wismans1980 as meshes, flexed from 0 to 30 deg; `extra` at its end.
std::string meshed_scene(const test::TemporaryFolder& folder) {
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

TEST(FitScene, GivesTheKneeBack) {
  const test::TemporaryFolder folder;
  FitSceneRequest request;
  request.file = meshed_scene(folder);
  Diagnostics out;
  const auto fits = fit_scene(request, folder / "fitted", out);
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  ASSERT_TRUE(fits);
  ASSERT_EQ(fits->fits.size(), 4u);
  for (const NamedFit& f : fits->fits) {
    EXPECT_FALSE(f.contacts.empty());
    EXPECT_LT(f.fit.residual.rms, 1e-5) << f.name;
  }
  const auto prepared = prepare(folder.write("fitted.toml", fits->scene), out);
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  ASSERT_TRUE(prepared);
  ContactField field(prepared->model);
  const Solution solution = solve(*prepared, field, {});
  EXPECT_EQ(solution.summary.exit_code, kExitOk);
  for (const auto& [name, worst] : pose_differences(prepared->scene, fits->solution.poses, solution.poses)) {
    std::printf("  %-20s %.2e\n", name.c_str(), worst);
    EXPECT_LT(worst, 0.1) << name;
  }
  EXPECT_NE(fits->scene.find("[load.drawer]"), std::string::npos);
  EXPECT_EQ(fits->scene.find("shape = \"mesh\""), std::string::npos);
}

TEST(FitScene, AScenWithoutMeshesHasNothingToFit) {
  FitSceneRequest request;
  request.file = kWismans;
  Diagnostics out;
  EXPECT_FALSE(fit_scene(request, "out", out));
  EXPECT_TRUE(out.has_errors());
}

TEST(ContactZones, PartContactsThatStayApart) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  const auto prepared = prepare(meshed_scene(folder), out);
  ASSERT_TRUE(prepared);
  ContactField field(prepared->model);
  const auto zones = contact_zones(*prepared, solve(*prepared, field, {}), 0.015);
  ASSERT_EQ(zones.size(), 2u);
  EXPECT_EQ(zones[0].name, "medial");
  EXPECT_EQ(zones[0].points_a.size(), zones[0].normals_b.size());
  for (const Vec3& p : zones[0].points_b) EXPECT_LT(p.x(), 0);
}

TEST(SceneEdit, RefusesTablesItCannotCutOut) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  std::string text = text_of(meshed_scene(folder));
  const std::size_t at = text.find("[contact.medial]"), end = text.find("\n[", at + 1);
  text.replace(at, end - at,
               "[contact]\nmedial = { surfaces = [\"femur_medial\", \"tibia_medial\"], model = \"rigid\" }\n");
  const std::string file = folder.write("inline.toml", text);
  const auto scene = read_scene(file, out);
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  ASSERT_TRUE(scene);
  with_fitted_surfaces(file, *scene, {{0, "medial", "femur_medial", "tibia_medial"}}, {}, folder / "out", out);
  ASSERT_TRUE(out.has_errors());
  EXPECT_EQ(out.items().back().key, "contact.medial");
}

TEST(FitMesh, FindsItsUnitAndNames) {
  const test::TemporaryFolder folder;
  meshed_scene(folder);
  for (const bool metres : {false, true}) {
    Diagnostics out;
    FitMeshRequest request;
    request.file = folder / "femur_medial.ply";
    if (metres) {
      const auto scene = read_scene(kWismans, out);
      const auto surface = within_patch(make_analytic_surface(scene->surfaces[0]), scene->surfaces[0]);
      request.file = folder / "9 metres.obj";
      ASSERT_EQ(write_obj(surface->triangles(1e-3, Vec3::Zero(), 0.05), request.file, 1, ""), "");
    }
    const auto fits = fit_mesh(request, out);
    ASSERT_EQ(fits.size(), 1u);
    EXPECT_EQ(fits[0].name, metres ? "surface_9_metres" : "femur_medial");
    EXPECT_LT(fits[0].fit.residual.rms, 5e-5);
    EXPECT_TRUE(fits[0].fit.chart.cylindrical);
    const std::string file = surface_file(fits, "t");
    const auto back = read_surface_file(folder.write("s.toml", file), out);
    ASSERT_TRUE(back) << file;
    const auto known = known_patch(back->surfaces[0]);
    ASSERT_TRUE(known);
    EXPECT_EQ(known->degree, fits[0].fit.degree);
    EXPECT_NEAR(known->patch.u1, fits[0].fit.patch.u1, 1e-9);
    EXPECT_FALSE(describe(fits[0].fit).empty());
    EXPECT_EQ(fit_files(fits).size(), 2u);
  }
}

}  // namespace
}  // namespace genu
