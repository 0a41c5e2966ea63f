// The rates of a path's length and pull by its points and by the numbers of the surfaces that it wraps round, against
// differences of paths over other surfaces.
#include "genu/model/path_change.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "genu/surface/analytic.h"
#include "support/finite_difference.h"

namespace genu {
namespace {

/// Bodies 0 and 1 move, body 2 is fixed.
const std::vector<Pose> kPoses = {{exp_rotation(Vec3(0.3, -0.2, 0.1)), Vec3(0.01, 0.02, 0.05)},
                                  {exp_rotation(Vec3(-0.1, 0.4, 0.2)), Vec3(-0.02, 0.01, -0.06)},
                                  {}};

SurfaceDef surface(const char* name, SurfaceDef::Shape shape, int body, const Pose& X_W) {
  SurfaceDef def;
  def.name = name;
  def.shape = shape;
  def.body = body;
  def.placement = kPoses[static_cast<std::size_t>(body)].inverse() * X_W;
  return def;
}

std::shared_ptr<const Surface> made(const SurfaceDef& def, double offset) {
  const Pose& X = def.placement;
  switch (def.shape) {
    case SurfaceDef::Shape::sphere:
      return make_sphere(X, def.radius + offset, false);
    case SurfaceDef::Shape::cylinder:
      return make_cylinder(X, def.radius + offset, false);
    case SurfaceDef::Shape::torus:
      return make_torus(X, def.major_radius, def.minor_radius + offset, false);
    default:
      return make_ellipsoid(X, def.radii, false);
  }
}

/// A cord over two obstacles in a row, on a moving and a fixed body.
struct Cord {
  SceneTables scene;
  std::vector<WrapDef> wraps;
  Vec3 from, to;  ///< in the world

  LigamentPath path(const std::vector<SurfaceDef>& surfaces, const std::vector<double>& offsets) const {
    LigamentPath out({{0, kPoses[0].inverse() * from}, {2, to}});
    std::vector<LigamentPath::Obstacle> obstacles;
    for (std::size_t i = 0; i < surfaces.size(); ++i)
      obstacles.push_back({surfaces[i].name, surfaces[i].body, made(surfaces[i], offsets[i]), 0, wraps[i].side});
    out.set_obstacles(std::move(obstacles), 0);
    out.move_with({0, 1, -1});
    return out;
  }
  LigamentPath path() const { return path(scene.surfaces, std::vector<double>(scene.surfaces.size(), 0.0)); }

