#include "genu/run/fit_mesh.h"

#include <gtest/gtest.h>

#include "run/meshed_scene.h"

namespace genu {
namespace {

TEST(FitMesh, FindsItsUnitAndNames) {
  const test::TemporaryFolder folder;
  test::meshed_scene(folder);
  for (const bool metres : {false, true}) {
    Diagnostics out;
    FitMeshRequest request;
    request.file = folder / "femur_medial.ply";
    if (metres) {
      const auto scene = read_scene(test::kWismans, out);
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
