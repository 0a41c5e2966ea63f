// Closed shells and solids in place of open sheets: the same poses, and boxes as their closed form says.
#include <cmath>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_reader.h"
#include "genu/mesh_files/mesh_writer.h"
#include "genu/surface/analytic.h"
#include "support/data.h"
#include "support/knee_scene.h"
#include "support/layers.h"
#include "support/scene_model.h"
#include "support/scenes.h"
#include "support/shells.h"
#include "support/solved.h"

namespace genu {
namespace {

constexpr double kShell = 2.5e-3;  // m

const std::string kTriangles = "quadrature = \"triangles\"\ncast_from = ";

ResultTable solved_table(const test::TemporaryFolder& folder, const std::string& text) {
  Diagnostics out;
  Solution solution;
  EXPECT_EQ(run_scene(folder.write("scene.toml", text), folder / "out", {}, out, &solution), kExitOk)
      << test::messages(out);
  test::expect_judged_ok(folder / "scene.toml", solution.poses);
  EXPECT_EQ(solution.poses.rows(), static_cast<std::size_t>(solution.summary.poses_solved));
  return solution.poses;
}

void expect_same_poses(const ResultTable& sheets, const ResultTable& shells, const std::string& joint,
                       const std::string& force) {
  for (const std::string axis : {"x", "y", "z"})
    EXPECT_LT(test::worst_difference(sheets, shells, joint + "." + axis + "_mm"), 1e-6) << axis;
  const double difference = test::worst_difference(sheets, shells, force);
  std::printf("%zu poses; forces differ by at most %.1e N\n", sheets.rows(), difference);
  EXPECT_LT(difference, 1e-6);
}

/// A brick of 20 x 20 x 10 mm on one of 30 x 30 x 10 mm: the depth is W h / (M A).
TEST(ClosedShells, ABrickOnABrick) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(write_ply(test::box({-10e-3, -10e-3, 0}, {10e-3, 10e-3, 10e-3}, 20), folder / "brick.ply", 1e-3, ""), "");
  ASSERT_EQ(write_ply(test::box({-15e-3, -15e-3, -10e-3}, {15e-3, 15e-3, 0}, 30), folder / "base.ply", 1e-3, ""), "");
  const double force = 50, area = 400e-6, thickness = 4e-3;
  const double depth = force * thickness / (confined_modulus(5e6, 0.4) * area);
  for (const std::string from : {"brick", "base"}) {
    const std::string text = test::bone_on_ground("{ z = -0.01 }") +
                             test::surface("brick", "bone", "mesh", "file = \"brick.ply\"\nunits = \"mm\"") +
                             test::surface("base", "ground", "mesh", "file = \"base.ply\"\nunits = \"mm\"") +
                             test::layer("foot", "brick", "base", kTriangles + "\"" + from + "\"") +
                             test::load("w", "force = [0, 0, -50]") +
                             test::step(
                                 "prescribe = { \"j.x\" = [0, 0.2], \"j.y\" = 0, \"j.a\" = 0, \"j.b\" = 0, "
                                 "\"j.c\" = 0 }\nincrements = 2");
    const ResultTable poses = solved_table(folder, text);
    ASSERT_EQ(poses.rows(), 3u);
    for (std::size_t row = 0; row < 3; ++row) {
      EXPECT_NEAR(poses.number(row, "j.z_mm"), -1e3 * depth, 1e-9) << from;
      EXPECT_NEAR(poses.number(row, "foot.max_pressure_MPa"), 1e-6 * force / area, 1e-9) << from;
    }
  }
}

/// The same over smooth surfaces: what is lost is a strip at the brick's rounded edges.
TEST(ClosedShells, ABrickOnABrickOverSmoothSurfaces) {
  const double force = 50, area = 400e-6, thickness = 4e-3;
  const double depth = force * thickness / (confined_modulus(5e6, 0.4) * area);
  for (const int cells : {20, 40}) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(write_ply(test::box({-10e-3, -10e-3, 0}, {10e-3, 10e-3, 10e-3}, cells), folder / "brick.ply", 1e-3, ""),
              "");
    ASSERT_EQ(write_ply(test::box({-15e-3, -15e-3, -10e-3}, {15e-3, 15e-3, 0}, cells), folder / "base.ply", 1e-3, ""),
              "");
    const std::string text = test::bone_on_ground("{ z = -0.01 }") +
                             test::surface("brick", "bone", "mesh", "file = \"brick.ply\"\nunits = \"mm\"") +
                             test::surface("base", "ground", "mesh", "file = \"base.ply\"\nunits = \"mm\"") +
                             test::layer("foot", "brick", "base", "quadrature = \"smooth\"") +
                             test::load("w", "force = [0, 0, -50]") +
                             test::step(
                                 "prescribe = { \"j.x\" = [0, 0.2], \"j.y\" = 0, \"j.a\" = 0, \"j.b\" = 0, "
                                 "\"j.c\" = 0 }\nincrements = 2");
    const ResultTable poses = solved_table(folder, text);
    ASSERT_EQ(poses.rows(), 3u);
    for (std::size_t row = 0; row < 3; ++row) {
      std::printf("%d cells: depth %.4f of %.4f mm, pressure %.4f of %.4f MPa\n", cells, -poses.number(row, "j.z_mm"),
                  1e3 * depth, poses.number(row, "foot.max_pressure_MPa"), 1e-6 * force / area);
      EXPECT_NEAR(-poses.number(row, "j.z_mm"), 1e3 * depth, 6.0 / cells * 1e3 * depth);
      EXPECT_NEAR(poses.number(row, "foot.max_pressure_MPa"), 1e-6 * force / area, 6.0 / cells * 1e-6 * force / area);
    }
  }
}

