// Every shape in a contact, from outside and from inside, against an equilibrium known in closed form: a ball of radius
// r, pulled with k d by a spring of zero slack toward a point d deeper than its centre can come, rests where its centre
// is r above the surface's point s on the normal through that point. And what the edges of a patch do.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "genu/mesh_files/stl_writer.h"
#include "genu/surface/analytic.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

namespace genu::test {
namespace {

struct ShapeCase {
  std::string keys;
  Vec3 s, n;  ///< mm, in the shape's own frame; outward unit normal without `inside`
  double radius = 5, pull = 4;
};

ShapeCase ellipsoid() {
  const Vec3 radii(14, 12, 10);
  const double u = 0.5, v = 2.1;
  const Vec3 s(radii.x() * std::cos(u) * std::cos(v), radii.y() * std::cos(u) * std::sin(v), radii.z() * std::sin(u));
  return {"shape = \"ellipsoid\"\nradii = [14, 12, 10]\n", s, s.cwiseQuotient(radii.cwiseProduct(radii)).normalized()};
}

ShapeCase torus(double theta) {
  const double phi = 1.1;
  const Vec3 e(std::cos(phi), std::sin(phi), 0), n = std::cos(theta) * e + std::sin(theta) * Vec3::UnitZ();
  return {"shape = \"torus\"\nmajor_radius = 20\nminor_radius = 6\n", 20 * e + 6 * n, n, 3};
}

ShapeCase cartesian() {
  const double x = 3, y = -2;
  const double z = 1 + 0.1 * x - 0.05 * y + 0.01 * x * x - 0.007 * x * y - 0.008 * y * y + 1e-4 * y * y * y;
  const double zx = 0.1 + 0.02 * x - 0.007 * y, zy = -0.05 - 0.007 * x - 0.016 * y + 3e-4 * y * y;
  return {
      "shape = \"polynomial\"\nterms = [[0, 0, 1], [1, 0, 0.1], [0, 1, -0.05], [2, 0, 0.01], [1, 1, -0.007], "
      "[0, 2, -0.008], [0, 3, 1e-4]]\n",
      Vec3(x, y, z), Vec3(-zx, -zy, 1).normalized()};
}

ShapeCase cylindrical() {
  const double t = -0.6, z = 2;
  const double r = 20 + 2 * t - 0.6 * t * t + 0.1 * z - 0.012 * z * z;
  const double rt = 2 - 1.2 * t, rz = 0.1 - 0.024 * z;
  const Vec3 e(std::cos(t), std::sin(t), 0), across(-e.y(), e.x(), 0);
  return {
      "shape = \"polynomial\"\nchart = \"cylindrical\"\nterms = [[0, 0, 20], [1, 0, 2], [2, 0, -0.6], [0, 1, 0.1], "
      "[0, 2, -0.012]]\n",
      r * e + z * Vec3::UnitZ(), (e - rt / r * across - rz * Vec3::UnitZ()).normalized()};
}

std::vector<ShapeCase> shapes() {
  const Vec3 d = Vec3(1, 2, -2) / 3, c(std::cos(0.7), std::sin(0.7), 0);
  std::vector<ShapeCase> all = {{"shape = \"plane\"\n", Vec3(4, -3, 0), Vec3::UnitZ()},
                                {"shape = \"sphere\"\nradius = 20\n", 20 * d, d},
                                ellipsoid(),
                                {"shape = \"cylinder\"\nradius = 12\n", 12 * c + Vec3(0, 0, 4), c},
                                torus(0.4),
                                torus(2.6),
                                cartesian(),
                                cylindrical()};
  const std::size_t whole = all.size();
  for (std::size_t k = 0; k < whole; ++k) {
    ShapeCase limited = all[k];
    limited.keys +=
        fmt::format("patch = {{ x = [{}, {}], y = [{}, {}], z = [{}, {}] }}\n", limited.s.x() - 9, limited.s.x() + 7,
                    limited.s.y() - 6, limited.s.y() + 8, limited.s.z() - 7, limited.s.z() + 6);
    all.push_back(limited);
  }
  return all;
}

std::string list(const Vec3& v) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z()); }

