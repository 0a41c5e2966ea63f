#include "genu/assemble/surface_fits.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace genu {
namespace {

NamedFit named(bool cylindrical) {
  NamedFit out;
  out.name = "s";
  out.body = "femur";
  out.source = "a.stl";
  out.fit.chart = {cylindrical, {exp_rotation(Vec3(1, 2, 3)), Vec3(0.1, 0.2, 0.3)}};
  out.fit.patch = {-0.5, 0.5, -0.01, 0.01};
  out.fit.degree = 2;
  out.fit.terms = {{0, 0, 0.02}, {2, 0, 0.001}, {1, 1, 0.03}};
  return out;
}

TEST(SurfaceFits, AKnownPatchIsTheFits) {
  for (const bool cylindrical : {false, true}) {
    const NamedFit fit = named(cylindrical);
    const auto known = known_patch(surface_def(fit));
    ASSERT_TRUE(known);
    EXPECT_EQ(known->chart.cylindrical, cylindrical);
    EXPECT_EQ(known->degree, 2);
    EXPECT_EQ(known->patch.u1, 0.5);
    EXPECT_EQ(known->patch.v0, -0.01);
    EXPECT_EQ(known->chart.X_BS.p, fit.fit.chart.X_BS.p);
  }
  SurfaceDef half = surface_def(named(false));
  half.patch->box[1].reset();
  EXPECT_FALSE(known_patch(half));
  half = surface_def(named(true));
  half.patch->box[0] = std::pair(-1.0, 1.0);
  EXPECT_FALSE(known_patch(half));
  EXPECT_FALSE(known_patch({}));
}

TEST(SurfaceFits, AFolderAppearsWholeOrNotAtAll) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(write_folder(folder / "a", fit_files({named(true)})), "");
  EXPECT_TRUE(std::filesystem::exists(folder / "a/coverage.svg"));
  EXPECT_EQ(write_folder(folder / "a", fit_files({named(false)})), "");  // its own results may be replaced
  folder.write("file", "kept");
  EXPECT_NE(write_folder(folder / "file", fit_files({named(true)})), "");
  EXPECT_EQ(test::read_file(folder / "file"), "kept");
}

}  // namespace
}  // namespace genu
