// Every pair of M prescribed coordinates and N contacts with M + N <= 5: a body on five balls, three on a floor and two
// at a wall, held by springs. Balance is checked coordinate by coordinate with forces summed here.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/scenes.h"

namespace genu {
namespace {

constexpr double kFootRadius = 5;  // mm
const std::array<Vec3, 5> kFeet = {Vec3(30, 0, 0), Vec3(-20, 25, 0), Vec3(-20, -25, 0), Vec3(25, -35, 15),
                                   Vec3(-25, -35, 12)};
struct Spring {
  Vec3 body, ground;
  double stiffness, slack;  // N/mm, mm
};
const std::array<Spring, 7> kSprings = {
    Spring{{30, 20, 10}, {60, 40, -30}, 4, 40},     Spring{{-30, 20, 10}, {-70, 30, -20}, 5, 45},
    Spring{{-30, -20, 10}, {-60, -60, -35}, 3, 55}, Spring{{30, -20, 10}, {50, -70, -25}, 4, 50},
    Spring{{0, 0, 20}, {10, -60, 20}, 6, 40},       Spring{{0, 30, 0}, {40, 30, 10}, 2, 30},
    Spring{{0, 0, 0}, {5, 10, -80}, 3, 70}};
const Vec3 kPressForce(4, -30, -60), kPoint(3, -5, 12);
/// What is prescribed first, second, ..., so that it is free of what the feet hold.
const std::array<const char*, 5> kPrescribed = {"\"j.x\" = [0, 3]", "\"j.c\" = [0, 2]", "\"j.y\" = [0, 1]",
                                                "\"j.a\" = [0, 1]", "\"j.b\" = [0, -1]"};
const std::array<int, 5> kIndex = {3, 2, 4, 0, 1};

std::string point(const Vec3& p) { return fmt::format("[{}, {}, {}]", p.x(), p.y(), p.z()); }

std::string prescribe(int m) {
  std::string out = "prescribe = {";
  for (int i = 0; i < m; ++i) out += (i == 0 ? " " : ", ") + std::string(kPrescribed[static_cast<std::size_t>(i)]);
  return out + " }\n";
}

std::string scene(int contacts, const std::string& steps) {
  std::string text = R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.bone]
[joint.j]
type = "free"
parent = "ground"
child = "bone"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
reference = { z = 5.2, y = 0.2 }
[surface.floor]
body = "ground"
shape = "plane"
[surface.wall]
body = "ground"
shape = "plane"
origin = [0, -40, 0]
z_axis = [0, 1, 0]
x_axis = [1, 0, 0]
)";
  for (int i = 0; i < contacts; ++i)
    text += fmt::format(
        "[surface.ball{0}]\nbody = \"bone\"\nshape = \"sphere\"\nradius = {1}\norigin = {2}\n"
        "[contact.foot{0}]\nsurfaces = [\"ball{0}\", \"{3}\"]\nmodel = \"rigid\"\n",
        i, kFootRadius, point(kFeet[static_cast<std::size_t>(i)]), i < 3 ? "floor" : "wall");
  for (std::size_t i = 0; i < kSprings.size(); ++i)
    text += fmt::format(
        "[ligament.s{}]\nfrom = {{ body = \"bone\", point = {} }}\nto = {{ body = \"ground\", point = {} }}\n"
        "law = \"spring\"\nstiffness = {}\nslack_length = {}\n",
        i, point(kSprings[i].body), point(kSprings[i].ground), kSprings[i].stiffness, kSprings[i].slack);
  text += fmt::format("[load.press]\nbody = \"bone\"\nforce = {}\npoint = {}\n", point(kPressForce), point(kPoint));
  return text + steps;
}

/// Generalised forces on the six coordinates: springs, load and contacts; N and N m.
std::array<double, 6> generalised_forces(const State& state) {
  const Pose& X = state.poses[1];
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  const auto add = [&](const Vec3& f, const Vec3& at) {
    force += f;
    moment += (at - X.p).cross(f);
  };
  for (const Spring& s : kSprings) {
    const Vec3 at = X.p + X.R * (1e-3 * s.body), arm = 1e-3 * s.ground - at;
    add(1e3 * s.stiffness * (arm.norm() - 1e-3 * s.slack) * arm.normalized(), at);
  }
  add(kPressForce, X.p + X.R * (1e-3 * kPoint));
  for (const ActiveContact& c : state.contacts) {
    const Vec3 normal = c.pair < 3 ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
    add(c.force * normal, X.p + X.R * (1e-3 * kFeet[static_cast<std::size_t>(c.pair)]) - 1e-3 * kFootRadius * normal);
  }
  const double a = state.coordinates[0][0];
  const Vec3 first(1, 0, 0), second(0, std::cos(a), std::sin(a)), third = X.R.col(2);
  return {moment.dot(first), moment.dot(second), moment.dot(third), force.x(), force.y(), force.z()};
}

