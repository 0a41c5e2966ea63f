// Motions whose contacts come and go by themselves: a plank that rocks to rest, and measured cartilage, where noise
// lets contacts be born beside others and take their load.
#include <vector>

#include "motion_scene.h"
#include "support/knee_scene.h"

namespace genu {
namespace {

using test::dynamics;
using test::kG;
using test::kPerDegree;
using test::motion_of;

constexpr double kWheel = 0.1, kWidth = 0.01, kFlattening = 200;  // m, m, 1/m^2
constexpr double kMass = 2, kInertia = 0.05, kHalf = 0.1;         // kg, kg m^2, m: from the middle to each foot

/// A plank on two feet, the one about to rise with `rate` (rad/s).
std::string plank(double rate) {
  std::string text = "format = 1\nunits = { length = \"m\", angle = \"rad\" }\n" +
                     fmt::format("gravity = [0, 0, {}]\n", -kG) +
                     fmt::format(R"([body.ground]
fixed = true
[body.plank]
mass = {0}
inertia = [{1}, {1}, {1}]
[joint.free]
type = "free"
parent = "ground"
child = "plank"
rotations = ["tilt y", "roll x", "yaw z"]
translations = ["x", "y", "z"]
reference = {{ z = 0.02 }}
[surface.floor]
body = "ground"
shape = "plane"
)",
                                 kMass, kInertia);
  for (const char* side : {"left", "right"})
    text += fmt::format(
        "[surface.{0}]\nbody = \"plank\"\nshape = \"sphere\"\nradius = 0.02\norigin = [{1}, 0, 0]\n"
        "[contact.{0}]\nsurfaces = [\"{0}\", \"floor\"]\nmodel = \"rigid\"\n",
        side, side == std::string("left") ? -kHalf : kHalf);
  return text + dynamics(0.1, 0.001, 1e-9, fmt::format("\"free.tilt\" = {}, \"free.z\" = {}", -rate, kHalf * rate)) +
         "prescribe = { \"free.roll\" = 0 }\n";
}

/// Without friction each landing on one foot, the other closed, keeps the angular momentum about the foot that lands:
/// the other rises at (I - m b^2) / (I + m b^2) of the rate, and comes back ever sooner. The times add up.
TEST(MotionManyContacts, APlankRocksToRest) {
  constexpr double kRate = 0.1, kShape = kMass * kHalf * kHalf;
  constexpr double kKept = (kInertia - kShape) / (kInertia + kShape);
  constexpr double kBack = kMass * kG * kHalf / (kInertia + kShape);  // rad/s^2
  const Solution s = motion_of(plank(kRate));
  std::vector<double> landings;
  for (std::size_t row = 0; row < s.event_rows.rows(); ++row)
    if (std::get<std::string>(s.event_rows.at(row, s.event_rows.column_index("event"))) == "contact_gained")
      landings.push_back(s.event_rows.number(row, "time_s"));
  ASSERT_GE(landings.size(), 4u);
  EXPECT_LT(landings.size(), 15u) << "what it rises by below the tolerance is no more counted";
  double time = 0, rate = kRate;
  for (std::size_t k = 0; k < landings.size(); ++k, rate *= kKept) {
    time += 2 * rate / kBack;
    EXPECT_NEAR(landings[k], time, 2e-6 * time) << k;  // the square of its tilt is left out
  }
  const std::size_t last = s.poses.rows() - 1;
  for (const char* foot : {"left.force_N", "right.force_N"})
    EXPECT_NEAR(s.poses.number(last, foot), kMass * kG / 2, 1e-8);
  EXPECT_NEAR(s.poses.number(last, "free.tilt_deg"), 0, 1e-9);
  EXPECT_NEAR(s.poses.number(last, "energy.kinetic_J"), 0, 1e-14);
  EXPECT_NEAR(s.poses.number(last, "energy.dissipated_J"), (kInertia + kShape) * kRate * kRate / 2, 1e-10);
}

/// A stool on feet round a circle: more than three are more than forces can be told for, but stand they must, and what
/// lands in one moment lands at once.
std::string round_stool(int feet, double turned, double height, const std::string& rates) {
  std::vector<Vec3> middles;
  for (int i = 0; i < feet; ++i) {
    const double angle = turned + 2 * M_PI * i / feet;
    middles.emplace_back(0.3 * std::cos(angle), 0.3 * std::sin(angle), -0.3);
  }
  return test::stool({0.01, 0.02, 0.05}, {0.05, 0.06, 0.04}, fmt::format("z = {}", 0.32 + height), middles) +
         dynamics(height > 0 ? 0.35 : 0.02, 0.01, 1e-7, rates);
}

TEST(MotionManyContacts, AStoolStandsOnAnyNumberOfFeet) {
  for (const int feet : {3, 4, 5, 6})
    for (const double turned : {0.0, 0.2, 0.5}) {
      SCOPED_TRACE(fmt::format("{} feet, {} rad", feet, turned));
      const Solution s = motion_of(round_stool(feet, turned, 0, "\"free.c\" = 0.5"));
      double weight = 0;
      for (int i = 0; i < feet; ++i) weight += s.poses.number(1, fmt::format("c{}.force_N", i));
      EXPECT_NEAR(weight, 3 * kG, 1e-3 * kG) << "and what it spins about";
      EXPECT_NEAR(s.poses.number(s.poses.rows() - 1, "free.z_mm"), 320, 1e-9);
    }
}

TEST(MotionManyContacts, AStoolLandsFlat) {
  for (const int feet : {3, 4, 5}) {
    SCOPED_TRACE(feet);
    const Solution s = motion_of(round_stool(feet, 0.1, 0.4, ""));
    const std::size_t last = s.poses.rows() - 1;
    EXPECT_NEAR(s.poses.number(last, "free.z_mm"), 320, 1e-7);
    EXPECT_NEAR(s.poses.number(last, "energy.dissipated_J"), 3 * kG * 0.4, 1e-6);
    EXPECT_LT(s.event_rows.rows(), 20u);
  }
}

/// The height of a surface z = x^2 (x^2 / w^2 - k y) / 2 + y^2 / (2 R), pitched about x, over the plane it rests on:
/// the largest support of its points, by looking at many.
double support(double pitch) {
  double deepest = -1;
  constexpr int kSteps = 4000;
  for (int i = -kSteps; i <= kSteps; ++i) {
    const double x = 0.02 * i / kSteps;
    // For this x the point whose normal is upright, z_y = -tan(pitch).
    const double y = kWheel * (kFlattening * x * x / 2 - std::tan(pitch));
    const double z = x * x * (x * x / (kWidth * kWidth) - kFlattening * y) / 2 + y * y / (2 * kWheel);
    deepest = std::max(deepest, -y * std::sin(pitch) - z * std::cos(pitch));
  }
  return deepest;
}

/// A keel that is round across behind and hollow in front rolls forth: its one contact becomes two.
TEST(MotionManyContacts, AContactSplitsInTwo) {
  const std::string text =
      "format = 1\nunits = { length = \"m\", angle = \"rad\" }\n" + fmt::format("gravity = [0, 0, {}]\n", -kG) +
      fmt::format(R"([body.ground]
fixed = true
[body.keel]
mass = 2
inertia = [0.01, 0.01, 0.01]
[joint.free]
type = "free"
parent = "ground"
child = "keel"
rotations = ["pitch x", "roll y", "yaw z"]
translations = ["x", "y", "z"]
reference = {{ pitch = 0.2, z = {3:.17g} }}
[surface.floor]
body = "ground"
shape = "plane"
[surface.keel]
body = "keel"
shape = "polynomial"
z_axis = [0, 0, -1]
x_axis = [1, 0, 0]
terms = [[4, 0, {0:.17g}], [2, 1, {1:.17g}], [0, 2, {2:.17g}]]
patch = {{ x = [-0.03, 0.03], y = [-0.06, 0.06] }}
[contact.c]
surfaces = ["keel", "floor"]
model = "rigid"
)",
                  -0.5 / (kWidth * kWidth), -0.5 * kFlattening, -0.5 / kWheel, support(0.2)) +
      dynamics(1, 0.02, 1e-5) + "prescribe = { \"free.pitch\" = { step = { from = 0.2, to = -0.3, rise = 1 } } }\n";
  const Solution s = motion_of(text);
  ASSERT_EQ(s.poses.rows(), 51u);
  for (std::size_t row = 0; row < s.poses.rows(); ++row)
    EXPECT_NEAR(s.poses.number(row, "free.z_mm"), 1e3 * support(kPerDegree * s.poses.number(row, "free.pitch_deg")),
                1e-5)
        << row;
  EXPECT_GT(s.poses.number(50, "c.2.force_N"), 1);
}

