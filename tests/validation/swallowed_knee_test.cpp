// However deep one bone of a knee is inside the other, the search for contacts never takes the pose for a free one; the
// judge counts vertices of each bone inside the other, triangle by triangle.
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/mesh/mesh_topology.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/mesh_files/stl_writer.h"
#include "genu/surface/analytic.h"
#include "support/brute_force.h"
#include "support/knee_scene.h"
#include "support/scenes.h"
#include "support/ssm_scene.h"

namespace genu {
namespace {

struct Knee {
  std::optional<Prepared> prepared;
  std::optional<ContactField> field;
  State start;

  explicit Knee(const std::string& text) {
    const test::TemporaryFolder folder;
    Diagnostics out;
    prepared = prepare(folder.write("scene.toml", text), out);
    EXPECT_TRUE(prepared) << test::messages(out);
    if (!prepared) return;
    field.emplace(prepared->model);
    start = start_state(prepared->model);
  }

  /// How far (m) the search sees the one pair overlap with the tibia displaced by X about where it starts.
  double overlap(const Pose& X) {
    State state = start;
    state.poses[moving()] = start.poses[moving()] * X;
    return field->overlap(state, 0);
  }
  std::size_t moving() const { return prepared->model.bodies[0].moving >= 0 ? 0 : 1; }

