// The side of knees of a statistical shape model, and of what lies beyond its range.
#include "genu/new_scene/new_side.h"

#include <utility>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_reader.h"
#include "genu/study/layout_doubts.h"
#include "support/data.h"
#include "support/ply_vertices.h"
#include "support/text.h"

namespace genu {
namespace {

/// mean + a (S001 - mean) + b (S002 - mean) as a left knee, tilted in its file. m
NewBone blended(const std::string& part, double a, double b) {
  const std::string shifted = part == "Tibia" ? "_shifted" : "";
  const auto points = [&](const std::string& name, const std::string& end) {
    return test::ply_vertices(test::data_path("ssm/" + name + "_" + part + end + ".ply"));
  };
  const std::vector<Vec3> mean = points("mean", shifted), first = points("S001", ""), second = points("S002", "");
  Diagnostics out;
  auto mesh = read_mesh(test::data_path("ssm/mean_" + part + shifted + ".ply"), 1e-3, out);
  EXPECT_TRUE(mesh && mesh->vertices.size() == mean.size());
  const Mat3 tilt = Eigen::AngleAxisd(0.17, Vec3(1, 2, 2) / 3).toRotationMatrix();
  NewBone bone;
  bone.mesh = std::move(*mesh);
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const Vec3 x = mean[i] + a * (first[i] - mean[i]) + b * (second[i] - mean[i]);
    bone.mesh.vertices[i] = tilt * Vec3(-x.x(), x.y(), x.z());
  }
  for (auto& t : bone.mesh.triangles) std::swap(t[1], t[2]);
  return bone;
}

TEST(NewSide, OfUnclearShapesIsWhatTheReferenceKneeFits) {
  GENU_NEEDS_DATA("ssm/S001_Femur.ply");
  for (const auto& [a, b] : {std::pair(0.0, 0.0), std::pair(1.15, 1.12)}) {
    NewBones bones;
    bones.femur = blended("Femur", a, b);
    bones.tibia = blended("Tibia", a, b);
    const auto knee = lay_out_knee(bones.femur.mesh, bones.tibia.mesh);
    ASSERT_TRUE(knee);
    const Side side = side_of({}, *knee, bones, {});
    EXPECT_TRUE(side.left) << side.why;
    NewScene asked;
    asked.left = false;
    EXPECT_FALSE(side_of(asked, *knee, bones, {}).left);
    EXPECT_TRUE(test::contains(side.why, "fits better")) << side.why;
  }
}

}  // namespace
}  // namespace genu