/// Bent to 90 degrees in a second, on the coarser of the published meshes.
TEST(MotionManyContacts, AMeasuredKneeIsBent) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart-coarse.stl");
  std::string text = test::lenhart_scene("-coarse", 0, 90, 1);
  text = test::replaced(text.substr(0, text.find("[[step]]")), "[body.tibia]\n",
                        "[body.tibia]\nmass = 4\ncentre_of_mass = [0, -180, 0]\ninertia = [0.05, 0.02, 0.05]\n");
  const Solution s = motion_of(text + dynamics(1, 0.02, 1e-4) +
                               "start = \"equilibrium\"\nprescribe = { \"knee.flexion\" = { step = { from = 0, to = "
                               "90, rise = 1 } } }\n");
  ASSERT_EQ(s.poses.rows(), 51u);
  EXPECT_NEAR(s.poses.number(50, "knee.flexion_deg"), 90, 1e-9);
  double least = 1;
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    EXPECT_GE(s.poses.number(row, "tibiofemoral.force_N"), 0);
    least = std::min(least, s.poses.number(row, "tibiofemoral.gap_mm"));
  }
  EXPECT_GT(least, -1e-4) << "mm";
  EXPECT_LT(s.summary.motion->worst_energy, 1e-3 * s.summary.motion->energy_scale);
}

}  // namespace
}  // namespace genu
