// Made scenes both ways: surfaces that face each other and that do not, shells that are gone through.
#include "genu/appraise/layer_doubts.h"

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_writer.h"
#include "support/data.h"
#include "support/knee_scene.h"
#include "support/layers.h"
#include "support/places.h"
#include "support/scene_model.h"
#include "support/scenes.h"

namespace genu {
namespace {

/// A closed plate |x|, |y| <= half, from z = low to high.
Mesh plate(double half, double low, double high) {
  constexpr int kCells = 12;
  Mesh mesh = test::sheet(half, kCells);
  const auto top = mesh.triangles;
  const int below = static_cast<int>(mesh.vertices.size());
  for (int v = 0; v < below; ++v) {
    Vec3 x = mesh.vertices[static_cast<std::size_t>(v)];
    mesh.vertices[static_cast<std::size_t>(v)][2] = high;
    x[2] = low;
    mesh.vertices.push_back(x);
  }
  for (const auto& t : top) mesh.triangles.push_back({t[0] + below, t[2] + below, t[1] + below});
  const auto wall = [&](int a, int b) {
    mesh.triangles.push_back({b, a, a + below});
    mesh.triangles.push_back({b, a + below, b + below});
  };
  constexpr int kRow = kCells + 1, kLast = kCells * kRow;
  for (int i = 0; i < kCells; ++i) {
    wall(i, i + 1);
    wall(kLast + i + 1, kLast + i);
    wall((i + 1) * kRow, i * kRow);
    wall(i * kRow + kCells, (i + 1) * kRow + kCells);
  }
  return mesh;
}

/// A plate, `thick` (m), on one of 1 mm: the upper casts. `more` goes to the upper surface.
std::optional<Prepared> plates(const std::string& depth, const std::string& more = "", double thick = 1e-3) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(write_ply(plate(10e-3, 0, thick), folder / "upper.ply", 1e-3, ""), "");
  EXPECT_EQ(write_ply(plate(14e-3, -1e-3, 0), folder / "lower.ply", 1e-3, ""), "");
  const std::string text =
      test::bone_on_ground() + test::surface("upper", "bone", "mesh", "file = \"upper.ply\"\nunits = \"mm\"\n" + more) +
      test::surface("lower", "ground", "mesh", "file = \"lower.ply\"\nunits = \"mm\"") +
      "[contact.foot]\nsurfaces = [\"upper\", \"lower\"]\nmodel = \"cartilage\"\nmodulus = 5\npoisson = 0.4\n"
      "thickness = 6\nquadrature = \"triangles\"\ncast_from = \"upper\"\nsearch_depth = " +
      depth + "\n" + test::step("");
  Diagnostics out;
  auto prepared = prepare(folder.write("scene.toml", text), out);
  EXPECT_TRUE(prepared) << test::messages(out);
  return prepared;
}

State lifted(const Prepared& p, double z) {
  State state = start_state(p.model);
  state.poses[1].p = Vec3(0.3e-3, 0.1e-3, z);
  return state;
}

TEST(LayerDoubts, PlatesThatPressAreSilent) {
  const auto p = plates("0.8");
  ASSERT_TRUE(p);
  for (const double z : {0.5e-3, 0.0, -0.2e-3, -0.4e-3}) {
    const State state = lifted(*p, z);
    EXPECT_TRUE(facing_doubts(*p, {&state}).empty()) << z;
    EXPECT_TRUE(passed_doubts(*p, {&state}).empty()) << z;
  }
}

TEST(LayerDoubts, ASurfaceThatHasGoneThroughAShell) {
  for (const double thick : {1e-3, 8e-3}) {
    const auto p = plates("6", "", thick);
    ASSERT_TRUE(p);
    // Rays from the back of a plate of 1 mm pass through the lower one, and carry nothing.
    for (const double z : {0.5e-3, -0.2e-3, -0.95e-3}) {
      const State state = lifted(*p, z);
      EXPECT_TRUE(passed_doubts(*p, {&state}).empty()) << z;
    }
  }
  const auto p = plates("6", "", 8e-3);
  ASSERT_TRUE(p);
  const State through = lifted(*p, -1.3e-3);
  const auto said = passed_doubts(*p, {&through});
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("288 of the triangles of upper have gone through lower, by up to 0.30 mm"), std::string::npos)
      << said[0];
}

