// Every local minimum of the gap over a whole pair of surfaces, against a fine grid; the memory that makes scans cheap,
// against scans without any.
#include "genu/contact/proximity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include <gtest/gtest.h>

#include "contact/contact_pairs.h"
#include "genu/mesh_care/noise_field.h"
#include "genu/surface/blend_surface.h"
#include "support/brute_force.h"
#include "support/layers.h"

namespace genu {
namespace {

const Proximity::Options kOptions{.spacing = 0.7e-3, .reach = 0.03};

/// Just over the bumps of wavy(): beyond them its polynomial falls away by metres.
const Proximity::Options kOnBumps{.spacing = 0.7e-3, .reach = 0.0205};

/// z = -a T10(x / l) - k y^2: a sheet with five bumps in a row.
std::unique_ptr<Surface> wavy(double a = 0.4e-3, double l = 0.02, double k = 100) {
  const double c[] = {-1, 0, 50, 0, -400, 0, 1120, 0, -1280, 0, 512};  // Chebyshev's T10
  std::vector<PolynomialTerm> terms{{0, 2, -k}};
  for (int i = 0; i <= 10; i += 2) terms.push_back({i, 0, -a * c[i] / std::pow(l, i)});
  return make_polynomial({}, terms, false);
}

/// A plane looking down, `height` (m) over z = 0.
std::unique_ptr<Surface> ceiling(double height) {
  return make_plane({exp_rotation({3.14159265358979312, 0, 0}), {0, 0, height}}, false);
}

/// Each minimum of the scan answers one of the grid and the other way round.
void expect_grid(const Surface& a, const Surface& b, const Pose& X_ab, double window, std::size_t count,
                 const Proximity::Options& options = kOptions) {
  Proximity proximity(a, b, options);
  ProximityScan scan;
  proximity.scan(X_ab, window, scan);
  const bool on_b = proximity.samples_b();
  const Surface &queried = on_b ? a : b, &sampled = on_b ? b : a;
  const double fine = 0.3e-3;
  const auto grid = test::grid_minima(queried, sampled.samples(fine, Vec3::Zero(), options.reach),
                                      on_b ? X_ab : X_ab.inverse(), window);
  EXPECT_EQ(scan.minima.size(), count);
  for (const auto& g : grid) {
    double nearest = 1;
    for (const LocalMinimum& m : scan.minima)
      nearest = std::min(nearest, ((on_b ? m.contact.b : m.contact.a).p - g.point).norm());
    EXPECT_LT(nearest, 3 * fine) << "a grid minimum of " << g.gap << " m at " << g.point.transpose() << " was missed";
  }
  for (const LocalMinimum& m : scan.minima) {
    double nearest = 1;
    for (const auto& g : grid) nearest = std::min(nearest, ((on_b ? m.contact.b : m.contact.a).p - g.point).norm());
    EXPECT_LT(nearest, 3 * fine) << "a minimum of " << m.gap << " m is none on the grid";
  }
  EXPECT_TRUE(std::is_sorted(scan.minima.begin(), scan.minima.end(), [](auto& x, auto& y) { return x.gap < y.gap; }));
}

TEST(Proximity, FiveBumpsUnderAPlane) {
  const auto bumps = wavy(), top = ceiling(0.45e-3);
  expect_grid(*top, *bumps, {}, 0.5e-3, 5, kOnBumps);
  expect_grid(*top, *bumps, {exp_rotation({0, 0.002, 0}), Vec3::Zero()}, 0.5e-3, 5, kOnBumps);
}

TEST(Proximity, BallBetweenBumps) {
  // The closest point of a wavy patch is reached by descent and may not be the nearest of all: no contact may be lost
  // by that, wherever the ball hangs between two bumps (steep ones, 4 mm high).
  const auto bumps = wavy(2e-3, 0.02, 2), ball = make_sphere({}, 3.5e-3, false);
  const SampleSet sheet = bumps->samples(0.3e-3, Vec3::Zero(), 0.021);
  Proximity proximity(*bumps, *ball, kOnBumps);
  for (const double x : {-0.012, -0.0082, -0.0031, 0.0, 0.0047, 0.0063, 0.0118}) {
    SCOPED_TRACE(x);
    const auto lowest_gap = [&](double z) {
      double lowest = 1;
      for (const Vec3& p : sheet.points) lowest = std::min(lowest, (p - Vec3(x, 0, z)).norm() - 3.5e-3);
      return lowest;
    };
    double z = 0.01;
    for (int i = 0; i < 30; ++i) z -= 0.5 * lowest_gap(z);  // until it touches
    ProximityScan scan;
    proximity.scan({exp_rotation({1, 2, x}), {x, 0, z}}, 3e-4, scan);
    ASSERT_GE(scan.minima.size(), 1u);
    EXPECT_NEAR(scan.minima[0].gap, lowest_gap(z), 2e-5);
  }
}

TEST(Proximity, WheelInATrough) {
  // A torus on its edge across a trough narrower than itself touches both flanks.
  const auto wheel = make_torus({exp_rotation({1.5707963267948966, 0, 0}), Vec3::Zero()}, 0.015, 0.005, false);
  const auto trough = make_polynomial({}, {{2, 0, 60}}, false);  // radius 8.3 mm at its bottom
  // Deepest where the flank's normal points at the centre: x^2 + (60 x^2 - h)^2 is least.
  const double h = 0.0245;
  expect_grid(*wheel, *trough, {Mat3::Identity(), {0, 0, -h}}, 1e-3, 2);
}

TEST(Proximity, EggInARing) {
  // An ellipsoid in the hole of a torus: two contacts on opposite sides.
  const auto torus = make_torus({}, 0.015, 0.005, false), egg = make_ellipsoid({}, {0.0096, 0.006, 0.03}, false);
  expect_grid(*torus, *egg, {}, 2e-3, 2);
}

/// Motions of a few tenths of a millimetre and a degree, there and back, with a jump now and then.
std::vector<Pose> random_walk(const Pose& start, int steps) {
  std::mt19937 random(21);
  std::vector<Pose> follow;
  Pose pose = start;
  for (int i = 0; i < steps; ++i) {
    Vec6 twist;
    twist << test::random_vector(random, i % 5 == 4 ? 3e-3 : 2e-4),
        test::random_vector(random, i % 5 == 4 ? 0.2 : 0.01);
    pose = retract(i % 7 == 6 ? start : pose, twist);
    follow.push_back(pose);
  }
  return follow;
}

bool identical(const std::vector<LocalMinimum>& x, const std::vector<LocalMinimum>& y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const LocalMinimum& p, const LocalMinimum& q) {
    return p.gap == q.gap && p.contact.a.p == q.contact.a.p && p.contact.b.p == q.contact.b.p;
  });
}

