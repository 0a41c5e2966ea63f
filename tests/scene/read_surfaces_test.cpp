#include "scene/scene_text.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <Eigen/LU>

namespace genu::scene_test {
namespace {

TEST(ReadSurfaces, Shapes) {
  const SurfaceDef sphere = ball_with(kBall);
  EXPECT_EQ(sphere.shape, SurfaceDef::Shape::sphere);
  EXPECT_EQ(sphere.body, 1);
  EXPECT_DOUBLE_EQ(sphere.radius, 0.02);
  EXPECT_TRUE(sphere.placement.p.isApprox(Vec3(1e-3, 2e-3, 3e-3), 1e-15));
  EXPECT_EQ(sphere.placement.R, Mat3::Identity());
  EXPECT_FALSE(sphere.inside);
  EXPECT_EQ(ball_with("shape = \"plane\"\n").shape, SurfaceDef::Shape::plane);
  const SurfaceDef cylinder = ball_with("shape = \"cylinder\"\nradius = 7.5\ninside = true\n");
  EXPECT_EQ(cylinder.shape, SurfaceDef::Shape::cylinder);
  EXPECT_DOUBLE_EQ(cylinder.radius, 0.0075);
  EXPECT_TRUE(cylinder.inside);
  const SurfaceDef ellipsoid = ball_with("shape = \"ellipsoid\"\nradii = [1, 2.0, 3]\n");
  EXPECT_EQ(ellipsoid.shape, SurfaceDef::Shape::ellipsoid);
  EXPECT_TRUE(ellipsoid.radii.isApprox(Vec3(1e-3, 2e-3, 3e-3), 1e-15));
  const SurfaceDef torus = ball_with("shape = \"torus\"\nmajor_radius = 15\nminor_radius = 5\n");
  EXPECT_EQ(torus.shape, SurfaceDef::Shape::torus);
  EXPECT_DOUBLE_EQ(torus.major_radius, 0.015);
  EXPECT_DOUBLE_EQ(torus.minor_radius, 0.005);
}

TEST(ReadSurfaces, PolynomialCoefficientsMeanTheSameHeightInSi) {
  const double x = 3, y = -2, theta = 0.7;  // mm, mm, rad
  const std::string terms = "terms = [[0, 0, 1.5], [1, 0, 0.2], [2, 1, -0.01], [0, 3, 4e-4]]\n";
  const auto value = [](const SurfaceDef& s, double u, double v) {
    double sum = 0;
    for (const auto& t : s.terms) sum += t.c * std::pow(u, t.i) * std::pow(v, t.j);
    return sum;
  };
  const auto in_file_units = [&](double u, double v) { return 1.5 + 0.2 * u - 0.01 * u * u * v + 4e-4 * v * v * v; };
  const SurfaceDef cartesian = ball_with("shape = \"polynomial\"\n" + terms);
  EXPECT_EQ(cartesian.shape, SurfaceDef::Shape::polynomial);
  EXPECT_NEAR(value(cartesian, 1e-3 * x, 1e-3 * y), 1e-3 * in_file_units(x, y), 1e-17);
  EXPECT_EQ(ball_with("shape = \"polynomial\"\nchart = \"cartesian\"\n" + terms).shape, SurfaceDef::Shape::polynomial);
  const SurfaceDef cylindrical = ball_with("shape = \"polynomial\"\nchart = \"cylindrical\"\n" + terms);
  EXPECT_EQ(cylindrical.shape, SurfaceDef::Shape::cylindrical_polynomial);
  EXPECT_NEAR(value(cylindrical, theta, 1e-3 * y), 1e-3 * in_file_units(theta, y), 1e-17);
}

TEST(ReadSurfaces, ShapeErrors) {
  expect_surface_refused("shape = @\"spere\"\nradius = 20\n", "shape", "\"spere\"", "did you mean \"sphere\"?");
  expect_refused("[surface.ball]\nbody = \"femur\"\nshape = \"sphere\"", "[surface.@ball]\nbody = \"femur\"",
                 "surface.ball.shape", "", "is missing");
  expect_refused("body = \"femur\"\nshape", "body = @\"patella\"\nshape", "surface.ball.body", "\"patella\"",
                 "unknown body; known: \"tibia\", \"femur\"");
  expect_surface_refused(kBall + "@radii = [1, 2, 3]\n", "radii", "[1, 2, 3]", "is no key of a sphere");
  expect_surface_refused(kBall + "inside = @\"yes\"\n", "inside", "\"yes\"", "must be true or false");
}

TEST(ReadSurfaces, RadiusErrors) {
  expect_surface_refused("shape = \"sphere\"\nradius = @0\n", "radius", "0", "must be > 0 mm");
  expect_surface_refused("shape = \"cylinder\"\nradius = @-2.5\n", "radius", "-2.5", "must be > 0 mm");
  expect_surface_refused("shape = \"cylinder\"\nradius = @1e-322\n", "radius", "1e-322", "is out of range");
  expect_surface_refused("shape = \"ellipsoid\"\nradii = [1, @-2, 3]\n", "radii[2]", "-2", "must be > 0 mm");
  expect_surface_refused("shape = \"ellipsoid\"\nradii = @2\n", "radii", "2", "three numbers");
  expect_surface_refused("shape = \"torus\"\nmajor_radius = @0\nminor_radius = 1\n", "major_radius", "0", "> 0 mm");
  expect_surface_refused("shape = \"torus\"\nmajor_radius = 3\nminor_radius = @-1\n", "minor_radius", "-1", "> 0 mm");
  expect_surface_refused("shape = \"torus\"\nmajor_radius = 3\nminor_radius = @\"1\"\n", "minor_radius", "\"1\"",
                         "must be a number, in mm");
}

TEST(ReadSurfaces, PolynomialErrors) {
  const std::string p = "shape = \"polynomial\"\n";
  expect_surface_refused(p + "terms = @[]\n", "terms", "[]", "at least one term");
  expect_surface_refused(p + "terms = @3\n", "terms", "3", "must be a list of terms");
  expect_surface_refused(p + "terms = [@[1, 2]]\n", "terms[1]", "[1, 2]", "must be a term [i, j, c]");
  expect_surface_refused(p + "terms = [[1, @-2, 1]]\n", "terms[1][2]", "-2", "an integer from 0 to 20");
  expect_surface_refused(p + "terms = [[@0.5, 0, 1]]\n", "terms[1][1]", "0.5", "an integer from 0 to 20");
  expect_surface_refused(p + "terms = [[@21, 0, 1]]\n", "terms[1][1]", "21", "an integer from 0 to 20");
  expect_surface_refused(p + "terms = [[0, 0, @nan]]\n", "terms[1][3]", "nan", "finite");
  expect_surface_refused(p + "terms = [[20, 20, @1e300]]\n", "terms[1][3]", "1e+300", "is out of range");
  expect_surface_refused(p + "terms = [[1, 0, 1], @[1, 0, 2]]\n", "terms[2]", "[1, 0, 2]", "stand in a term before");
  expect_surface_refused(p + "chart = @\"polar\"\nterms = [[1, 0, 1]]\n", "chart", "\"polar\"",
                         "must be one of \"cartesian\", \"cylindrical\"");
}

class MeshSurface : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / "genu_scene_mesh";
    std::filesystem::create_directories(folder_ / "geometry");
    std::ofstream(folder_ / "geometry" / "a.stl") << "solid a\nendsolid a\n";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(MeshSurface, FileIsRelativeToTheScene) {
  Diagnostics out;
  const std::string text = edited(
      kBall, "shape = \"mesh\"\nfile = \"geometry/../geometry/a.stl\"\nunits = \"m\"\nfit_radius = 5\ndegree = 3\n");
  const auto scene = parse_scene(text, (folder_ / "scene.toml").string(), out);
  ASSERT_TRUE(scene) << all_messages(out);
  const SurfaceDef& mesh = scene->surfaces[0];
  EXPECT_EQ(mesh.shape, SurfaceDef::Shape::mesh);
  EXPECT_EQ(mesh.file.text(), (folder_ / "geometry" / "a.stl").string());
  EXPECT_EQ(mesh.file_unit, 1);
  EXPECT_DOUBLE_EQ(mesh.fit_radius.value_or(0), 0.005);
  EXPECT_EQ(mesh.degree, 3);
  ASSERT_EQ(mesh.file.where.size(), 1u);
  EXPECT_EQ(mesh.file.where[0].line, 21);
  EXPECT_EQ(mesh.file.where[0].column, 8);
}

TEST_F(MeshSurface, UnitsOfTheFileAreItsOwn) {
  const std::string file = (folder_ / "geometry" / "a.stl").string();
  EXPECT_EQ(ball_with("shape = \"mesh\"\nfile = \"" + file + "\"\nunits = \"mm\"\n").file_unit, 1e-3);
  EXPECT_FALSE(ball_with("shape = \"mesh\"\nfile = \"" + file + "\"\nunits = \"mm\"\n").degree.has_value());
}

TEST_F(MeshSurface, FilesOfItsPiecesKeepTheirOrderAndPlaces) {
  const std::string a = (folder_ / "geometry" / "a.stl").string(), b = (folder_ / "geometry" / "b.stl").string();
  std::filesystem::copy_file(a, b);
  const std::string text =
      edited(kBall, "shape = \"mesh\"\nfile = [\"geometry/b.stl\",\n  \"geometry/a.stl\"]\nunits = \"mm\"\n");
  Diagnostics out;
  const auto scene = parse_scene(text, (folder_ / "scene.toml").string(), out);
  ASSERT_TRUE(scene) << all_messages(out);
  const PieceFiles& files = scene->surfaces[0].file;
  EXPECT_EQ(files.paths, (std::vector<std::string>{b, a}));
  EXPECT_EQ(files.where_of(a), (SourceLocation{22, 3}));
  EXPECT_EQ(mesh_files(*scene), files.paths);
  const auto refused = [&](const std::string& list, const std::string& key, const std::string& found,
                           const std::string& rule) {
    expect_surface_refused("shape = \"mesh\"\nfile = " + list + "\nunits = \"m\"\n", key, found, rule);
  };
  refused("@[]", "file", "[]", "must name a mesh file, or list the files of its pieces");
  refused("[\"" + a + "\", @\"no.stl\"]", "file[2]", "\"no.stl\"", "no such file: no.stl");
  refused("[\"" + a + "\", @7]", "file[2]", "7", "must be a string");
  refused("[\"" + a + "\", @\"" + a + "\"]", "file[2]", "\"" + a + "\"", "is in this list before");
}

TEST_F(MeshSurface, Errors) {
  const std::string file = (folder_ / "geometry" / "a.stl").string();
  const std::string mesh = "shape = \"mesh\"\nfile = \"" + file + "\"\nunits = \"m\"\n";
  expect_surface_refused("shape = \"mesh\"\nfile = @\"no.stl\"\nunits = \"m\"\n", "file", "\"no.stl\"",
                         "no such file: no.stl");
  expect_surface_refused("shape = \"mesh\"\nfile = @\"\"\nunits = \"m\"\n", "file", "\"\"", "must name a mesh file");
  expect_surface_refused("shape = \"mesh\"\nfile = @\"/\"\nunits = \"m\"\n", "file", "\"/\"", "is not a file");
  expect_surface_refused("shape = \"mesh\"\nfile = @7\nunits = \"m\"\n", "file", "7", "must be a string");
  expect_surface_refused("shape = \"mesh\"\nfile = \"" + file + "\"\nunits = @\"dm\"\n", "units", "\"dm\"",
                         "must be one of \"mm\", \"m\"");
  expect_surface_refused(mesh + "fit_radius = @0\n", "fit_radius", "0", "must be > 0 mm");
  expect_surface_refused(mesh + "degree = @1\n", "degree", "1", "must be an integer from 2 to 4");
  expect_surface_refused(mesh + "degree = @5\n", "degree", "5", "must be an integer from 2 to 4");
  expect_surface_refused(mesh + "degree = @3.0\n", "degree", "3.0", "must be an integer from 2 to 4");
  expect_refused("[surface.ball]\nbody = \"femur\"\n" + kBall,
                 "[surface.@ball]\nbody = \"femur\"\nshape = \"mesh\"\nfile = \"" + file + "\"\n", "surface.ball.units",
                 "", "is missing");
}

}  // namespace
}  // namespace genu::scene_test