TEST(LayerDoubts, SurfacesThatFaceTheSameWay) {
  const auto p = plates("0.8", "inside = true");
  ASSERT_TRUE(p);
  for (const double z : {0.3e-3, -0.2e-3}) {
    const State state = lifted(*p, z), far = lifted(*p, 50e-3);
    const auto said = facing_doubts(*p, {&far, &state});
    ASSERT_EQ(said.size(), 1u) << z;
    EXPECT_NE(said[0].find("The surfaces of foot face the same way"), std::string::npos) << said[0];
    EXPECT_NE(said[0].find("nearest triangles of upper"), std::string::npos) << said[0];
    EXPECT_TRUE(facing_doubts(*p, {&far}).empty());
  }
}

TEST(LayerDoubts, BallInASocketAndOnAPlane) {
  const std::string ball = test::bone_on_ground("{ z = 0 }") + test::surface("ball", "bone", "sphere", "radius = 20");
  const std::string layer =
      "[contact.foot]\nsurfaces = [\"ball\", \"floor\"]\nmodel = \"cartilage\"\nmodulus = 5\npoisson = 0.4\n"
      "thickness = 4\n" +
      test::step("");
  const auto doubts = [&](const std::string& floor, double z) {
    const test::TemporaryFolder folder;
    Diagnostics out;
    const auto p = prepare(folder.write("scene.toml", ball + floor + layer), out);
    EXPECT_TRUE(p) << test::messages(out);
    const State state = lifted(*p, z);
    return facing_doubts(*p, {&state}).size() + passed_doubts(*p, {&state}).size();
  };
  EXPECT_EQ(doubts(test::surface("floor", "ground", "plane"), 19e-3), 0u);
  EXPECT_EQ(doubts(test::surface("floor", "ground", "plane", "inside = true"), 19e-3), 1u);
  EXPECT_EQ(doubts(test::surface("floor", "ground", "sphere", "radius = 21\ninside = true"), -1.5e-3), 0u);
  EXPECT_EQ(doubts(test::surface("floor", "ground", "sphere", "radius = 21"), -1.5e-3), 1u);
}

std::vector<PoseRecord> records_at(const Prepared& p, const std::vector<double>& heights) {
  std::vector<PoseRecord> records;
  for (const double z : heights) {
    records.emplace_back();
    records.back().point.pose.state = lifted(p, z);
  }
  records.emplace_back();  // a pose that was not solved
  return records;
}

