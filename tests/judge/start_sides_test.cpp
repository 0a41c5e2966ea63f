// A bowl on a plate, right way round and with both sheets inside out: the pose that is then found lies beyond the
// plate.
#include "genu/judge/start_sides.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corrupted.h"
#include "genu/mesh_files/stl_writer.h"
#include "support/layers.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;

constexpr const char* kRule = "no body passes through another";

/// A bowl of radius 20 mm about the body's origin, over a plate at height 0; `start`: mm, of the bowl's middle over the
/// plate.
std::string bowl_scene(const test::TemporaryFolder& folder, bool inside_out, double start, const std::string& model) {
  Mesh plate = test::sheet(0.03, 20), bowl = test::sheet(0.012, 20);
  for (Vec3& v : bowl.vertices) v.z() = -std::sqrt(0.02 * 0.02 - v.x() * v.x() - v.y() * v.y());
  Mesh& turned = inside_out ? plate : bowl;
  for (auto& t : turned.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(write_stl(bowl, folder / "bowl.stl", 1e-3, ""), "");
  EXPECT_EQ(write_stl(plate, folder / "plate.stl", 1e-3, ""), "");
  std::string text = fmt::format(R"(format = 1
units = {{ length = "mm", angle = "deg" }}
[body.tibia]
fixed = true
[body.femur]
[joint.knee]
type = "free"
parent = "tibia"
child = "femur"
rotations = ["flexion x", "adduction y", "rotation z"]
translations = ["x", "y", "z"]
reference = {{ z = {} }}
[surface.bowl]
body = "femur"
shape = "mesh"
file = "bowl.stl"
units = "mm"
[surface.plate]
body = "tibia"
shape = "mesh"
file = "plate.stl"
units = "mm"
[contact.medial]
surfaces = ["bowl", "plate"]
{}
[load.weight]
body = "femur"
force = [0, 0, -50]
[[step]]
prescribe = {{ "knee.flexion" = [0, 4] }}
increments = 2
)",
                                 20 + start, model);
  for (const auto& [name, x, y] : {std::tuple("front", 0, 1), {"back", 0, -1}, {"left", -1, 0}, {"right", 1, 0}})
    text += fmt::format(R"([ligament.{}]
from = {{ body = "femur", point = [{}, {}, -10] }}
to = {{ body = "tibia", point = [{}, {}, -10] }}
law = "quadratic"
stiffness = 20000
reference_strain = 0.02
)",
                        name, 15 * x, 15 * y, 30 * x, 30 * y);
  return folder.write("scene.toml", text);
}

constexpr const char* kRigid = "model = \"rigid\"";
constexpr const char* kLayer = "model = \"cartilage\"\nmodulus = 5\npoisson = 0.45\nthickness = 3";

TEST(StartSides, AJointThatStaysOnItsSideIsAccepted) {
  for (const char* model : {kRigid, kLayer})
    for (const double start : {0.0, -0.2}) {
      const test::TemporaryFolder folder;
      const auto run = test::Corrupted::of(bowl_scene(folder, false, start, model));
      EXPECT_THAT(run.rejections(), IsEmpty()) << model << start;
      EXPECT_EQ(run.judge().judged, 3u) << model << start;
    }
}

TEST(StartSides, ThroughThePlateIsRejected) {
  for (const double start : {0.0, 3.0}) {
    const test::TemporaryFolder folder;
    auto run = test::Corrupted::of(bowl_scene(folder, true, start, kRigid));
    ASSERT_GT(run.judge().judged, 0u) << start;
    EXPECT_THAT(run.rejections(), Contains(kRule)) << start;
    EXPECT_EQ(run.judge().rejected(), run.judge().judged);
  }
}

}  // namespace
}  // namespace genu