/// The largest imbalance of a pose, in N or 10 N mm, and how far its feet are from where they stand (mm).
std::pair<double, double> faults(const PosePoint& p, int m) {
  const State& state = p.pose.state;
  std::array<double, 6> q = generalised_forces(state);
  for (int i = 0; i < m; ++i)
    q[static_cast<std::size_t>(kIndex[static_cast<std::size_t>(i)])] += state.multipliers[static_cast<std::size_t>(i)];
  double balance = 0, gap = 0;
  for (int i = 0; i < 6; ++i) balance = std::max(balance, std::abs(q[static_cast<std::size_t>(i)]) * (i < 3 ? 100 : 1));
  for (const ActiveContact& c : state.contacts) {
    const Vec3 centre = 1e3 * (state.poses[1] * (1e-3 * kFeet[static_cast<std::size_t>(c.pair)]));
    gap = std::max(gap, std::abs((c.pair < 3 ? centre.z() : centre.y() + 40) - kFootRadius));
  }
  return {balance, gap};
}

class Counts : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(Counts, BalanceByIndependentSums) {
  const auto [m, n] = GetParam();
  const Solution s = test::solution_of(scene(n, "[[step]]\n" + prescribe(m) + "increments = 3\n"));
  ASSERT_EQ(s.summary.exit_code, kExitOk);
  ASSERT_EQ(s.records.size(), 4u);
  double balance = 0, gap = 0;
  for (const PoseRecord& r : s.records) {
    ASSERT_EQ(r.point.pose.state.contacts.size(), static_cast<std::size_t>(n)) << "all feet carry load";
    ASSERT_EQ(r.point.pose.state.multipliers.size(), static_cast<std::size_t>(m));
    EXPECT_EQ(r.point.stability.free_motions, 6 - m - n);
    EXPECT_EQ(r.point.stability.verdict, Stability::Verdict::stable);
    const auto [force, distance] = faults(r.point, m);
    balance = std::max(balance, force);
    gap = std::max(gap, distance);
  }
  EXPECT_LT(balance, 1e-8) << "N";
  EXPECT_LT(gap, 1e-10) << "mm";
  RecordProperty("worst_imbalance_N", fmt::format("{:.1e}", balance));
}

std::vector<std::pair<int, int>> all_counts() {
  std::vector<std::pair<int, int>> out;
  for (int n = 0; n <= 5; ++n)
    for (int m = 0; m + n <= 5; ++m) out.emplace_back(m, n);
  return out;
}

INSTANTIATE_TEST_SUITE_P(All, Counts, testing::ValuesIn(all_counts()),
                         [](const auto& i) { return fmt::format("M{}N{}", i.param.first, i.param.second); });

TEST(CountsChange, FromStepToStep) {
  // Five prescribed coordinates are let go one after the other; what is no longer prescribed goes where it balances,
  // and the feet come down as they find the floor.
  std::string steps;
  for (int m = 5; m >= 0; --m) steps += "[[step]]\n" + prescribe(std::min(m, 2)) + "increments = 2\n";
  const Solution s = test::solution_of(scene(3, steps));
  ASSERT_EQ(s.summary.exit_code, kExitOk);
  for (const PoseRecord& r : s.records)
    EXPECT_LT(faults(r.point, static_cast<int>(r.point.target.prescribed.size())).first, 1e-8) << r.point.step;
}

TEST(CountsChange, OneTooManyIsRefusedWithTheCount) {
  for (int n = 0; n <= 5; ++n) {
    std::string all = "prescribe = { \"j.z\" = 0";
    for (int m = 0; m + n <= 4 || m < 1; ++m) all += std::string(", ") + kPrescribed[static_cast<std::size_t>(m)];
    Diagnostics out;
    EXPECT_FALSE(parse_scene(scene(n, "[[step]]\n" + all + " }\n"), "scene.toml", out).has_value()) << n;
    EXPECT_NE(test::messages(out).find("at most 5"), std::string::npos) << test::messages(out);
  }
}

}  // namespace
}  // namespace genu
