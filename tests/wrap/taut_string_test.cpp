// Strings over closed forms and meshes against reference lengths, closed forms and differences.
#include "genu/wrap/taut_string.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "genu/surface/analytic.h"
#include "genu/surface/blend_surface.h"
#include "genu/wrap/chain.h"

namespace genu {
namespace {

using Numbers = std::array<double, 3>;

Vec3 mm(const Numbers& x) { return units::kMillimetre * Vec3(x[0], x[1], x[2]); }
Vec3 plain(const Numbers& x) { return {x[0], x[1], x[2]}; }

/// Computed by another code, good to 1e-10 relative (mm).
struct Reference {
  const char* name;
  bool cylinder;  ///< about z; else an ellipsoid
  Numbers radii, from, to;
  double length;
  Numbers touch_from, touch_to, by_from, by_to;
};
// clang-format off
const Reference kReferences[] = {
    {"sphere_oblique", false,
     {20.0, 20.0, 20.0},
     {30.0, 2.0, 1.0},
     {-28.0, 6.0, 3.0},
     66.8968238961662,
     {12.149185014240787, 14.209779829110573, 7.104889914555287},
     {-10.158204243114206, 15.409370825706658, 7.704685412853329},
     {0.7943508410799145, -0.543328071261283, -0.2716640356306415},
     {-0.861410016419556, -0.45428870433860474, -0.22714435216930237}},
    {"thin_needle", false,
     {25.0, 5.4, 5.3},
     {3.0, 9.0, -6.0},
     {-2.0, -8.0, 7.0},
     23.991345337399046,
     {1.0357807526667786, 4.841402989204098, 2.3372374831162688},
     {-0.010467848137273167, 1.0732342197956473, 5.194268843028498},
     {0.20629002872744548, 0.4367522098094076, -0.875609462759642},
     {-0.21025018995532563, -0.9588431212006968, 0.19082643042790273}},
    {"random_1", false,
     {11.960640303, 11.371739691, 16.126907647},
     {-0.554911966, 13.190017935, -25.499974872},
     {-4.653429156, -11.515689877, 9.493138006},
     46.06032796760571,
     {-7.9009852047326135, -1.8563370561090893, -11.81766265501102},
     {-7.775467647484968, -8.630919976131839, -0.5893435556897865},
     {0.33973091255654625, 0.6958427646870966, -0.6327604237672535},
     {0.285328401216328, -0.263644021681422, 0.9214551173502593}},
    {"random_3", false,
     {22.300803022, 10.0151681, 14.238407765},
     {-0.45351086, 12.332699348, -8.138230595},
     {1.927490021, -17.739574885, 2.978640237},
     39.35800970215894,
     {0.294323553301163, 3.8429567854336857, -13.14714500556073},
     {1.0411835018725524, -6.526875333159367, -10.77903507925778},
     {-0.07564920444451083, 0.8588027768190009, 0.5066902292277661},
     {0.04987570184342128, -0.6309795173843322, 0.7741945898849082}},
    {"random_5", false,
     {25.408452595, 14.486154289, 29.46869711},
     {35.689416228, -16.763025792, 5.039822426},
     {-32.806824235, 10.199453256, -10.45672151},
     81.08279345691422,
     {-2.1260405969823277, -14.290915300717142, -4.143699049056443},
     {-22.536671508819854, -5.143950825109044, -8.70114071236655},
     {0.9698001690199819, -0.06339876265674722, 0.23551694007524818},
     {-0.5537471116153884, 0.8272871805254476, -0.09465757928380614}},
    {"random_7", false,
     {19.242978696, 8.636498844, 9.811587374},
     {-16.089865577, -11.415635261, 13.254159121},
     {12.386215412, 6.753202583, -11.154886875},
     44.95344759272063,
     {-2.3968711833954472, -8.243855897625, -2.6571974731342523},
     {5.21532598067992, -2.437678581050879, -9.029212644850341},
     {-0.6449713379354164, -0.14939805867535677, 0.7494612687162917},
     {0.6051600201979941, 0.7756295623709012, -0.17938821569514393}},
    {"just_touching", false,
     {30.0, 18.0, 12.0},
     {-40.0, 17.9995, 0.3},
     {40.0, 17.9995, -0.2},
     80.00156248769609,
     {0.001523125133144898, 17.999843772190065, 0.049992628714522896},
     {0.0023823811621855734, 17.999843772189703, 0.04998725836433849},
     {-0.9999804696208895, -8.593809665326845e-06, 0.006249824232059247},
     {0.9999804689495875, -8.594648779958077e-06, -0.00624993163924988}},
    {"helix", true,
     {18.0, 18.0, 18.0},
     {25.0, -8.0, 0.0},
     {-24.0, -6.0, 15.0},
     56.3910369670117,
     {7.763256695015726, -16.239822828075848, 5.271845726627342},
     {-9.711077162033442, -15.15569135186622, 10.31712565693454},
     {0.8697084697132731, 0.41575392611678036, -0.26599971922443777},
     {-0.8116488260137004, 0.520067623105979, 0.26599971922443766}},
    {"along_axis", true,
     {18.0, 18.0, 18.0},
     {18.5, 0.0, -30.0},
     {-18.2, 3.0, 30.0},
     80.55542219964398,
     {17.51351351351352, 4.156542362586904, -25.231347431273097},
     {-16.691705942453012, 6.736983949118388, 25.50160839400177},
     {0.15408200835187566, -0.649221660712346, -0.7448288192357733},
     {-0.24973834657815622, -0.6187574551342826, 0.7448288192357724}},
};
// clang-format on

std::vector<Touch> found(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles,
                         const std::vector<WrapSide>& sides) {
  const auto touches = first_string(from, to, obstacles, sides);
  EXPECT_TRUE(touches);
  return touches.value_or(std::vector<Touch>(obstacles.size()));
}

TEST(TautString, IsThatOfAnotherCode) {
  for (const Reference& r : kReferences) {
    const std::shared_ptr<const Surface> surface =
        r.cylinder ? make_cylinder({}, units::kMillimetre * r.radii[0], false) : make_ellipsoid({}, mm(r.radii), false);
    const Obstacle obstacle{surface.get(), {}};
    const Vec3 from = mm(r.from), to = mm(r.to);
    const std::vector<Touch> touches = found(from, to, {&obstacle, 1}, {{}});
    ASSERT_TRUE(touches[0].touching) << r.name;
    const Geodesic& arc = touches[0].arc;
    const double length = to::kMillimetre * length_of(from, to, {&obstacle, 1}, touches);
    EXPECT_NEAR(length, r.length, r.cylinder ? 1e-10 : 1e-8) << r.name;
    EXPECT_LT((arc.begin.p - mm(r.touch_from)).norm(), 1e-8 * units::kMillimetre) << r.name;
    EXPECT_LT((arc.end.p - mm(r.touch_to)).norm(), 1e-8 * units::kMillimetre) << r.name;
    EXPECT_LT(((from - arc.begin.p).normalized() - plain(r.by_from)).norm(), 1e-9) << r.name;
    EXPECT_LT(((to - arc.end.p).normalized() - plain(r.by_to)).norm(), 1e-9) << r.name;
    StringHessian hessian;
    string_hessian(from, to, {&obstacle, 1}, {&arc, 1}, hessian);
    EXPECT_TRUE(is_shortest_nearby(hessian, {&arc, 1})) << r.name;
  }
}

/// A string in the plane z = 0 round a circle of radius 20 mm, which it leaves `angle` (rad) after it has come on, by
/// legs of 30 and 25 mm; `sense`: 1 against the clock, -1 with it.
struct Round {
  static constexpr double kRadius = 0.02, kFirst = 0.03, kLast = 0.025;
  Vec3 from, to;
  double length;
  Touch start;  ///< near the solution