void expect_no_memory(const Surface& a, const Surface& b, const Pose& start, double window,
                      const Proximity::Options& options = kOptions) {
  Proximity lasting(a, b, options);
  ProximityScan cheap, fresh;
  int seen = 0;
  for (const Pose& X_ab : random_walk(start, 10)) {
    lasting.scan(X_ab, window, cheap);
    Proximity(a, b, options).scan(X_ab, window, fresh);
    ASSERT_TRUE(identical(cheap.minima, fresh.minima)) << cheap.minima.size() << " against " << fresh.minima.size();
    ASSERT_TRUE(identical(cheap.edge, fresh.edge));
    if (std::min(cheap.smallest_sample_gap, fresh.smallest_sample_gap) < window) {
      ASSERT_EQ(cheap.smallest_sample_gap, fresh.smallest_sample_gap);
      ASSERT_EQ(cheap.deepest.point, fresh.deepest.point);
    }
    seen += static_cast<int>(fresh.minima.size());
  }
  EXPECT_GT(seen, 5);
}

TEST(Proximity, RememberedScansAreFreshScans) {
  const auto torus = make_torus({}, 0.015, 0.005, false), egg = make_ellipsoid({}, {0.0096, 0.006, 0.03}, false);
  expect_no_memory(*torus, *egg, {}, 5e-4);
  const auto bumps = wavy(), top = ceiling(0.45e-3);
  expect_no_memory(*top, *bumps, {}, 5e-4, kOnBumps);
}