/// Two bodies, one fixed; the moving one at the reference `start`, its rotations held, a spring from its origin to the
/// point `anchor`.
std::string scene_text(const std::string& of_fixed, const std::string& of_moving, const Vec3& start,
                       const Vec3& anchor) {
  return fmt::format(
      "format = 1\nunits = {{ length = \"mm\", angle = \"deg\" }}\n[body.still]\nfixed = true\n[body.moving]\n"
      "[joint.j]\ntype = \"free\"\nparent = \"still\"\nchild = \"moving\"\nrotations = [\"a x\", \"b y\", \"c z\"]\n"
      "translations = [\"x\", \"y\", \"z\"]\nreference = {{ x = {:.17g}, y = {:.17g}, z = {:.17g} }}\n"
      "[surface.one]\nbody = \"still\"\n{}[surface.two]\nbody = \"moving\"\n{}"
      "[contact.pair]\nsurfaces = [\"one\", \"two\"]\nmodel = \"rigid\"\n"
      "[ligament.pull]\nfrom = {{ body = \"moving\", point = [0, 0, 0] }}\nto = {{ body = \"still\", point = {} }}\n"
      "law = \"spring\"\nstiffness = 10\nslack_length = 0\n",
      start.x(), start.y(), start.z(), of_fixed, of_moving, list(anchor));
}

const std::string kHeld = "[[step]]\nprescribe = { \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0 }\n";

struct BalanceErrors {
  double position = 0, force = 0;  ///< mm, N
};

void solve_and_compare(const ShapeCase& c, bool inside, bool shape_moves, BalanceErrors& worst) {
  SCOPED_TRACE(c.keys + (inside ? "inside" : "outside") + (shape_moves ? ", the shape moves" : ", the ball moves"));
  const Vec3 origin(3, -2, 5), z_axis(0.2, -0.3, 1), x_axis(1, 0.4, 0);
  Mat3 R;
  R.col(2) = z_axis.normalized();
  R.col(0) = (x_axis - x_axis.dot(R.col(2)) * R.col(2)).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  const Vec3 n = (inside ? -1 : 1) * (R * c.n), s = origin + R * c.s;
  const std::string shape = c.keys + fmt::format("inside = {}\norigin = {}\nz_axis = {}\nx_axis = {}\n", inside,
                                                 list(origin), list(z_axis), list(x_axis));
  const std::string ball = fmt::format("shape = \"sphere\"\nradius = {}\n", c.radius);
  const Vec3 rest = shape_moves ? Vec3(2, -1, 3) : Vec3(s + c.radius * n);  // of the moving body's origin
  const Vec3 away = shape_moves ? Vec3(-n) : n;                             // from the contact
  const Vec3 start = rest + 0.8 * away + 0.5 * R * Vec3(0.3, 0.8, -0.4);
  const Vec3 anchor = rest - c.pull * away;
  const std::string still_ball = ball + "origin = " + list(rest + s + c.radius * n) + "\n";
  const ResultTable t = table_of(
      (shape_moves ? scene_text(still_ball, shape, start, anchor) : scene_text(shape, ball, start, anchor)) + kHeld);
  ASSERT_EQ(t.rows(), 2u);
  const Vec3 found(t.number(1, "j.x_mm"), t.number(1, "j.y_mm"), t.number(1, "j.z_mm"));
  const double off = (found - rest).norm(), force = std::abs(t.number(1, "pair.force_N") - 10 * c.pull);
  EXPECT_LT(off, 1e-9);
  EXPECT_LT(force, 1e-8);
  EXPECT_EQ(word(t, 1, "stability"), "stable");
  worst = {std::max(worst.position, off), std::max(worst.force, force)};
}

TEST(Shapes, ABallRestsWhereItShouldOnEveryShapeOutsideAndInside) {
  BalanceErrors worst;
  for (const ShapeCase& c : shapes()) {
    // A polynomial without a patch and an ellipsoid take seconds to cut into samples.
    const bool endless = c.keys.find("terms") != std::string::npos && c.keys.find("patch") == std::string::npos;
    const bool slow = endless || c.keys.find("ellipsoid") != std::string::npos;
    for (const bool inside : {false, true})
      for (const bool shape_moves : {false, true})
        if (!slow || inside != shape_moves) solve_and_compare(c, inside, shape_moves, worst);
  }
  fmt::print("  worst: {:.1e} mm, {:.1e} N\n", worst.position, worst.force);
}

// ---- edges -----------------------------------------------------------------------------------------------------

const std::string kPlate = "shape = \"plane\"\npatch = { x = [-10, 10], y = [-20, 20] }\n";
const std::string kBall = "shape = \"sphere\"\nradius = 20\n";

const std::string kPair = "[\"one\", \"two\"]", kSwapped = "[\"two\", \"one\"]";

