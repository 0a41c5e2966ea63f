// Cartilage as cells on rigid bone (Guess et al. 2013) is the triangle quadrature: the spring of a cell, and what a
// joint owes to the cells' size (meshes/lenhart_polynomial/CELLS.md).
#include "studies/cells_study.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/places.h"
#include "support/scenes.h"
#include "validation/study_files.h"

namespace genu::studies {
namespace {

const std::string kCellsFolder = genu::test::source_folder() + "/meshes/lenhart_polynomial";

const std::vector<CellSize>& sizes() {
  static const std::vector<CellSize> solved = [] {
    Diagnostics out;
    return solve_cells(kCellsFolder, out);
  }();
  return solved;
}

/// One cell of 3 x 4 / 2 mm^2, pressed 0.2 mm into a block: its force is k d with k = p A / d.
TEST(CellStudy, ACellIsASpring) {
  test::TemporaryFolder folder;
  std::ofstream(folder / "cell.obj") << "v 0 0 0\nv 3 0 0\nv 0 4 0\nf 1 2 3\n";
  std::ofstream(folder / "block.obj") << "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 3 2\nf 1 4 3\n";
  const std::string text = R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.block]
[joint.j]
type = "free"
parent = "ground"
child = "block"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
[surface.cell]
body = "ground"
shape = "mesh"
file = "cell.obj"
units = "mm"
[surface.block]
body = "block"
shape = "mesh"
file = "block.obj"
units = "mm"
[contact.c]
surfaces = ["block", "cell"]
model = "cartilage"
modulus = 10
poisson = 0.45
thickness = 6
quadrature = "triangles"
cast_from = "cell"
[ligament.guide]
from = { body = "block", point = [0, 0, 0] }
to = { body = "ground", point = [0, 100, 0] }
law = "spring"
stiffness = 1
slack_length = 100
[[step]]
prescribe = { "j.a" = 0, "j.b" = 0, "j.c" = 0, "j.x" = 0, "j.z" = [-0.1, -0.2] }
increments = 1
)";
  std::ofstream(folder / "scene.toml") << text;
  Diagnostics out;
  const auto solved = solve_scene(folder / "scene.toml", out);
  ASSERT_TRUE(solved) << test::messages(out);
  const double k = 0.55 * 10 / (1.45 * 0.1) / 6 * 6;  // (1 - nu) E / ((1 + nu) (1 - 2 nu)) / h A, N/mm
  for (const std::size_t row : {0U, 1U})
    EXPECT_NEAR(solved->solution.poses.number(row, "c.force_N"), k * 0.1 * (1.0 + static_cast<double>(row)), 1e-9 * k);
}

TEST(CellStudy, ForcesHardlyDependOnTheCellsSizeButAreasDo) {
  ASSERT_EQ(sizes().size(), 5u);
  const CellSize& fine = sizes().front();
  double force = 0, area = 0;
  for (const CellSize& s : sizes()) {
    EXPECT_TRUE(s.all_stable) << s.edge;
    ASSERT_EQ(s.flexion.size(), 10u);
    double worst_force = 0, worst_area = 0;
    for (std::size_t k = 0; k < s.flexion.size(); ++k) {
      worst_force = std::max(worst_force, std::abs(s.medial[k] / fine.medial[k] - 1));
      worst_force = std::max(worst_force, std::abs(s.lateral[k] / fine.lateral[k] - 1));
      worst_area = std::max(worst_area, std::abs(s.medial_area[k] / fine.medial_area[k] - 1));
      worst_area = std::max(worst_area, std::abs(s.lateral_area[k] / fine.lateral_area[k] - 1));
    }
    fmt::print("  {:5} cells of {:5.2f} mm^2: forces within {:4.1f} %, areas within {:4.1f} %\n", s.cells, s.area,
               100 * worst_force, 100 * worst_area);
    EXPECT_GE(worst_force + 1e-3, force) << "the coarser, the farther";
    force = worst_force;
    area = worst_area;
  }
  EXPECT_LT(force, 0.10);
  EXPECT_GT(area, 0.10);
}

TEST(CellStudy, ThePageInTheFolderIsThatOfThisBuild) { test::expect_same_files(kCellsFolder, cells_files(sizes())); }

}  // namespace
}  // namespace genu::studies