  Round(double angle, double sense) {
    const auto at = [&](double phi) { return Vec3(std::cos(phi), sense * std::sin(phi), 0); };
    const auto along = [&](double phi) { return Vec3(-std::sin(phi), sense * std::cos(phi), 0); };
    from = kRadius * at(0) - kFirst * along(0);
    to = kRadius * at(angle) + kLast * along(angle);
    length = kFirst + kLast + kRadius * angle;
    start.touching = true;
    start.arc.begin.p = kRadius * at(0.05);
    start.arc.begin.t = along(0.1);
    start.arc.length = kRadius * (angle - 0.1);
  }
};

TEST(TautString, GoesRoundCirclesFromTangentialToThreeQuarters) {
  const std::unique_ptr<Surface> shapes[] = {make_sphere({}, Round::kRadius, false),
                                             make_cylinder({}, Round::kRadius, false),
                                             make_ellipsoid({}, Vec3::Constant(Round::kRadius), false)};
  for (const auto& shape : shapes)
    for (const double angle : {1e-9, 1e-6, 1e-3, 0.3, 1.0, 2.0, 3.0, 4.0, 4.7})
      for (const double sense : {1.0, -1.0}) {
        Round r(angle, sense);
        const Obstacle obstacle{shape.get(), {}};
        ASSERT_TRUE(solve_touches(r.from, r.to, {&obstacle, 1}, {&r.start, 1})) << angle;
        EXPECT_NEAR(length_of(r.from, r.to, {&obstacle, 1}, {&r.start, 1}), r.length, 1e-13) << angle;
        EXPECT_NEAR(r.start.arc.length, Round::kRadius * angle, 1e-13 + 1e-12 * angle) << angle;
      }
}

TEST(TautString, ContinuesBackwardsWhereItHasLeft) {
  const auto shape = make_cylinder({}, Round::kRadius, false);
  const Obstacle obstacle{shape.get(), {}};
  Round r(-1e-3, 1);
  r.start.arc.length = 1e-4;
  ASSERT_TRUE(solve_touches(r.from, r.to, {&obstacle, 1}, {&r.start, 1}));
  EXPECT_NEAR(r.start.arc.length, -1e-3 * Round::kRadius, 1e-14);
  ASSERT_TRUE(settle_touches(r.from, r.to, {&obstacle, 1}, {&r.start, 1}));
  EXPECT_FALSE(r.start.touching);
}

/// The long way round a sphere is stationary and not shortest: it slips off.
TEST(TautString, TellsAStationaryStringFromAShortestOne) {
  const auto sphere = make_sphere({}, Round::kRadius, false), cylinder = make_cylinder({}, Round::kRadius, false);
  for (const bool round : {true, false})
    for (const double angle : {1.0, 4.0}) {
      Round r(angle, 1);
      const Obstacle obstacle{(round ? sphere : cylinder).get(), {}};
      ASSERT_TRUE(solve_touches(r.from, r.to, {&obstacle, 1}, {&r.start, 1}));
      StringHessian hessian;
      string_hessian(r.from, r.to, {&obstacle, 1}, {&r.start.arc, 1}, hessian);
      EXPECT_EQ(is_shortest_nearby(hessian, {&r.start.arc, 1}), !round || angle < EIGEN_PI) << angle;
    }
}

TEST(TautString, IsTheSameAKilometreAway) {
  const Vec3 far(1000, -700, 300);
  const auto shape = make_ellipsoid({}, Vec3(0.03, 0.018, 0.012), false);
  const Vec3 from(0.01, 0.03, -0.02), to(-0.005, -0.035, 0.01);
  const Obstacle here{shape.get(), {}}, there{shape.get(), {Mat3::Identity(), far}};
  const auto a = found(from, to, {&here, 1}, {{}}), b = found(far + from, far + to, {&there, 1}, {{}});
  EXPECT_NEAR(length_of(from, to, {&here, 1}, a), length_of(far + from, far + to, {&there, 1}, b), 1e-11);
}

TEST(TautString, PassesTwoObstaclesOnOppositeSides) {
  const auto ball = make_sphere({}, 0.01, false);
  const auto rod = make_cylinder({}, 0.012, false);
  const Obstacle both[] = {{ball.get(), {Mat3::Identity(), Vec3(-0.03, -0.004, 0)}},
                           {rod.get(), {exp_rotation(Vec3(0.2, 0.1, 0)), Vec3(0.03, 0.006, 0)}}};
  const Vec3 from(-0.06, 0, 0.001), to(0.07, 0, -0.002);
  const auto touches = found(from, to, both, {Vec3(0, 1, 0), Vec3(0, -1, 0)});
  EXPECT_TRUE(touches[0].touching);
  EXPECT_TRUE(touches[1].touching);
  EXPECT_GT(touches[0].arc.begin.p.y(), 0);
  EXPECT_LT(touches[1].arc.begin.p.y(), 0);
  // Legs and arcs meet without a corner.
  const Vec3 leg = (both[1].X_W * touches[1].arc.begin.p - both[0].X_W * touches[0].arc.end.p).normalized();
  EXPECT_LT((leg - touches[0].arc.end.t).norm(), 1e-13);
  EXPECT_LT((leg - both[1].X_W.R * touches[1].arc.begin.t).norm(), 1e-13);
}

/// Lengths of strings over blends of meshes of ever shorter edges converge to those over the shapes.
void expect_convergence(const Surface& exact, double reach, const Vec3& from, const Vec3& to, const char* name) {
  const Obstacle shape{&exact, {}};
  const double length = length_of(from, to, {&shape, 1}, found(from, to, {&shape, 1}, {{}}));
  double first = 0, last = 0;
  std::size_t triangles = 0;
  constexpr double kCoarse = 4e-3, kFine = 1.4e-3;  // m
  for (const double edge : {kCoarse, kFine}) {
    Mesh mesh = exact.triangles(edge, Vec3::Zero(), reach);
    triangles = mesh.triangles.size();
    Diagnostics unused;
    const auto blend = BlendSurface::build(std::move(mesh), {}, name, unused);
    ASSERT_TRUE(blend);
    const Obstacle obstacle{blend.get(), {}};
    const auto touches = found(from, to, {&obstacle, 1}, {{}});
    last = std::abs(length_of(from, to, {&obstacle, 1}, touches) - length);
    if (edge == kCoarse) first = last;
  }
  const double order = std::log(first / last) / std::log(kCoarse / kFine);
  std::cout << name << ": " << to::kMillimetre * last << " mm at " << triangles << " triangles, order " << order
            << "\n";
  EXPECT_LT(to::kMillimetre * last, 1e-3);
  EXPECT_GT(order, 3);
}

TEST(TautString, OverMeshesConverges) {
  expect_convergence(*make_ellipsoid({}, Vec3(0.03, 0.018, 0.012), false), 1, Vec3(0.01, 0.03, -0.02),
                     Vec3(-0.005, -0.035, 0.01), "ellipsoid");
  expect_convergence(*make_cylinder({}, 0.018, false), 0.04, Vec3(0.025, -0.008, 0), Vec3(-0.024, -0.006, 0.015),
                     "cylinder");
}

/// Two humps with a hollow between: named twice, the surface is touched on each, and the string spans the hollow.
TEST(TautString, SpansAHollowWhereItsSurfaceIsNamedTwice) {
  const auto humps = make_polynomial({}, {{0, 2, -20.0}, {2, 0, 20.0}, {4, 0, -2e5}}, false);
  const Vec3 from(-0.03, 0.001, -0.005), to(0.03, -0.001, -0.006);
  const std::vector<Obstacle> twice(2, {humps.get(), {}});
  const auto once = found(from, to, {twice.data(), 1}, {Vec3(0, 0, 1)});
  EXPECT_GT(once[0].arc.lift(), 1e-6 * once[0].arc.length) << "it would lift off";
  const auto both = found(from, to, twice, {Vec3(0, 0, 1), Vec3(0, 0, 1)});
  for (const Touch& touch : both) {
    EXPECT_TRUE(touch.touching);
    EXPECT_EQ(touch.arc.lift(), 0);
  }
  EXPECT_LT(both[0].arc.end.p.x(), both[1].arc.begin.p.x());
  EXPECT_LT(length_of(from, to, twice, both), length_of(from, to, {twice.data(), 1}, once) - 1e-5);
}

TEST(LineClearance, IsTheLeastGap) {
  const auto ellipsoid = make_ellipsoid({}, Vec3(0.025, 0.0054, 0.0053), false);
  const auto rod = make_cylinder({}, 0.018, false);
  for (const Surface* surface : {ellipsoid.get(), rod.get()})
    for (const double height : {0.003, 0.0053, 0.02}) {
      const Vec3 from(-0.04, 0.006, height), to(0.03, -0.003, height + 0.002);
      double along = 0, least = 1;
      const double clearance = line_clearance(*surface, from, to, along);
      for (int k = 0; k <= 100000; ++k)
        least = std::min(least, surface->gap(from + k / 100000.0 * (to - from)).value_or(1));
      EXPECT_NEAR(clearance, least, 1e-9);
      EXPECT_LE(clearance, least + 1e-15);
      EXPECT_NEAR(surface->gap(from + along * (to - from)).value_or(1), clearance, 1e-15);
    }
}

}  // namespace
}  // namespace genu