  void add(const SurfaceDef& def, const Vec3& side_W) {
    WrapDef wrap;
    wrap.surface = static_cast<int>(scene.surfaces.size());
    wrap.side = Vec3(kPoses[static_cast<std::size_t>(def.body)].R.transpose() * side_W);
    scene.surfaces.push_back(def);
    wraps.push_back(wrap);
  }
};

/// First the pull on both moving bodies, then the length.
VecX pull_and_length(const LigamentPath& path, const Wraps& start) {
  Wraps wraps = start;
  EXPECT_TRUE(path.follow_touches(kPoses, wraps));
  VecX out = VecX::Zero(13);
  VecX pull = VecX::Zero(12);
  path.add_tension(kPoses, 1, pull, wraps);
  out << pull, path.length(kPoses, wraps);
  return out;
}

VecX rates(const LigamentPath& path, const Wraps& wraps, const LigamentPath::Change& change) {
  VecX pull = VecX::Zero(12), out(13);
  add_pull_rate(path, kPoses, wraps, change, 1, pull);
  out << pull, length_rate(path, kPoses, wraps, change);
  return out;
}

/// All numbers of all surfaces; returns how many.
int expect_rates(const Cord& cord, double tolerance) {
  const LigamentPath path = cord.path();
  Wraps wraps(cord.wraps.size());
  EXPECT_TRUE(path.find_touches(kPoses, wraps));
  for (const WrapTouch& touch : wraps) EXPECT_TRUE(touch.touching && touch.arc.length > 1e-3);
  double worst = 0;
  int count = 0;
  for (const Parameter& p : parameters_of(cord.scene)) {
    if (p.kind == Parameter::Kind::offset && cord.scene.surfaces[at(p.object)].shape == SurfaceDef::Shape::ellipsoid)
      continue;  // its parallel surface is no ellipsoid
    const VecX truth = test::derivative(
        [&](double step) {
          SceneTables edited = cord.scene;
          std::vector<double> offsets(edited.surfaces.size(), 0.0);
          double* number = parameter_number(edited, p);
          (p.kind == Parameter::Kind::offset ? offsets[at(p.object)] : *number) += step;
          return pull_and_length(cord.path(edited.surfaces, offsets), wraps);
        },
        1e-5);
    const VecX exact = rates(path, wraps, change_by_surface(cord.wraps, path, kPoses, wraps, p, cord.scene.surfaces));
    EXPECT_GT(truth.norm(), 1e-6) << p.name;
    const double error = (exact - truth).cwiseAbs().maxCoeff() / std::max(1.0, truth.cwiseAbs().maxCoeff());
    EXPECT_LT(error, tolerance) << p.name << "\n" << exact.transpose() << "\n" << truth.transpose();
    worst = std::max(worst, error);
    ++count;
  }
  std::printf("%d numbers, worst error %.2g\n", count, worst);
  return count;
}

Cord cord(const SurfaceDef& first, const SurfaceDef& second) {
  Cord out;
  out.from = Vec3(-0.06, -0.004, 0.003);
  out.to = Vec3(0.09, -0.002, -0.004);
  out.add(first, Vec3(0, 1, 0.2));
  out.add(second, Vec3(0, 1, -0.1));
  return out;
}

const Pose kFirst{exp_rotation(Vec3(0.3, -0.2, 0.1)), Vec3(-0.02, -0.001, 0.001)},
    kSecond{exp_rotation(Vec3(0.2, 0.1, 0.4)), Vec3(0.05, 0, -0.002)};

TEST(PathChange, BySpheresAndCylindersIsThatOfOtherRadii) {
  SurfaceDef ball = surface("ball", SurfaceDef::Shape::sphere, 1, kFirst);
  ball.radius = 0.012;
  SurfaceDef rod = surface("rod", SurfaceDef::Shape::cylinder, 2, kSecond);
  rod.radius = 0.01;
  EXPECT_EQ(expect_rates(cord(ball, rod), 1e-7), 10);
}

TEST(PathChange, ByEllipsoidsAndTorusesIsThatOfOtherRadii) {
  SurfaceDef egg = surface("egg", SurfaceDef::Shape::ellipsoid, 1, kFirst);
  egg.radii = Vec3(0.02, 0.009, 0.013);
  SurfaceDef ring = surface("ring", SurfaceDef::Shape::torus, 2, kSecond);
  ring.major_radius = 0.012;
  ring.minor_radius = 0.006;
  EXPECT_EQ(expect_rates(cord(egg, ring), 1e-7), 12);
  SurfaceDef needle = surface("needle", SurfaceDef::Shape::ellipsoid, 1, {kFirst.R, Vec3(-0.02, 0.003, 0.001)});
  needle.radii = Vec3(0.025, 0.0054, 0.0053);
  EXPECT_EQ(expect_rates(cord(needle, ring), 1e-7), 12);
}

TEST(PathChange, ByItsEndsIsThatOfMovedEnds) {
  SurfaceDef egg = surface("egg", SurfaceDef::Shape::ellipsoid, 1, kFirst);
  egg.radii = Vec3(0.02, 0.009, 0.013);
  SurfaceDef rod = surface("rod", SurfaceDef::Shape::cylinder, 2, kSecond);
  rod.radius = 0.01;
  const Cord both = cord(egg, rod);
  const LigamentPath path = both.path();
  Wraps wraps(2);
  ASSERT_TRUE(path.find_touches(kPoses, wraps));
  for (const std::size_t end : {0u, 1u})
    for (int axis = 0; axis < 3; ++axis) {
      const VecX truth = test::derivative(
          [&](double step) {
            LigamentPath moved = path;
            moved.set_point(end, path.points()[end].p + step * Vec3::Unit(axis));
            return pull_and_length(moved, wraps);
          },
          1e-5);
      const VecX exact = rates(path, wraps, change_by_point(path, kPoses, end, axis));
      EXPECT_LT((exact - truth).cwiseAbs().maxCoeff(), 1e-7 * std::max(1.0, truth.cwiseAbs().maxCoeff()));
    }
}

/// A belt round a pulley: L = p + q + R phi with legs p, q, whose squares are those of the distances less R^2.
TEST(PathChange, OfAPulleyIsTheClosedForm) {
  Cord belt;
  SurfaceDef pulley = surface("pulley", SurfaceDef::Shape::cylinder, 2, {});
  pulley.radius = 0.02;
  belt.from = Vec3(-0.05, 0.01, 0);
  belt.to = Vec3(0.04, -0.01, 0);
  belt.add(pulley, Vec3(0, 1, 0));
  const LigamentPath path = belt.path();
  Wraps wraps(1);
  ASSERT_TRUE(path.find_touches(kPoses, wraps));
  for (const Parameter& p : parameters_of(belt.scene))
    if (p.name == "pulley.radius") {
      const auto change = change_by_surface(belt.wraps, path, kPoses, wraps, p, belt.scene.surfaces);
      EXPECT_NEAR(length_rate(path, kPoses, wraps, change), wraps[0].arc.length / pulley.radius, 1e-13);
    }
}

}  // namespace
}  // namespace genu