/// The part of a mesh with centroids that are in.
template <typename In>
Mesh part(const Mesh& mesh, In in) {
  Mesh out;
  std::vector<int> number(mesh.vertices.size(), -1);
  for (const auto& t : mesh.triangles) {
    if (!in(Vec3((mesh.vertices[at(t[0])] + mesh.vertices[at(t[1])] + mesh.vertices[at(t[2])]) / 3))) continue;
    std::array<int, 3> kept{};
    for (std::size_t i = 0; i < 3; ++i) {
      int& v = number[at(t[i])];
      if (v < 0) {
        v = static_cast<int>(out.vertices.size());
        out.vertices.push_back(mesh.vertices[at(t[i])]);
      }
      kept[i] = v;
    }
    out.triangles.push_back(kept);
  }
  return out;
}

/// The knee of Dortmans 1984 on a layer, its tori and planes as sheets of triangles, `shell` thick where that is not 0.
std::string torus_knee(const test::TemporaryFolder& folder, double shell, const std::string& quadrature) {
  const auto write = [&](const Mesh& sheet, const std::string& name) {
    EXPECT_EQ(write_ply(shell > 0 ? test::thickened(sheet, shell) : sheet, folder / name, 1e-3, ""), "");
  };
  const Pose upright{(Mat3() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished(),
                     Vec3::Zero()};  // the torus's x along y, z along x
  write(part(make_torus(upright, 15e-3, 5e-3, false)->triangles(0.7e-3, Vec3::Zero(), 0.1),
             [](const Vec3& x) { return x.z() < -1e-3 && Vec2(x.y(), x.z()).norm() > 14e-3; }),
        "condyle.ply");
  write(test::sheet(20e-3, 40), "plateau.ply");
  std::string text = test::read_text(test::dortmans_file());
  for (const std::string side : {"medial", "lateral"}) {
    const auto replace_surface = [&](const std::string& bone, const std::string& file) {
      const std::string header = "[surface." + bone + "_" + side + "]";
      const std::size_t first = text.find(header), last = text.find("\n[", first + 1) + 1;
      text.replace(first, last - first,
                   header + "\nbody = \"" + bone + "\"\nshape = \"mesh\"\nfile = \"" + file +
                       "\"\nunits = \"mm\"\norigin = [" + (side == "medial" ? "-23" : "23") + ", 0, 0]\n\n");
    };
    replace_surface("femur", "condyle.ply");
    replace_surface("tibia", "plateau.ply");
    text =
        test::replaced(text, "tibia_" + side + "\"]\nmodel = \"rigid\"",
                       "tibia_" + side + "\"]\nmodel = \"cartilage\"\nmodulus = 10\npoisson = 0.45\nthickness = 5\n" +
                           test::replaced(quadrature, "CONDYLE", "femur_" + side));
  }
  return text;
}

TEST(ClosedShells, TheTorusKnee) {
  const test::TemporaryFolder folder;
  const std::string cast = kTriangles + "\"CONDYLE\"";
  const ResultTable sheets = solved_table(folder, torus_knee(folder, 0, cast)),
                    shells = solved_table(folder, torus_knee(folder, kShell, cast));
  expect_same_poses(sheets, shells, "knee", "medial.force_N");
}

/// The measured knee, flexed to 90 deg.
ResultTable measured_knee(double shell, const std::string& from) {
  const test::TemporaryFolder folder;
  std::string text = test::lenhart_scene("-medium", 0, 90, 9);
  for (const std::string bone : {"femur", "tibia"}) {
    const std::string path = test::data_path("lenhart2015/ACLC01-R-" + bone + "-cart-medium.stl");
    Diagnostics out;
    const auto sheet = read_mesh(path, 1, out);
    EXPECT_TRUE(sheet) << test::messages(out);
    if (!sheet) return {};
    EXPECT_EQ(write_ply(shell > 0 ? test::thickened(*sheet, shell) : *sheet, folder / (bone + ".ply"), 1, ""), "");
    text = test::replaced(text, path, bone + ".ply");
  }
  text = test::replaced(text, "model = \"rigid\"",
                        "model = \"cartilage\"\nmodulus = 10\npoisson = 0.45\nthickness = 6\n" + kTriangles + "\"" +
                            from + "_cartilage\"");
  return solved_table(folder, text);
}

TEST(ClosedShells, TheMeasuredKnee) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart-medium.stl");
  for (const std::string from : {"tibia", "femur"})
    expect_same_poses(measured_knee(0, from), measured_knee(kShell, from), "knee", "tibiofemoral.force_N");
}

}  // namespace
}  // namespace genu