std::unique_ptr<BlendSurface> meshed(const Surface& surface, double edge) {
  Diagnostics diagnostics;
  auto out = BlendSurface::build(surface.triangles(edge, Vec3::Zero(), 1), {}, "mesh", diagnostics);
  EXPECT_TRUE(out) << (diagnostics.items().empty() ? "" : to_string(diagnostics.items().front()));
  return out;
}

TEST(Proximity, RememberedScansOfMeshesAreFreshScans) {
  const auto ball = meshed(*make_sphere({}, 0.02, false), 2e-3), cup = meshed(*make_sphere({}, 0.024, true), 2.4e-3);
  expect_no_memory(*cup, *ball, {Mat3::Identity(), {0.0038, 0, 0}}, 3e-4);
}

TEST(Proximity, MeshFindsWhatItsSphereFinds) {
  const auto sphere = make_sphere({}, 0.02, false), plane = make_plane({}, false);
  const auto ball = meshed(*sphere, 2e-3);
  Proximity proximity(*plane, *ball, kOptions);
  ProximityScan scan;
  for (const double height : {0.0201, 0.02, 0.0199, 0.018}) {
    proximity.scan({exp_rotation({1, 2, height}), {0, 0, height}}, 2e-4, scan);
    ASSERT_EQ(scan.minima.size(), 1u) << height;
    EXPECT_NEAR(scan.minima[0].gap, height - 0.02, 2e-6);
  }
}

TEST(Proximity, NoPointsOfNoisyMeshesAreNearerByBruteForce) {
  const auto noisy = [](const Surface& surface, double edge, std::uint64_t seed) {
    Diagnostics diagnostics;
    const Mesh mesh = perturbed(surface.triangles(edge, Vec3::Zero(), 1), {20e-6, 3e-3}, seed);
    return BlendSurface::build(mesh, {}, "mesh", diagnostics);
  };
  const auto ball = noisy(*make_sphere({}, 0.02, false), 1e-3, 1), cup = noisy(*make_sphere({}, 0.022, true), 1e-3, 2);
  ASSERT_TRUE(ball && cup);
  // Many points of each facet, put onto the ball's smooth surface one by one.
  std::vector<Vec3> points;
  const Mesh& mesh = ball->mesh();
  constexpr int kCut = 3;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i <= kCut; ++i)
      for (int j = 0; i + j <= kCut; ++j) {
        const Vec3 &a = mesh.vertices[static_cast<std::size_t>(t[0])],
                   &b = mesh.vertices[static_cast<std::size_t>(t[1])],
                   &c = mesh.vertices[static_cast<std::size_t>(t[2])];
        SurfacePoint on;
        if (ball->project(a + (i * (b - a) + j * (c - a)) / kCut, on)) points.push_back(on.p);
      }
  Proximity proximity(*cup, *ball, kOptions);
  ProximityScan scan;
  for (const Vec3& shift : {Vec3(0.0018, 0, 0), Vec3(0, -0.0011, 0.0013), Vec3(-0.0008, 0.0008, -0.0012)}) {
    double smallest = 1;
    for (const Vec3& p : points) {
      if (const auto gap = cup->gap(p + shift)) smallest = std::min(smallest, *gap);
    }
    proximity.scan({Mat3::Identity(), shift}, 5e-4, scan);
    ASSERT_FALSE(scan.minima.empty());
    std::printf("least gap: found %.4f um, of %zu points %.4f um\n", 1e6 * scan.minima[0].gap, points.size(),
                1e6 * smallest);
    EXPECT_LE(scan.minima[0].gap, smallest + 1e-9);  // the gap is second order off the surface
    // A point a quarter of an edge beside the minimum lies that much higher, with relative curvatures below 300 1/m.
    EXPECT_GE(scan.minima[0].gap, smallest - 0.5 * 300 * std::pow(0.25e-3, 2));
  }
}

