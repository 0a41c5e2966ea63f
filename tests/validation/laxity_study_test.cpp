// The sentences of meshes/wismans1980/SOURCE.md, that its tables are those of this build, and the balance of every pose
// by a sum of its own.
#include "studies/laxity_study.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/places.h"
#include "validation/study_files.h"

namespace genu::studies {
namespace {

const std::string kWismansFolder = genu::test::source_folder() + "/meshes/wismans1980";

const LaxityStudy& study() {
  static const LaxityStudy solved = [] {
    Diagnostics out;
    return solve_laxity(kWismansFolder + "/scene.toml", out).value_or(LaxityStudy{});
  }();
  return solved;
}

TEST(LaxityStudy, EveryPoseIsStableWithBothContacts) {
  ASSERT_EQ(study().drawers.size(), 8u);
  EXPECT_TRUE(study().all_stable);
  EXPECT_EQ(study().fewest_contacts, 2);
  double smallest = INFINITY;
  for (const Drawer& d : study().drawers) {
    EXPECT_EQ(d.force.size(), 41u);
    for (const auto* forces : {&d.medial, &d.lateral})
      smallest = std::min(smallest, *std::min_element(forces->begin(), forces->end()));
  }
  EXPECT_GT(smallest, 58);
  fmt::print("  smallest contact force {:.1f} N\n", smallest);
}

TEST(LaxityStudy, TheTibiaGivesWayForthAndBackAndMoreSoWithFlexion) {
  ASSERT_EQ(study().drawers.size(), 8u);
  double before = 0;
  for (const Drawer& d : study().drawers) {
    const double forward = d.at(100), backward = -d.at(-100);
    EXPECT_GE(forward, 1.99);
    EXPECT_LE(forward, 5.83);
    EXPECT_GE(backward, 3.38);
    EXPECT_LE(backward, 8.11);
    EXPECT_LT(forward, backward);
    EXPECT_GT(forward + backward, before);
    before = forward + backward;
  }
  EXPECT_NEAR(study().drawers.front().at(100) - study().drawers.front().at(-100), 5.8, 0.05);
  EXPECT_NEAR(before, 13.9, 0.05);
}

TEST(LaxityStudy, TheDrawerStiffensAndHasNoHysteresis) {
  ASSERT_EQ(study().drawers.size(), 8u);
  double least = INFINITY, most = 0, hysteresis = 0;
  for (const Drawer& d : study().drawers) {
    for (const double force : {90.0, -90.0}) {
      const double ratio = d.stiffness_at(force) / d.stiffness_at(0);
      least = std::min(least, ratio);
      most = std::max(most, ratio);
    }
    EXPECT_GT(d.stiffness_at(0), 0);
    hysteresis = std::max(hysteresis, d.hysteresis());
  }
  EXPECT_GT(least, 1.2);
  EXPECT_LT(most, 11.5);
  EXPECT_LT(hysteresis, 1e-9);
  fmt::print("  stiffness at 90 N / at 0 N: {:.2f} to {:.2f}; hysteresis {:.1e} mm\n", least, most, hysteresis);
}

TEST(LaxityStudy, TheTablesInTheFolderAreThoseOfThisBuild) {
  test::expect_same_files(kWismansFolder, laxity_files(study()));
}

// ---- balance by an independent sum: from the table of results and the scene's numbers alone ----------------------

Vec3 vector(const ResultTable& t, std::size_t row, const std::string& name) {
  return 1e-3 * Vec3(t.number(row, name + ".x_mm"), t.number(row, name + ".y_mm"), t.number(row, name + ".z_mm"));
}

/// The plateau's upward normal at a point, from the polynomial's own derivatives.
Vec3 plateau_normal(const SurfaceDef& plateau, const Vec3& p) {
  const double x = p.x() - plateau.placement.p.x(), y = p.y() - plateau.placement.p.y();
  double zx = 0, zy = 0;
  for (const auto& t : plateau.terms) {
    if (t.i > 0) zx += t.c * t.i * std::pow(x, t.i - 1) * std::pow(y, t.j);
    if (t.j > 0) zy += t.c * t.j * std::pow(x, t.i) * std::pow(y, t.j - 1);
  }
  return Vec3(-zx, -zy, 1).normalized();
}

struct Balance {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  ///< on the femur, about its origin, in the tibia's axes
};

Balance balance_at(const SolvedScene& solved, std::size_t row) {
  const PlacedScene& scene = solved.prepared.scene;
  const ResultTable& t = solved.solution.poses;
  const auto angle = [&](const char* name) { return t.number(row, std::string("knee.") + name + "_deg") * M_PI / 180; };
  const Mat3 R =
      (Eigen::AngleAxisd(angle("rotation"), Vec3::UnitZ()) * Eigen::AngleAxisd(angle("adduction"), Vec3::UnitY()) *
       Eigen::AngleAxisd(angle("flexion"), Vec3::UnitX()))
          .toRotationMatrix();
  const Vec3 origin = vector(t, row, "knee");
  Balance sum;
  const auto add = [&](const Vec3& force, const Vec3& point) {
    sum.force += force;
    sum.moment += (point - origin).cross(force);
  };
  for (const LigamentDef& l : scene.ligaments) {
    const Vec3 from = origin + R * l.from.point, pull = l.to.point - from;
    const double strain = t.number(row, l.name + ".strain");
    if (strain > 0) add(l.number("stiffness") * strain * strain * pull.normalized(), from);
  }
  for (const std::string side : {"medial", "lateral"}) {
    const auto plateau = std::find_if(scene.surfaces.begin(), scene.surfaces.end(),
                                      [&](const SurfaceDef& s) { return s.name == "tibia_" + side; });
    const Vec3 p = vector(t, row, side + ".tibia_" + side);
    add(t.number(row, side + ".force_N") * plateau_normal(*plateau, p), p);
  }
  const auto& records = solved.solution.records;
  add(records[row].point.target.load_factors[0] * Vec3(0, -100, 0), origin);
  // What holds flexion turns about neither of the two other axes: it lies along their cross product, and its part along
  // the femur's own x is the reaction.
  const Vec3 floating = Eigen::AngleAxisd(angle("rotation"), Vec3::UnitZ()) * Vec3::UnitY();
  const Vec3 along = floating.cross(Vec3::UnitZ());
  sum.moment += t.number(row, "knee.flexion.reaction_Nm") / along.dot(R.col(0)) * along;
  return sum;
}

TEST(LaxityStudy, EveryPoseBalancesByAnIndependentSum) {
  Diagnostics out;
  const auto solved = solve_scene(kWismansFolder + "/scene.toml", out);
  ASSERT_TRUE(solved);
  const ResultTable& t = solved->solution.poses;
  ASSERT_EQ(t.rows(), 357u);
  double force = 0, moment = 0;
  for (std::size_t row = 0; row < t.rows(); ++row) {
    const Balance b = balance_at(*solved, row);
    force = std::max(force, b.force.norm());
    moment = std::max(moment, b.moment.norm());
  }
  EXPECT_LT(force, 1e-8);
  EXPECT_LT(moment, 1e-9);
  fmt::print("  left over: {:.1e} N, {:.1e} N m\n", force, moment);
}

}  // namespace
}  // namespace genu::studies
