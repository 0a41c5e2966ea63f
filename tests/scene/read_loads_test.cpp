#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

const std::string kForce = "force = [0, 100, 0]\npoint = [1, 0, 0]\nframe = \"body\"\n";

void expect_load_refused(const std::string& keys, const std::string& key, const std::string& found,
                         const std::string& rule) {
  expect_refused(kForce, keys, "load.push." + key, found, rule);
}

TEST(ReadLoads, Values) {
  const LoadDef load = good(kGoodScene).loads.at(0);
  EXPECT_EQ(load.name, "push");
  EXPECT_EQ(load.body, 1);
  EXPECT_EQ(load.force, Vec3(0, 100, 0));
  EXPECT_EQ(load.moment, Vec3::Zero());
  EXPECT_TRUE(load.point.isApprox(Vec3(1e-3, 0, 0), 1e-15));
  EXPECT_EQ(load.frame, LoadDef::Frame::body);
  const LoadDef moment = good(edited(kForce, "moment = [0, 0, 1.5]\n")).loads.at(0);
  EXPECT_EQ(moment.moment, Vec3(0, 0, 1.5)) << "N m whatever the unit of length";
  EXPECT_EQ(moment.frame, LoadDef::Frame::world);
}

TEST(ReadLoads, Errors) {
  expect_refused("[load.push]\nbody = \"femur\"", "[load.push]\nbody = @\"fmur\"", "load.push.body", "\"fmur\"",
                 "did you mean \"femur\"?");
  expect_refused("[load.push]\nbody = \"femur\"", "[load.push]\nbody = @\"tibia\"", "load.push.body", "\"tibia\"",
                 "is fixed");
  expect_refused("[load.push]\nbody = \"femur\"", "[load.@push]", "load.push.body", "", "is missing");
  expect_refused("[load.push]\nbody = \"femur\"\n" + kForce, "[load.@push]\nbody = \"femur\"\n", "load.push.force", "",
                 "a load needs a force, a moment or both");
  expect_load_refused("force = [0, @nan, 0]\n", "force[2]", "nan", "finite");
  expect_load_refused("force = @100\n", "force", "100", "three numbers [x, y, z], in N");
  expect_load_refused("moment = @[1, 2]\n", "moment", "[1, 2]", "three numbers [x, y, z], in N m");
  expect_load_refused(kForce + "@frme = 1\n", "frme", "1", "did you mean \"frame\"?");
  expect_load_refused("force = [1, 0, 0]\nframe = @\"femur\"\n", "frame", "\"femur\"", "one of \"world\", \"body\"");
  expect_load_refused("force = [1, 0, 0]\npoint = @\"hip\"\n", "point", "\"hip\"", "three numbers");
  expect_load_refused("moment = [1, 0, 0]\npoint = @[1, 0, 0]\n", "point", "[1, 0, 0]", "there is no force");
}

TEST(ReadLoads, NotBuiltYet) {
  for (const std::string key : {"toward", "magnitude", "on", "value", "scale"}) {
    expect_load_refused(kForce + "@" + key + " = 1\n", key, "1", "not built yet");
  }
  // A load of a kind that is not built yet is not blamed for lacking the keys of the kind that is.
  expect_refused("[load.push]\nbody = \"femur\"\n" + kForce, "[load.push]\n@on = \"knee.flexion\"\n", "load.push.on",
                 "\"knee.flexion\"", "not built yet");
}

}  // namespace
}  // namespace genu::scene_test