TEST(Proximity, TwoSpheresHaveOneMinimumAndItIsFoundInASocketToo) {
  const auto ball = make_sphere({}, 0.024, false), socket = make_sphere({}, 0.0241, true);
  Proximity fitting(*socket, *ball, kOptions);
  ProximityScan scan;
  std::mt19937 random(5);
  for (int k = 0; k < 20; ++k) {
    const Vec3 off = test::random_vector(random, 2e-4);
    fitting.scan({exp_rotation(test::random_vector(random, 1)), off}, 5e-4, scan);
    ASSERT_EQ(scan.minima.size(), 1u);
    EXPECT_NEAR(scan.minima[0].gap, 1e-4 - off.norm(), 1e-12);
    EXPECT_NEAR(scan.minima[0].contact.a.p.normalized().dot(off.normalized()), 1, 1e-9);
  }
}

TEST(Proximity, SeesOverlapFarBeyondTheBand) {
  const auto small = meshed(*make_sphere({}, 0.015, false), 1.8e-3),
             large = meshed(*make_sphere({}, 0.045, false), 4e-3);
  ProximityScan scan;
  Proximity proximity(*large, *small, kOptions);
  // Centres 30 mm apart: the lowest point of the small sphere is 30 mm under the surface of the large one.
  proximity.scan({exp_rotation({1, 2, 3}), {0, 0, 0.03}}, 2e-4, scan);
  EXPECT_NEAR(scan.smallest_sample_gap, -0.03, 5e-4);
  EXPECT_NEAR(scan.deepest.gap, scan.smallest_sample_gap, 0);
  EXPECT_GT(scan.deepest.direction.z(), 0.98);
  // Against a closed form: a plane 30 mm above the lowest point.
  const auto plane = make_plane({}, false);
  Proximity over(*plane, *small, kOptions);
  over.scan({Mat3::Identity(), {0, 0, -0.015}}, 2e-4, scan);
  EXPECT_NEAR(scan.smallest_sample_gap, -0.03, 1e-4);
  ASSERT_GE(scan.minima.size(), 1u);
  EXPECT_NEAR(scan.minima[0].gap, -0.03, 5e-6);
}

TEST(Proximity, SwappedSurfacesGiveTheSameContactsMirrored) {
  const auto torus = make_torus({}, 0.015, 0.005, false), egg = make_ellipsoid({}, {0.0096, 0.006, 0.03}, false);
  const auto bumps = wavy(), top = ceiling(0.45e-3);
  const Pose tilted{exp_rotation({0, 0.001, 0}), {0, 1e-4, 0}};
  const auto expect_mirrored = [&](const Surface& a, const Surface& b) {
    ProximityScan ab, ba;
    Proximity(a, b, kOptions).scan(tilted, 5e-4, ab);
    Proximity(b, a, kOptions).scan(tilted.inverse(), 5e-4, ba);
    ASSERT_EQ(ab.minima.size(), ba.minima.size());
    EXPECT_GE(ab.minima.size(), 2u);
    // Not index by index: minima that are equally deep may come in either order.
    for (const LocalMinimum& m : ab.minima) {
      const auto twin = std::find_if(ba.minima.begin(), ba.minima.end(), [&](const LocalMinimum& o) {
        return (m.contact.a.p - o.contact.b.p).norm() < 1e-8 && (m.contact.b.p - o.contact.a.p).norm() < 1e-8;
      });
      ASSERT_NE(twin, ba.minima.end()) << m.gap;
      EXPECT_NEAR(m.gap, twin->gap, 1e-13);
    }
  };
  expect_mirrored(*torus, *egg);
  expect_mirrored(*top, *bumps);
}

/// An open sheet that ends at x = 10 mm, in `cells` x `cells` squares (an odd number: none of its vertices stands under
/// the middle); `trim` (m): what is left of the last row.
Mesh trimmed_sheet(int cells, double trim) {
  const double half = 0.01, cell = 2 * half / cells;
  Mesh mesh = test::sheet(half, cells);
  for (Vec3& v : mesh.vertices)
    if (v.x() < half - 0.5 * cell) v.x() += cell - trim;
  return mesh;
}

