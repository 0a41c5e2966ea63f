// The knee of Leskovar et al. (2019) in meshes/leskovar2019: closed form, invariances, bounds.
#include <fstream>
#include <sstream>

#include "motion_scene.h"
#include "support/places.h"
#include "support/text.h"

namespace genu {
namespace {

using test::motion_of;
using test::motion_scene;
using test::with_first;

std::string leskovar_text() {
  std::ifstream file(genu::test::source_folder() + "/meshes/leskovar2019/scene.toml");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string without_tendon() {
  std::string text = leskovar_text();
  const std::size_t from = text.find("[ligament."), to = text.find("[load.drive]");
  return text.erase(from, to - from);
}

/// The tibia about j1 alone: I q'' + c q' + k q = A sin(w (t - 1)) for t > 1, in deg and N m.
double closed_form(double t) {
  const double I = (0.0536 + 3.49 * 0.178 * 0.178) * test::kPerDegree, c = 0.001, k = 0.5535, A = 28.8;
  const double w = 2 * std::numbers::pi * 0.125, s = t - 1;
  if (s <= 0) return 0;
  const double stiff = k - I * w * w, det = stiff * stiff + c * c * w * w;
  const double sine = A * stiff / det, cosine = -A * c * w / det;
  const double delta = c / (2 * I), omega = std::sqrt(k / I - delta * delta);
  const double a = -cosine, b = (-sine * w + delta * a) / omega;
  return sine * std::sin(w * s) + cosine * std::cos(w * s) +
         std::exp(-delta * s) * (a * std::cos(omega * s) + b * std::sin(omega * s));
}

TEST(MotionKnee, WithoutItsTendonIsADrivenOscillator) {
  const Solution s = motion_of(with_first(without_tendon(), "tolerance = 1e-9", "tolerance = 1e-11"));
  ASSERT_EQ(s.poses.rows(), 1701u);
  double worst = 0, most = 0;
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    const double angle = s.poses.number(row, "j1.angle_deg");
    worst = std::max(worst, std::abs(angle - closed_form(s.poses.number(row, "time_s"))));
    most = std::max(most, std::abs(angle));
    EXPECT_EQ(s.poses.number(row, "j2.angle_deg"), 0) << "nothing drives the patella";
  }
  EXPECT_GT(most, 50) << "deg: a large motion";
  EXPECT_LT(worst, 1e-8) << "deg";
}

TEST(MotionKnee, StaysWithinItsTolerance) {
  const std::string text = with_first(leskovar_text(), "duration = 17", "duration = 5");
  const Solution fine = motion_of(with_first(text, "tolerance = 1e-9", "tolerance = 1e-11"));
  double last = 1;
  for (const char* tolerance : {"1e-5", "1e-7", "1e-9"}) {
    const Solution s = motion_of(with_first(text, "tolerance = 1e-9", std::string("tolerance = ") + tolerance));
    ASSERT_EQ(s.poses.rows(), fine.poses.rows());
    double worst = 0;
    for (std::size_t row = 0; row < s.poses.rows(); ++row)
      for (const char* angle : {"j1.angle_deg", "j2.angle_deg"})
        worst = std::max(worst, std::abs(s.poses.number(row, angle) - fine.poses.number(row, angle)));
    EXPECT_LT(worst * test::kPerDegree, 10 * std::stod(tolerance)) << "rad, at " << tolerance;
    EXPECT_LT(worst, last) << "at " << tolerance;
    last = worst;
  }
}

TEST(MotionKnee, KeepsItsEnergy) {
  const Solution s = motion_of(leskovar_text());
  EXPECT_LT(s.summary.motion->worst_energy, 1e-8 * s.summary.motion->energy_scale);
  EXPECT_LT(s.summary.motion->steps, 50'000);
  // The tendon is as stretched as its ends say, and pulls accordingly.
  for (std::size_t row = 0; row < s.poses.rows(); row += 100) {
    const double stretch =
        (s.poses.number(row, "patellar_tendon.length_mm") - s.poses.number(0, "patellar_tendon.length_mm")) * 1e-3;
    const double rate = s.poses.number(row, "patellar_tendon.velocity_mm_s") * 1e-3;
    EXPECT_NEAR(s.poses.number(row, "patellar_tendon.force_N"), 1e5 * stretch + 50 * rate, 1e-8);
  }
}

/// The scene turned and moved as a whole: what is fixed in the world and the axes of every body.
Scene moved(Scene scene, const Mat3& R, const Vec3& shift) {
  const auto turn = [&](Vec3& v) { v = R * v; };
  for (BodyDef& b : scene.bodies) {
    turn(b.centre_of_mass);
    b.inertia = R * b.inertia * R.transpose();
  }
  for (JointDef& j : scene.joints) {
    for (auto& rotation : j.rotations) turn(rotation.axis);
    Vec3 origin(j.reference[3], j.reference[4], j.reference[5]);
    turn(origin);
    if (scene.bodies[static_cast<std::size_t>(j.parent)].fixed) origin += shift;
    for (std::size_t i = 0; i < 3; ++i) j.reference[3 + i] = origin[static_cast<Eigen::Index>(i)];
  }
  for (LigamentDef& l : scene.ligaments)
    for (LigamentDef::End* end : {&l.from, &l.to}) turn(end->point);
  if (scene.gravity) turn(*scene.gravity);
  return scene;
}

double worst_of_angles(const ResultTable& a, const ResultTable& b) {
  double worst = a.rows() == b.rows() ? 0 : INFINITY;
  for (std::size_t row = 0; row < std::min(a.rows(), b.rows()); ++row)
    for (const char* angle : {"j1.angle_deg", "j2.angle_deg"})
      worst = std::max(worst, std::abs(a.number(row, angle) - b.number(row, angle)));
  return worst;
}

std::string short_knee() {
  std::string text = with_first(leskovar_text(), "duration = 17", "duration = 4");
  return text.insert(text.find("[body.femur]"), "gravity = [0, -9.81, 0]\n");
}

TEST(MotionKnee, IsTheSameWhereverItStands) {
  const Scene scene = motion_scene(short_knee());
  const Mat3 R = exp_rotation(Vec3(0.4, -1.1, 0.7));
  EXPECT_LT(worst_of_angles(motion_of(scene).poses, motion_of(moved(scene, R, Vec3(0.2, -0.1, 0.3))).poses), 1e-7)
      << "deg, at a tolerance of 6e-8 deg";
}

/// A contact that is never closed makes it a motion of free bodies with constraints and multipliers, which hinges alone
/// are not integrated as.
TEST(MotionKnee, IsTheSameWithConstraintsInThePlaceOfAngles) {
  const std::string contact = R"([surface.pin]
body = "tibia"
shape = "sphere"
radius = 0.001
[surface.wall]
body = "femur"
shape = "plane"
origin = [0, 0, -1]
[contact.never]
surfaces = ["pin", "wall"]
model = "rigid"
)";
  std::string text = short_knee();
  const Solution angles = motion_of(text);
  const Solution bodies = motion_of(text.insert(text.find("[dynamics]"), contact));
  EXPECT_LT(worst_of_angles(angles.poses, bodies.poses), 1e-7) << "deg, at a tolerance of 6e-8 deg";
  EXPECT_NE(angles.summary.effects.front().unknowns, bodies.summary.effects.front().unknowns);
  for (std::size_t row = 0; row < angles.poses.rows(); ++row)
    for (const char* force : {"j1.reaction.force_y_N", "patellar_tendon.force_N", "energy.balance_J"})
      EXPECT_NEAR(angles.poses.number(row, force), bodies.poses.number(row, force), 1e-6) << row;
}

TEST(MotionKnee, IsTheSameInMillimetresAndRadians) {
  std::string text = short_knee();
  const auto by = [&](const std::string& piece, const std::string& other) { text = with_first(text, piece, other); };
  by("length = \"m\", angle = \"deg\"", "length = \"mm\", angle = \"rad\"");
  by("[0, -0.178, 0]", "[0, -178, 0]");
  by("[0.042, -0.012, 0]", "[42, -12, 0]");
  by("[0.012, 0.03, 0]", "[12, 30, 0]");
  by("[0.03, -0.065, 0]", "[30, -65, 0]");
  by("[0.04, -0.03, 0]", "[40, -30, 0]");
  by("stiffness = 1e5", "stiffness = 100");
  by("damping = 50 ", "damping = 0.05 ");
  by("stiffness = 0.5535 ", fmt::format("stiffness = {:.17g} ", 0.5535 / test::kPerDegree));
  by("stiffness = 0.033", fmt::format("stiffness = {:.17g}", 0.033 / test::kPerDegree));
  for (int k = 0; k < 2; ++k) by("damping = 0.001", fmt::format("damping = {:.17g}", 0.001 / test::kPerDegree));
  EXPECT_LT(worst_of_angles(motion_of(short_knee()).poses, motion_of(text).poses), 1e-7) << "deg";
}

TEST(MotionKnee, AStiffDamperIsNoBurden) {
  // 2e4 N s/m on 60 g: a decay in some microseconds.
  const Solution s = motion_of(
      with_first(with_first(leskovar_text(), "duration = 17", "duration = 3"), "damping = 50 ", "damping = 2e4 "));
  EXPECT_LT(s.summary.motion->steps, 20'000);
  EXPECT_LT(s.summary.motion->worst_energy, 1e-6 * s.summary.motion->energy_scale);
}

/// Held by contact and ligaments in the place of hinges: the leg extends, nothing lets go, and forces balance at the
/// end.
TEST(MotionKnee, ExtendsWithoutItsJoints) {
  std::ifstream file(genu::test::source_folder() + "/meshes/leskovar2019/scene-without-joints.toml");
  std::stringstream text;
  text << file.rdbuf();
  const Solution s = motion_of(text.str());
  const std::size_t last = s.poses.rows() - 1;
  EXPECT_NEAR(s.poses.number(0, "knee.flexion_deg"), 66.5, 0.5);
  EXPECT_LT(s.poses.number(last, "knee.flexion_deg"), 35);
  for (std::size_t row = 0; row <= last; ++row) {
    for (const char* contact : {"medial", "lateral", "patellofemoral"}) {
      EXPECT_GT(s.poses.number(row, fmt::format("{}.force_N", contact)), 50) << row;
      EXPECT_LT(std::abs(s.poses.number(row, fmt::format("{}.gap_mm", contact))), 1e-8) << row;
    }
    EXPECT_GT(s.poses.number(row, "knee.flexion_deg"), 20) << row;
  }
  EXPECT_LT(s.summary.motion->worst_energy, 1e-6 * s.summary.motion->energy_scale);
}

}  // namespace
}  // namespace genu
