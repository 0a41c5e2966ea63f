#include "genu/assemble/fit_mesh.h"

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "support/data.h"
#include "support/meshed_scene.h"

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

/// The largest change of a coefficient, as what it changes at the patch's corner (m).
double worst_change(const SurfaceFit& a, const SurfaceFit& b) {
  if (a.terms.size() != b.terms.size()) return 1;
  double worst = 0;
  for (std::size_t k = 0; k < a.terms.size(); ++k)
    worst = std::max(worst, std::abs(a.terms[k].c - b.terms[k].c) * std::pow(a.patch.u1, a.terms[k].i) *
                                std::pow(a.patch.v1, a.terms[k].j));
  return worst;
}

class FitMeasured : public ::testing::TestWithParam<const char*> {};

/// mesh -> polynomial -> mesh file -> polynomial, with nothing said about the second fit.
TEST_P(FitMeasured, RoundTripKeepsTheCoefficients) {
  GENU_NEEDS_DATA(GetParam());
  const test::TemporaryFolder folder;
  Diagnostics out;
  FitMeshRequest request;
  request.file = test::data_path(GetParam());
  const auto fits = fit_mesh(request, out);
  ASSERT_EQ(fits.size(), 2u);
  for (const NamedFit& first : fits) {
    const SurfaceDef def = surface_def(first);
    const Mesh mesh = within_patch(make_analytic_surface(def), def)->triangles(1e-3, Vec3::Zero(), 0.05);
    for (const std::string format : {"ply", "stl"}) {
      FitMeshRequest unaided;
      unaided.file = folder / ("made." + format);
      ASSERT_EQ(write_mesh(mesh, unaided.file, 1e-3, ""), "");
      const auto again = fit_mesh(unaided, out);
      ASSERT_EQ(again.size(), 1u);
      EXPECT_EQ(again[0].fit.degree, first.fit.degree);
      const double worst = worst_change(first.fit, again[0].fit);
      std::printf("%s, degree %d, by %s: coefficients change by %.1e m, %.1e of the half side\n", first.name.c_str(),
                  first.fit.degree, format.c_str(), worst, worst / first.fit.patch.v1);
      EXPECT_LT(worst / first.fit.patch.v1, format == "ply" ? 1e-11 : 5e-6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Knees, FitMeasured,
                         ::testing::Values("lenhart2015/ACLC01-R-femur-cart.stl", "lenhart2015/ACLC01-R-tibia-cart.stl",
                                           "ssm/S001_Femur_Cartilage.ply", "ssm/S002_Femur_Cartilage.ply",
                                           "ssm/mean_Femur_Cartilage.ply"));

/// Scraps of a mesh of which next to nothing, or nothing at all, looks the way that is asked for.
TEST(FitMesh, ScrapsAreRefusedInEveryChart) {
  const test::TemporaryFolder folder;
  const std::string corners = "OFF\n6 2 0\n2 0 2\n4 3 2\n0 5 33\n1 4 10\n0 2 0\n2 4 3\n";
  for (const std::string faces : {"3 0 1 2\n3 3 4 5\n", "3 2 1 0\n3 5 4 3\n", "3 0 1 5\n3 5 4 3\n"})
    for (const auto cylindrical : {std::optional<bool>(false), std::optional<bool>(true), std::optional<bool>()})
      for (const Vec3& facing : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, -1, 0)}) {
        FitMeshRequest request;
        request.file = folder.write("scrap.off", corners + faces);
        request.cylindrical = cylindrical;
        request.facing = facing;
        Diagnostics out;
        EXPECT_TRUE(fit_mesh(request, out).empty());
        EXPECT_TRUE(out.has_errors());
      }
}

}  // namespace
}  // namespace genu