/// A ball whose middle is 4 mm past the edge of an open sheet meets its rim from the side, between its vertices.
TEST(Proximity, TheRimOfAnOpenMeshIsFoundWhicheverSurfaceIsNamedFirst) {
  constexpr double kRadius = 0.01, kPast = 4e-3;
  Diagnostics ignored;
  const std::shared_ptr<const Surface> sphere = make_sphere(Pose{}, kRadius, false);
  const std::shared_ptr<const Surface> ball =
      BlendSurface::build(sphere->triangles(0.7e-3, Vec3::Zero(), 0.1), {}, "ball", ignored);
  ASSERT_TRUE(ball);
  const double touching = std::sqrt(kRadius * kRadius - kPast * kPast);
  struct Case {
    int cells;
    double trim;
  };
  for (const Case c : {Case{11, 0.02 / 11}, Case{5, 0.02 / 5}, Case{11, 0.5e-3}, Case{11, 0.1e-3}}) {
    const std::shared_ptr<const Surface> plate =
        BlendSurface::build(trimmed_sheet(c.cells, c.trim), {}, "sheet", ignored);
    ASSERT_TRUE(plate);
    for (const auto& other : {sphere, ball})
      for (const bool first : {true, false})
        for (const double deep : {-1e-5, 1e-5, 5e-5, 3e-4}) {
          const Vec3 place(0.01 + kPast, 0, touching - deep);
          const double gap = std::hypot(kPast, place.z()) - kRadius;
          Proximity proximity(first ? *plate : *other, first ? *other : *plate, kOptions);
          ProximityScan scan;
          proximity.scan({Mat3::Identity(), first ? place : Vec3(-place)}, 1e-3, scan);
          // A sample that has sunk in finds the sheet carried on past its edge as well, where it lies deeper.
          double lowest = 0, nearest = 1;
          for (const LocalMinimum& m : scan.edge) lowest = std::min(lowest, m.gap);
          for (const LocalMinimum& m : scan.edge) nearest = std::min(nearest, std::abs(m.gap - gap));
          EXPECT_TRUE(gap > 0 ? lowest == 0 : nearest < 1e-6)
              << c.cells << " cells, trimmed to " << c.trim << (first ? ", named first, " : ", named second, ")
              << (other == ball ? "a meshed ball, " : "a sphere, ") << deep << ": " << gap << ", found " << lowest;
        }
  }
}

TEST(Proximity, NearSamplesAreAllThatOverlap) {
  const auto plane = make_plane({}, false), sphere = make_sphere({}, 0.02, false);
  Proximity proximity(*plane, *sphere, kOptions);
  std::vector<NearSample> near;
  const double depth = 1e-3;
  proximity.near_samples({exp_rotation({2, 1, 0}), {0, 0, 0.02 - depth}}, 0, near);
  double area = 0, volume = 0;
  for (const NearSample& s : near) {
    EXPECT_LT(s.gap, 0);
    EXPECT_EQ(s.direction, Vec3::UnitZ());
    area += s.area;
    volume -= s.gap * s.area;
  }
  EXPECT_NEAR(area, 2 * M_PI * 0.02 * depth, 0.05 * area);
  EXPECT_NEAR(volume, M_PI * 0.02 * depth * depth, 0.05 * volume);
}

/// A floor with two wells of equal depth, `apart` (m), each with the curvatures `along` and `across` (1/m), turned by
/// `angle` and moved by `offset`, looked at from above by a plane that dips `depth` (m) into both and leans by `tilt`.
struct TwoBumps {
  double apart, along, across, angle, depth, tilt;
  Vec2 offset;

  std::unique_ptr<Surface> floor() const {
    // along / (2 apart^2) (x^2 - apart^2 / 4)^2 + across / 2 y^2, downward: bumps
    const double a = along / (2 * apart * apart), h = apart * apart / 4;
    return make_polynomial({exp_rotation({0, 0, angle}), {offset.x(), offset.y(), 0}},
                           {{4, 0, -a}, {2, 0, 2 * a * h}, {0, 0, -a * h * h}, {0, 2, -across / 2}}, false);
  }
  Pose plane() const { return {exp_rotation({3.14159265358979312, tilt, 0}), {0, 0, -depth}}; }
};

