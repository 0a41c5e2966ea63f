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
                 "a load needs a force, a moment, `toward`, `on` or a path");
  expect_load_refused("force = [0, @nan, 0]\n", "force[2]", "nan", "finite");
  expect_load_refused("force = @100\n", "force", "100", "three numbers [x, y, z], in N");
  expect_load_refused("moment = @[1, 2]\n", "moment", "[1, 2]", "three numbers [x, y, z], in N m");
  expect_load_refused(kForce + "@frme = 1\n", "frme", "1", "did you mean \"frame\"?");
  expect_load_refused("force = [1, 0, 0]\nframe = @\"femur\"\n", "frame", "\"femur\"", "one of \"world\", \"body\"");
  expect_load_refused("force = [1, 0, 0]\npoint = @\"hip\"\n", "point", "\"hip\"", "three numbers");
  expect_load_refused("moment = [1, 0, 0]\npoint = @[1, 0, 0]\n", "point", "[1, 0, 0]", "there is no force");
}

const std::string kLoad = "[load.push]\nbody = \"femur\"\n" + kForce;
const std::string kToward = "[load.push]\nbody = \"femur\"\n";
const std::string kTibia = "toward = { body = \"tibia\", point = [0, 0, -400] }\n";

void expect_toward_refused(const std::string& keys, const std::string& key, const std::string& found,
                           const std::string& rule) {
  expect_refused(kLoad, kToward + keys, "load.push." + key, found, rule);
}

TEST(ReadLoads, TowardAPoint) {
  const LoadDef load = good(edited(kLoad, kToward + "point = [1, 2, 3]\nmagnitude = 800\n" + kTibia)).loads.at(0);
  EXPECT_EQ(load.kind, LoadDef::Kind::toward);
  EXPECT_EQ(load.body, 1);
  EXPECT_EQ(load.toward_body, 0);
  EXPECT_TRUE(load.point.isApprox(Vec3(1e-3, 2e-3, 3e-3), 1e-15));
  EXPECT_TRUE(load.toward_point.isApprox(Vec3(0, 0, -0.4), 1e-15));
  EXPECT_EQ(load.value, 800);
  const LoadDef other = good(edited(kLoad,
                                    "[load.push]\nbody = \"tibia\"\nmagnitude = 0\n"
                                    "toward = { body = \"femur\", point = [0, 0, 9] }\n"))
                            .loads.at(0);
  EXPECT_EQ(other.body, 0) << "it pulls on the moving body all the same";
  EXPECT_EQ(other.point, Vec3::Zero());
}

TEST(ReadLoads, TowardErrors) {
  const std::string newton = "magnitude = 800\n";
  expect_refused(kLoad, "[load.@push]\nbody = \"femur\"\n" + kTibia, "load.push.magnitude", "", "is missing");
  expect_refused(kLoad, "[load.@push]\n" + newton + kTibia, "load.push.body", "", "is missing");
  expect_toward_refused("magnitude = @-1\n" + kTibia, "magnitude", "-1", "must be >= 0 N");
  expect_toward_refused("@magnitude = 1\nmoment = [0, 0, 1]\n", "magnitude", "1", "is no key of a load");
  expect_toward_refused(newton + kTibia + "@frame = \"body\"\n", "frame", "\"body\"",
                        "is no key of a load toward a point");
  expect_toward_refused(newton + kTibia + "@force = [0, 0, 1]\n", "force", "[0, 0, 1]",
                        "is no key of a load toward a point");
  expect_toward_refused(newton + "toward = @\"tibia\"\n", "toward", "\"tibia\"", "must be a table");
  expect_toward_refused(newton + "@toward = { body = \"tibia\" }\n", "toward.point", "", "is missing");
  expect_toward_refused(newton + "toward = { body = @\"tiba\", point = [0, 0, 1] }\n", "toward.body", "\"tiba\"",
                        "did you mean \"tibia\"?");
  expect_toward_refused(newton + "toward = { body = @\"femur\", point = [0, 0, 1] }\n", "toward.body", "\"femur\"",
                        "both points are on the same body");
  expect_one_error(edited("[body.femur]", "[body.floor_2]\nfixed = true\n[body.femur]",
                          edited(kLoad, "[load.push]\nbody = \"tibia\"\n" + newton +
                                            "toward = { body = @\"floor_2\", point = [0, 0, 1] }\n")),
                   "load.push.toward.body", "\"floor_2\"", "both points are on fixed bodies");
}

TEST(ReadLoads, OnACoordinate) {
  const LoadDef moment = good(edited(kLoad, "[load.push]\non = \"knee.rotation\"\nvalue = -3\n")).loads.at(0);
  EXPECT_EQ(moment.kind, LoadDef::Kind::coordinate);
  EXPECT_EQ(moment.coordinate, (CoordinateRef{0, 2}));
  EXPECT_EQ(moment.value, -3) << "N m whatever the units";
  EXPECT_EQ(good(edited(kLoad, "[load.push]\non = \"knee.z\"\n")).loads.at(0).value, 1) << "N";
  const auto refused = [](const std::string& keys, const std::string& key, const std::string& found,
                          const std::string& rule) {
    expect_refused(kLoad, "[load.push]\n" + keys, "load.push." + key, found, rule);
  };
  refused("on = @\"knee.flexon\"\n", "on", "\"knee.flexon\"", "did you mean \"knee.flexion\"?");
  refused("on = @3\n", "on", "3", "must be a string");
  refused("on = \"knee.x\"\nvalue = @\"3 N\"\n", "value", "\"3 N\"", "must be a number, in N");
  refused("on = \"knee.x\"\n@body = \"femur\"\n", "body", "\"femur\"", "is no key of a load on a joint coordinate");
  refused("on = \"knee.x\"\n@magnitude = 3\n", "magnitude", "3", "is no key of a load on a joint coordinate");
}

}  // namespace
}  // namespace genu::scene_test