/// A ball of 20 mm that is pressed 6.3 mm wide has its tolerance; one of 1e12 MPa, pressed 6 um wide, cannot have it.
TEST(LayerDoubts, ContactSmallerThanTriangles) {
  const auto said = [](const std::string& modulus, double depth) {
    const test::TemporaryFolder folder;
    Diagnostics out;
    const auto p = prepare(
        folder.write("scene.toml",
                     test::bone_on_ground("{ z = 0 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
                         test::surface("floor", "ground", "plane", "patch = { x = [-9, 9], y = [-9, 9] }") +
                         "[contact.foot]\nsurfaces = [\"ball\", \"floor\"]\nmodel = \"cartilage\"\n"
                         "thickness = 4\npoisson = 0.4\nmodulus = " +
                         modulus + "\n" + test::step("")),
        out);
    EXPECT_TRUE(p) << test::messages(out);
    auto records = records_at(*p, {20e-3 - depth});
    records[0].point.pose.state.layer_levels = {p->model.layers[0].most_level};
    return tolerance_doubts(*p, records);
  };
  EXPECT_TRUE(said("5", 1e-3).empty());
  const auto narrow = said("1e12", 1e-9);
  ASSERT_EQ(narrow.size(), 1u);
  EXPECT_NE(narrow[0].find("The force of the layer of foot misses its tolerance of 1e-04 in row 1: it may err by"),
            std::string::npos)
      << narrow[0];
}

/// A ball of 20 mm, 1 mm deep in what is under it: pressed 6.3 mm wide.
TEST(LayerDoubts, ContactAtTheRimOfAPatch) {
  const std::string ball = test::bone_on_ground("{ z = 0 }") + test::surface("ball", "bone", "sphere", "radius = 20");
  for (const std::string quadrature :
       {"", "quadrature = \"triangles\"\ncast_from = \"ball\"", "quadrature = \"triangles\"\ncast_from = \"floor\""})
    for (const std::string last : {"0", "9"}) {
      const test::TemporaryFolder folder;
      Diagnostics out;
      const std::string floor = "patch = { x = [-30, " + last + "], y = [-30, 30] }";
      const auto p =
          prepare(folder.write("scene.toml", ball + test::surface("floor", "ground", "plane", floor) +
                                                 test::layer("foot", "ball", "floor", quadrature) + test::step("")),
                  out);
      ASSERT_TRUE(p) << test::messages(out);
      const auto said = footing_doubts(*p, records_at(*p, {19e-3, 21e-3, 19.2e-3}));
      EXPECT_EQ(said.size(), last == "0" ? 1u : 0u) << quadrature << (said.empty() ? "" : said[0]);
      if (said.empty()) continue;
      EXPECT_NE(said[0].find("The contact area of foot reaches the rim of the patch of surface floor in rows 1 "
                             "and 3"),
                std::string::npos)
          << said[0];
    }
}

/// Cartilage with bone under its left half alone, pressed by a ball in the middle of either half.
TEST(LayerDoubts, ContactOnThicknessThatWasFilledIn) {
  const test::TemporaryFolder folder;
  Mesh bone = test::sheet(20e-3, 20);
  for (Vec3& v : bone.vertices) v = Vec3(v[0] - 20e-3, v[1], -2e-3);
  EXPECT_EQ(write_ply(test::sheet(20e-3, 40), folder / "cartilage.ply", 1e-3, ""), "");
  EXPECT_EQ(write_ply(bone, folder / "bone.ply", 1e-3, ""), "");
  for (const std::string quadrature :
       {"", "quadrature = \"triangles\"\ncast_from = \"ball\"", "quadrature = \"triangles\"\ncast_from = \"floor\""}) {
    const std::string layer = test::replaced(test::layer("foot", "ball", "floor", quadrature), "thickness = 4\n", "");
    Diagnostics out;
    const auto p = prepare(
        folder.write("scene.toml", test::bone_on_ground() +
                                       test::surface("ball", "bone", "sphere", "radius = 20\nthickness = 0") +
                                       test::surface("floor", "ground", "mesh",
                                                     "file = \"cartilage.ply\"\nunits = \"mm\"\nthickness = { bone = "
                                                     "\"bone.ply\", units = \"mm\" }") +
                                       layer + test::step("")),
        out);
    ASSERT_TRUE(p) << test::messages(out);
    auto records = records_at(*p, {19.8e-3, 19.8e-3});
    records[0].point.pose.state.poses[1].p.x() = -10e-3;
    EXPECT_TRUE(footing_doubts(*p, {records[0]}).empty());
    records[1].point.pose.state.poses[1].p.x() = 10e-3;
    const auto said = footing_doubts(*p, records);
    ASSERT_EQ(said.size(), 1u) << quadrature;
    EXPECT_NE(said[0].find("The contact of foot loads cartilage without bone under it"), std::string::npos) << said[0];
    EXPECT_NE(said[0].find("in row 2: "), std::string::npos) << said[0];
  }
}

TEST(LayerDoubts, MeasuredKneesAreSilent) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl");
  for (const std::string name : {"scene-cartilage.toml", "scene-published-poses.toml"}) {
    const std::string file = genu::test::source_folder() + "/meshes/lenhart2015/" + name;
    const test::TemporaryFolder folder;
    const std::string text = test::replaced(test::read_text(file), "../../../shared/data/", test::data_path(""));
    Diagnostics out;
    const auto p = prepare(folder.write("scene.toml", text), out);
    ASSERT_TRUE(p) << test::messages(out);
    const State start = start_state(p->model);
    for (const std::string& said : facing_doubts(*p, {&start})) ADD_FAILURE() << said;
    for (const std::string& said : passed_doubts(*p, {&start})) ADD_FAILURE() << said;
  }
}

}  // namespace
}  // namespace genu
