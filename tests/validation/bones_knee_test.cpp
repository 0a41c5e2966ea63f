// The knee of meshes/leskovar2019 with bones: made from shapes, and of the statistical shape model.
#include <cmath>

#include <fmt/format.h>

#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/solid_inertia.h"
#include "genu/mesh_files/mesh_reader.h"
#include "motion_scene.h"
#include "support/data.h"
#include "support/judged.h"
#include "support/leskovar.h"

namespace genu {
namespace {

using test::with_first;

Mesh bone_mesh(const std::string& file) {
  Diagnostics out;
  auto mesh = read_mesh(file, 1e-3, out);
  EXPECT_TRUE(mesh) << file;
  return mesh.value_or(Mesh{});
}

/// The scene on bones, for `seconds`, with the inertias of other meshes where they are named.
Solution run_bones(const test::TemporaryFolder& folder, const std::string& seconds, const std::string& tibia,
                   const std::string& patella, std::vector<RunSummary::BodyFacts>& bodies) {
  std::string text = test::read_file(test::kLeskovar + "scene-bones.toml");
  text = with_first(text, "duration = 17", "duration = " + seconds);
  text = with_first(text, "file = \"tibia.stl\"", tibia);
  text = with_first(text, "file = \"patella.stl\", origin = [0.003, 0.0088, 0]", patella);
  Diagnostics out;
  auto p = prepare(folder.write("scene.toml", text), out);
  EXPECT_TRUE(p);
  for (const Diagnostic& d : out.items()) std::printf("%s\n", to_string(d).c_str());
  if (!p) return {};
  bodies = p->bodies;
  return test::judged(*p, solve_motion(*p, {}));
}

std::string in_place(const std::string& file) { return "file = \"" + file + "\""; }

TEST(BonesKnee, HasMassesOfBones) {
  const test::TemporaryFolder folder;
  std::vector<RunSummary::BodyFacts> bodies;
  const Solution s = run_bones(folder, "0.5", in_place(test::kLeskovar + "tibia.stl"),
                               in_place(test::kLeskovar + "patella.stl") + ", origin = [0.003, 0.0088, 0]", bodies);
  EXPECT_EQ(s.summary.exit_code, kExitOk);
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_NEAR(bodies[0].mass, 1200 * solid_inertia(bone_mesh(test::kLeskovar + "tibia.stl")).volume, 1e-12);
  EXPECT_GT(bodies[0].mass, 0.1);
  EXPECT_LT(bodies[0].mass, 0.25);
  EXPECT_GT(bodies[1].mass, 0.015);
  EXPECT_LT(bodies[1].mass, 0.03);
  // Where the scene without bones has the patella's mass, to some millimetres; j2 is (3, 8.8) mm behind and below
  // there.
  EXPECT_LT((bodies[1].centre_of_mass - Vec3(0.045, -0.0032, 0)).norm(), 5e-3);
}

/// As in the paper: j2 at the femur's centre of mass, j1 where the last third of the condyles begins.
TEST(BonesKnee, HasItsHingesWhereThePaperHasThem) {
  Diagnostics out;
  const auto scene = read_scene(test::kLeskovar + "scene-bones.toml", out);
  ASSERT_TRUE(scene);
  const Mesh femur = bone_mesh(test::kLeskovar + "femur.stl");
  Vec3 centroid = solid_inertia(femur).centroid;
  centroid.z() = 0;  // the hinges turn about z
  const auto hinge = [&](std::size_t joint) {
    const auto& place = scene->joints[joint].reference;
    return Vec3(place[3], place[4], place[5]);
  };
  EXPECT_LT((hinge(1) - centroid).norm(), 1e-4);
  const BoundingBox box = bounding_box(femur);
  EXPECT_NEAR((hinge(0).x() - box.low.x()) / (box.high.x() - box.low.x()), 1.0 / 3, 0.01);
}

/// The tendon ends on the bones: its ends are near their surfaces.
TEST(BonesKnee, CarriesItsTendon) {
  const auto nearest = [](const Mesh& mesh, const Vec3& p) {
    double least = 1;
    for (const Vec3& v : mesh.vertices) least = std::min(least, (v - p).norm());
    return least;
  };
  EXPECT_LT(nearest(bone_mesh(test::kLeskovar + "tibia.stl"), {0.03, -0.065, 0}), 3e-3);
  EXPECT_LT(nearest(bone_mesh(test::kLeskovar + "patella.stl"), {0.04, -0.03, 0}), 3e-3);
  const BoundingBox femur = bounding_box(bone_mesh(test::kLeskovar + "femur.stl"));
  EXPECT_NEAR(femur.low.y(), -0.022, 2e-3) << "condyles about j1";
  EXPECT_LT(femur.low.y(), bounding_box(bone_mesh(test::kLeskovar + "tibia.stl")).high.y())
      << "the eminence in the notch";
}

/// Light bones follow the slow torque as if there were none: the angles are those of equilibrium.
TEST(BonesKnee, FollowsItsTorqueNearlyInEquilibrium) {
  const test::TemporaryFolder folder;
  std::vector<RunSummary::BodyFacts> bodies;
  const Solution s = run_bones(folder, "3.5", in_place(test::kLeskovar + "tibia.stl"),
                               in_place(test::kLeskovar + "patella.stl") + ", origin = [0.003, 0.0088, 0]", bodies);
  ASSERT_EQ(s.poses.rows(), 351u);
  EXPECT_LT(s.summary.motion->worst_energy, 1e-8 * s.summary.motion->energy_scale);
  // Virtual work at the peak of the torque, where everything nearly stands: 28.8 = k1 q1 + k2 q2 dq2/dq1.
  const auto angle = [&](std::size_t row, const char* name) { return s.poses.number(row, name); };
  const double q1 = angle(300, "j1.angle_deg"), q2 = angle(300, "j2.angle_deg");
  const double slope = (angle(280, "j2.angle_deg") - q2) / (angle(280, "j1.angle_deg") - q1);
  EXPECT_NEAR(0.5535 * q1 + 0.033 * q2 * slope, 28.8, 0.01 * 28.8);
}

TEST(BonesKnee, RunsOnBonesOfTheShapeModel) {
  GENU_NEEDS_DATA("ssm/S001_Tibia.ply");
  const test::TemporaryFolder folder;
  // Its axes are z, x, y of the scene. The tibia is hung below j1 as the drawn one is, the patella where that one is.
  const auto turned = [](Mesh mesh) {
    for (Vec3& v : mesh.vertices) v = Vec3(v.y(), v.z(), v.x());
    return mesh;
  };
  const Mesh tibia = turned(bone_mesh(test::data_path("ssm/S001_Tibia.ply")));
  const Mesh patella = turned(bone_mesh(test::data_path("ssm/S001_Patella.ply")));
  const BoundingBox box = bounding_box(tibia);
  const Vec3 top = {0.5 * (box.low.x() + box.high.x()), box.high.y(), 0.5 * (box.low.z() + box.high.z())};
  const auto solid = [](const std::string& file, const Vec3& origin) {
    return fmt::format("file = \"{}\", origin = [{}, {}, {}], x_axis = [0, 0, 1], z_axis = [0, 1, 0]",
                       test::data_path("ssm/" + file), origin.x(), origin.y(), origin.z());
  };
  std::vector<RunSummary::BodyFacts> bodies, drawn;
  const Vec3 hung = Vec3(0, -0.021, 0) - top, centre = Vec3(0.046, -0.0012, 0) - solid_inertia(patella).centroid;
  const Solution s = run_bones(folder, "3.5", solid("S001_Tibia.ply", hung), solid("S001_Patella.ply", centre), bodies);
  ASSERT_EQ(s.poses.rows(), 351u);
  ASSERT_EQ(bodies.size(), 2u);
  for (const auto& b : bodies) std::printf("S001 %s\n", to_text(b).c_str());
  EXPECT_NEAR(bodies[0].mass, 1200 * std::abs(solid_inertia(tibia).volume), 1e-9);
  EXPECT_GT(bodies[0].mass, 0.05);
  EXPECT_LT(bodies[0].mass, 0.5);
  EXPECT_GT(bodies[1].mass, 0.01);
  EXPECT_LT(bodies[1].mass, 0.04);
  EXPECT_LT((bodies[1].centre_of_mass - Vec3(0.046, -0.0012, 0)).norm(), 1e-9);
  EXPECT_LT(s.summary.motion->worst_energy, 1e-8 * s.summary.motion->energy_scale);
  const Solution own = run_bones(folder, "3.5", in_place(test::kLeskovar + "tibia.stl"),
                                 in_place(test::kLeskovar + "patella.stl"), drawn);
  EXPECT_NEAR(s.poses.number(300, "j1.angle_deg"), own.poses.number(300, "j1.angle_deg"), 0.5)
      << "so slow a torque hardly feels which bones they are";
}

}  // namespace
}  // namespace genu