// What lies on the slope of a known contact is not looked at again: no second contact may be lost by that.
TEST(Proximity, TwoContactsAtAnyDistanceAndCurvatureAreBothFound) {
  std::mt19937 random(11);
  const auto between = [&](double low, double high) {
    return std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(random));
  };
  const double spacing = kOptions.spacing;
  int found = 0;
  for (int k = 0; k < 200; ++k) {
    TwoBumps t{between(0.6, 5) * spacing,
               between(0.02, 0.5) / spacing,
               between(0.02, 0.5) / spacing,
               between(0.1, 6.3),
               0,
               0,
               {between(0.1, 1) * spacing, between(0.1, 1) * spacing}};
    // Both reach through the plane; the saddle between them is along apart^2 / 32 below.
    t.depth = between(1e-5, 1) * t.along * t.apart * t.apart / 32;
    t.tilt = 0.2 * t.depth / (t.apart + spacing);
    const auto floor = t.floor(), ceiling = make_plane(t.plane(), false);
    Proximity proximity(*ceiling, *floor, {.spacing = spacing, .reach = 8 * spacing});
    ProximityScan scan;
    proximity.scan({}, 0.2 * spacing, scan);
    const auto through = std::count_if(scan.minima.begin(), scan.minima.end(), [](auto& m) { return m.gap < 0; });
    EXPECT_EQ(through, 2) << k << ": " << t.apart / spacing << " spacings apart, curvature " << t.along * spacing
                          << " along and " << t.across * spacing << " across, " << t.depth / spacing << " deep";
    found += through == 2;
  }
  std::printf("%d of 200 pairs of contacts found\n", found);
}

TEST(Proximity, InAValleyProbesAlongItsBottomFindTheTwin) {
  const double spacing = kOptions.spacing;
  for (const double angle : {0.0, 0.4, 1.3, 2.9}) {
    TwoBumps t{1.5 * spacing, 2e-3 / spacing, 0.02 / spacing, angle, 1e-8, 0, {0.2 * spacing, 0.1 * spacing}};
    const auto floor = t.floor(), ceiling = make_plane(t.plane(), false);
    Proximity proximity(*ceiling, *floor, {.spacing = spacing, .reach = 8 * spacing});
    ProximityScan scan;
    proximity.scan({}, 0.2 * spacing, scan);
    ASSERT_FALSE(scan.minima.empty());
    std::vector<LocalMinimum> found;
    for (const double radius : {0.3, 0.8, 1.6, 3.0})
      proximity.probe_around({}, scan.minima[0].contact, radius * spacing, 1.2e-2 / spacing, found);
    double farthest = 0;
    for (const LocalMinimum& m : found)
      farthest = std::max(farthest, (m.contact.b.p - scan.minima[0].contact.b.p).norm());
    EXPECT_NEAR(farthest, t.apart, 1e-3 * t.apart) << angle;
  }
}

TEST(Proximity, ProbesFindTheTwinNextDoor) {
  const auto bumps = wavy(), top = ceiling(0.45e-3);
  Proximity proximity(*top, *bumps, kOptions);
  ProximityScan scan;
  proximity.scan({}, 5e-4, scan);
  ASSERT_EQ(scan.minima.size(), 5u);
  // The bumps stand at 0, +-11.8 and +-19.0 mm: 6 mm beside the second ones the others begin.
  for (const LocalMinimum& m : scan.minima) {
    std::vector<LocalMinimum> found;
    proximity.probe_around({}, m.contact, 6e-3, 1e3, found);
    std::size_t known = 0;
    for (const LocalMinimum& f : found)
      for (const LocalMinimum& s : scan.minima) {
        const bool other = (s.contact.b.p - m.contact.b.p).norm() > 1e-3;
        known += other && (f.contact.b.p - s.contact.b.p).norm() < 2e-6 ? 1 : 0;
      }
    EXPECT_EQ(known, found.size());
    const double x = std::abs(m.contact.b.p.x());
    EXPECT_EQ(found.size(), x > 11e-3 && x < 12e-3 ? 2u : 0u) << x;
  }
}

}  // namespace
}  // namespace genu