auto over_edge(const Solution& solution) {
  return std::find_if(solution.events.begin(), solution.events.end(),
                      [](const PathEvent& e) { return e.kind == PathEvent::Kind::over_edge; });
}

TEST(PatchEdges, AContactThatRunsOffEndsThePathAtTheEdgeAndKeepsThePoses) {
  for (const bool ball_first : {false, true}) {
    std::string text = scene_text(kPlate, kBall, {0, 0, 20}, {0, 0, 5}) +
                       "[[step]]\nprescribe = { \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0, \"j.y\" = [0, 30] }\n"
                       "increments = 30\n";
    if (ball_first) text = text.replace(text.find(kPair), kPair.size(), kSwapped);
    const Solution solution = solution_of(text);
    EXPECT_EQ(solution.summary.exit_code, kExitIncomplete);
    const ResultTable& t = solution.poses;
    ASSERT_EQ(t.rows(), 22u);
    // The contact stays under the ball's centre: rows up to 20 mm are ok. That one is on the edge itself, to rounding.
    for (std::size_t row = 0; row < 20; ++row) {
      EXPECT_EQ(word(t, row, "status"), "ok") << row;
      EXPECT_NEAR(t.number(row, "pair.one.y_mm"), static_cast<double>(row), 1e-9);
    }
    EXPECT_EQ(word(t, 21, "status"), "over_edge");
    const auto edge = over_edge(solution);
    ASSERT_NE(edge, solution.events.end());
    EXPECT_NEAR(30 * edge->t, 20, 1e-6);
  }
}

TEST(PatchEdges, OfAMeshEndThePathWhereTheyAre) {
  const TemporaryFolder folder;
  const std::string file = folder / "plate.stl";
  ASSERT_EQ(write_stl(make_plane({}, false)->triangles(1e-3, Vec3::Zero(), 0.04), file, 1e-3, "plate"), "");
  const std::string plate =
      "shape = \"mesh\"\nunits = \"mm\"\nfile = \"" + file + "\"\npatch = { x = [-10, 10], y = [-20, 20] }\n";
  const Solution solution =
      solution_of(scene_text(plate, kBall, {0, 0, 20}, {0, 0, 5}) +
                  "[[step]]\nprescribe = { \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0, \"j.y\" = [0, 30] }\n"
                  "increments = 30\n");
  EXPECT_EQ(solution.summary.exit_code, kExitIncomplete);
  const auto edge = over_edge(solution);
  ASSERT_NE(edge, solution.events.end());
  EXPECT_NEAR(30 * edge->t, 20, 1e-4);  // single precision of the file
  EXPECT_NEAR(solution.poses.number(19, "j.z_mm"), 20, 1e-4);
}

TEST(PatchEdges, NothingTouchesTheSurfaceBeyondThePatch) {
  // Beside the plate the ball hangs on its spring, half of it below the plane that the plate is a part of.
  const ResultTable t = table_of(scene_text(kPlate, kBall, {0, 60, 3}, {1, 60, 5}) + kHeld);
  EXPECT_NEAR(t.number(1, "j.z_mm"), 5, 1e-9);
  EXPECT_EQ(t.number(1, "pair.force_N"), 0);
  // The nearest point is the middle of the plate's edge.
  EXPECT_NEAR(t.number(1, "pair.gap_mm"), std::hypot(40, 5) - 20, 0.02);
}

TEST(PatchEdges, ABodyThatMeetsTheRimIsNoContactButIsNotMissed) {
  // At y = 35 the ball meets the edge y = 20 when its centre is as low as sqrt(20^2 - 15^2). Where the plate is sampled
  // its rim is known; samples of the ball pass over it by less than their spacing of 1/3 mm.
  for (const bool ball_first : {false, true}) {
    std::string text = scene_text(kPlate, kBall, {0, 35, 25}, {0, 35, 5}) +
                       "[[step]]\nprescribe = { \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0, \"j.z\" = [25, 5] }\n"
                       "increments = 20\n";
    if (ball_first) text = text.replace(text.find(kPair), kPair.size(), kSwapped);
    const Solution solution = solution_of(text);
    EXPECT_EQ(solution.summary.exit_code, kExitIncomplete);
    const auto edge = over_edge(solution);
    ASSERT_NE(edge, solution.events.end());
    EXPECT_NEAR(25 - 20 * edge->t, std::sqrt(400 - 225), ball_first ? 0.01 : 0.2);
  }
}

}  // namespace
}  // namespace genu::test