  /// The relative pose of the pair's second body in the first.
  Pose relative(const Pose& X) const {
    std::vector<Pose> poses = start.poses;
    poses[moving()] = poses[moving()] * X;
    const auto& pair = prepared->model.pairs[0];
    return poses[static_cast<std::size_t>(pair.body_a)].inverse() * poses[static_cast<std::size_t>(pair.body_b)];
  }
};

/// How many of about `count` vertices of `b` lie inside the closed mesh `a`.
int vertices_inside(const Mesh& a, const Mesh& b, const Pose& X_ab, std::size_t count) {
  int inside = 0;
  for (std::size_t v = 0; v < b.vertices.size(); v += b.vertices.size() / count)
    inside += test::winding_number(a, X_ab * b.vertices[v]) > 0.5;
  return inside;
}

TEST(SwallowedKnee, ClosedBonesAreNeverFreeInsideEachOther) {
  GENU_NEEDS_DATA("ssm/S001_Femur.ply");
  std::string text = test::ssm_scene("S001", 10, 1);
  for (const char* bone : {"Femur", "Tibia"})
    text = test::replaced(text, std::string(bone) + "_Cartilage.ply", std::string(bone) + ".ply");
  Knee knee(text);
  ASSERT_TRUE(knee.prepared);
  const Mesh a = knee.prepared->surfaces[0]->triangles(0, Vec3::Zero(), 0),
             b = knee.prepared->surfaces[1]->triangles(0, Vec3::Zero(), 0);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  int deep = 0, clear = 0;
  for (int i = 0; i < 60; ++i) {
    const Vec3 turn{unit(random), unit(random), unit(random)}, shift{unit(random), unit(random), unit(random)};
    const Pose X{exp_rotation(0.6 * turn), 0.045 * shift};
    const Pose X_ab = knee.relative(X);
    const int inside = vertices_inside(a, b, X_ab, 60) + vertices_inside(b, a, X_ab.inverse(), 60);
    const double overlap = knee.overlap(X);
    if (inside > 0) {
      EXPECT_GT(overlap, 0) << "pose " << i << ", " << inside << " vertices inside";
      ++deep;
    } else {
      EXPECT_LT(overlap, 4e-3) << "pose " << i;  // a corner between the vertices that were asked for
      clear += overlap == 0;
    }
  }
  fmt::print("{} poses overlap, {} are clear\n", deep, clear);
  EXPECT_GT(deep, 15);
  EXPECT_GT(clear, 5);
}

TEST(SwallowedKnee, OpenCartilageSheetsAreNeverFreeBehindEachOther) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart-medium.stl");
  const std::string text = test::lenhart_scene("-medium", 0, 10, 1);
  Knee knee(text);
  // The same pair named the other way round.
  Knee turned(
      test::replaced(text, "[\"femur_cartilage\", \"tibia_cartilage\"]", "[\"tibia_cartilage\", \"femur_cartilage\"]"));
  ASSERT_TRUE(knee.prepared && turned.prepared);
  for (double up = 2e-3; up < 50e-3; up += 2e-3)
    for (const double tilt : {-0.2, 0.0, 0.2}) {
      const Pose X{exp_rotation({tilt, 0, 0}), {0, up, 0}};
      EXPECT_GT(knee.overlap(X), 0) << up << " m up, " << tilt << " rad";
      EXPECT_GT(turned.overlap(X), 0) << up << " m up, " << tilt << " rad, named the other way";
    }
  for (double down = 10e-3; down < 60e-3; down += 5e-3) {
    EXPECT_EQ(knee.overlap({Mat3::Identity(), {0, -down, 0}}), 0) << down << " m apart";
    EXPECT_EQ(turned.overlap({Mat3::Identity(), {0, -down, 0}}), 0) << down << " m apart, named the other way";
  }
}

/// A femoral sheet and a ball, named in either order.
std::string ball_and_sheet(const std::string& ball, bool sheet_first) {
  return "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[body.bone]\nfixed = true\n[body.ball]\n"
         "[joint.j]\ntype = \"free\"\nparent = \"bone\"\nchild = \"ball\"\nrotations = [\"a x\", \"b y\", \"c z\"]\n"
         "translations = [\"x\", \"y\", \"z\"]\n[surface.sheet]\nbody = \"bone\"\nshape = \"mesh\"\nfile = \"" +
         test::data_path("lenhart2015/ACLC01-R-femur-cart-coarse.stl") +
         "\"\nunits = \"m\"\n[surface.ball]\nbody = \"ball\"\n" + ball +
         "[contact.c]\nsurfaces = " + (sheet_first ? "[\"sheet\", \"ball\"]" : "[\"ball\", \"sheet\"]") +
         "\nmodel = \"rigid\"\n[ligament.s]\nfrom = { body = \"bone\", point = [0, 0, 0] }\n"
         "to = { body = \"ball\", point = [0, 0, 0] }\nlaw = \"spring\"\nstiffness = 5\nslack_length = 0\n"
         "[[step]]\nincrements = 1\n";
}

TEST(SwallowedKnee, ABallBehindAnOpenSheetIsNeverFree) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart-coarse.stl");
  constexpr double kRadius = 5e-3;
  const test::TemporaryFolder folder;
  EXPECT_EQ(write_stl(make_sphere({}, kRadius, false)->triangles(1e-3, Vec3::Zero(), 1), folder / "ball.stl", 1, ""),
            "");
  const std::string balls[] = {"shape = \"sphere\"\nradius = 5\n",
                               "shape = \"mesh\"\nfile = \"" + (folder / "ball.stl") + "\"\nunits = \"m\"\n"};
  for (const std::string& ball : balls)
    for (const bool sheet_first : {true, false}) {
      Knee knee(ball_and_sheet(ball, sheet_first));
      ASSERT_TRUE(knee.prepared);
      const Mesh sheet = knee.prepared->surfaces[0]->triangles(0, Vec3::Zero(), 0);
      const std::vector<Vec3> normals = vertex_normals(sheet);
      const auto at = [&](std::size_t v, double behind) {
        State state = knee.start;
        state.poses[1] = {Mat3::Identity(), sheet.vertices[v] - behind * normals[v]};
        return knee.field->overlap(state, 0);
      };
      for (std::size_t v = 0; v < sheet.vertices.size(); v += 97) {
        for (const double depth : {1e-3, 4e-3, 8e-3, 12e-3})
          EXPECT_GT(at(v, depth), 0) << ball << " vertex " << v << ", " << depth << " m behind, " << sheet_first;
        EXPECT_EQ(at(v, -0.2), 0) << ball << " vertex " << v;
      }
    }
}

TEST(SwallowedKnee, ARunThatStartsSoIsRefused) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart-medium.stl");
  const test::TemporaryFolder folder;
  std::string text = test::lenhart_scene("-medium", 0, 10, 1);
  for (const char* start : {"start = { y = 20 }", "start = { y = 35, x = 5 }", "start = { y = 25, adduction = 12 }"}) {
    const std::string with = test::replaced(text, "translations = [\"x\", \"y\", \"z\"]",
                                            std::string("translations = [\"x\", \"y\", \"z\"]\n") + start);
    Diagnostics out;
    EXPECT_EQ(run_scene(folder.write("scene.toml", with), folder / "out", {}, out, nullptr), kExitRefused) << start;
    EXPECT_NE(test::messages(out).find("surfaces overlap by"), std::string::npos) << test::messages(out);
  }
}

}  // namespace
}  // namespace genu
