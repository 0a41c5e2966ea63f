#include "scene/scene_text.h"

#include <cmath>
#include <numbers>

#include "genu/scene/read_parts.h"

namespace genu::scene_test {
namespace {

std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& coordinates =
                      "rotations = [\"a x\", \"b y\", \"c z\"]\n"
                      "translations = [\"u\", \"v\", \"w\"]\n") {
  return "[joint." + name + "]\ntype = \"free\"\nparent = \"" + parent + "\"\nchild = \"" + child + "\"\n" +
         coordinates;
}

TEST(CheckScene, MovingBodyWithoutJoint) {
  expect_one_error(kGoodScene + "[body.@patella]\n", "body.patella", "", "must be the child of one joint");
}

TEST(CheckScene, CircleOfParents) {
  expect_one_error(kGoodScene + "[body.a]\n[body.b]\n[body.c]\n" + joint("@ab", "a", "b") + joint("bc", "b", "c") +
                       joint("ca", "c", "a"),
                   "joint.ab", "", "parents go round in a circle");
}

TEST(CheckScene, ReferencePosesFollowTheChainOfJoints) {
  const Scene scene = good(kGoodScene + "[body.patella]\n" +
                           joint("pf", "femur", "patella",
                                 "rotations = [\"a x\", \"b y\", \"c z\"]\ntranslations = [\"u\", \"v\", \"w\"]\n"
                                 "reference = { a = 90, b = 90, u = 10 }\n"));
  const std::vector<Pose> poses = reference_poses(scene);
  EXPECT_EQ(poses[0].R, Mat3::Identity());
  const double s = std::sin(std::numbers::pi / 6), c = std::cos(std::numbers::pi / 6);
  Mat3 flexed;  // 30 deg about -z
  flexed << c, s, 0, -s, c, 0, 0, 0, 1;
  EXPECT_LT((poses[1].R - flexed).norm(), 1e-15);
  EXPECT_EQ(poses[1].p, Vec3(0, 2.5e-3, 0));
  // Rx(90) Ry(90): x -> y, as Ry sends x to -z and Rx sends -z to y.
  EXPECT_LT((poses[2].R.col(0) - flexed.col(1)).norm(), 1e-15);
  EXPECT_LT((poses[2].p - (flexed * Vec3(0.01, 0, 0) + Vec3(0, 2.5e-3, 0))).norm(), 1e-17);
}

const std::string kLigament =
    "[ligament.AAC]\n"
    R"(from = { body = "femur", point = [12.25, -7.84, 0.0] })"
    "\n"
    R"(to = { body = "tibia", point = [-6.04, 4.0, -3.0] })";
// At the reference the femur's origin is at y = 2.5 mm of the tibia.
const std::string kCoincident = R"(from = { body = "femur", point = [0, 0, 5] }
to = { body = "tibia", point = [0, 2.5, 5] })";

TEST(CheckScene, CoincidentEnds) {
  expect_refused(kLigament, "[ligament.@AAC]\n" + kCoincident, "ligament.AAC", "",
                 "the two ends coincide at the reference pose");
  const std::string law = "\nlaw = \"quadratic\"\nstiffness = 37200.0\nreference_strain = -0.0175";
  good(edited(kLigament + law,
              "[ligament.AAC]\n" + kCoincident + "\nlaw = \"spring\"\nstiffness = 1\nslack_length = 0"));
}

TEST(CheckScene, CoincidentPointsOfALoad) {
  const std::string load = "body = \"femur\"\nforce = [0, 100, 0]\npoint = [1, 0, 0]\nframe = \"body\"\n";
  // The reference turns the femur by 30 deg about -z and lifts it by 2.5 mm; the knee's z axis stays.
  const auto toward = [&](const std::string& z) {
    return edited("[load.push]\n" + load, "[load.@push]\nbody = \"femur\"\npoint = [0, 0, 7]\nmagnitude = 1\n" +
                                              ("toward = { body = \"tibia\", point = [0, 2.5, " + z + "] }\n"));
  };
  expect_one_error(toward("7"), "load.push", "", "its two points coincide at the reference pose");
  good(unmarked(toward("7.001")).text);
}

TEST(CheckScene, SpringOfNegativeLength) {
  const std::string law = "\nlaw = \"quadratic\"\nstiffness = 37200.0\nreference_strain = -0.0175";
  const std::string spring = "\nlaw = \"spring\"\nstiffness = 10\nreference_force = ";
  // 10 N/mm and 5 N: half a millimetre longer than at rest, on a spring of zero length.
  expect_refused(kLigament + law, "[ligament.@AAC]\n" + kCoincident + spring + "5", "ligament.AAC", "",
                 "asks for a slack length of -0.5 mm");
  good(edited(kLigament + law, "[ligament.AAC]\n" + kCoincident + spring + "-5"));
}

TEST(CheckScene, ResultColumnsAreDistinct) {
  expect_refused("[ligament.AAC]", "[ligament.@medial]", "ligament.medial", "",
                 "its result column medial.force_N is also one of contact.medial");
}

TEST(CheckScene, ColumnsOfRegionsAndCoordinates) {
  expect_refused("[contact.medial]\nsurfaces = [\"ball\", \"floor\"]\nmodel = \"rigid\"\nregions = { inner",
                 "[contact.@medial]\nsurfaces = [\"ball\", \"floor\"]\nmodel = \"rigid\"\nregions = { ball",
                 "contact.medial", "", "its result column medial.ball.x_mm is also one of contact.medial");
  expect_one_error(edited("[contact.medial]", "[contact.@knee]", edited("\"z\"]", "\"gap\"]")), "contact.knee", "",
                   "its result column knee.gap_mm is also one of joint.knee");
  // The same name is no harm where no column is the same.
  good(edited("[contact.medial]", "[contact.knee]"));
  good(edited("[load.push]", "[load.AAC]", edited("load = { push", "load = { AAC")));
}

}  // namespace
}  // namespace genu::scene_test
