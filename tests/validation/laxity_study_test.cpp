// The sentences of meshes/wismans1980/SOURCE.md, that its tables are those of this build, and the balance of every pose
// by a sum of its own.
#include "studies/laxity_study.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/assemble/fit_mesh.h"
#include "genu/assemble/surface_fits.h"
#include "genu/scene/reader.h"
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
  ASSERT_EQ(study().twists.size(), 8u);
  EXPECT_TRUE(study().all_stable);
  EXPECT_EQ(study().poses, 677);
  double smallest = INFINITY, of_drawers = INFINITY;
  for (const auto* tests : {&study().drawers, &study().twists})
    for (const LaxityTest& t : *tests) {
      EXPECT_EQ(t.load.size(), 41u);
      for (const auto* forces : {&t.medial, &t.lateral})
        smallest = std::min(smallest, *std::min_element(forces->begin(), forces->end()));
      if (tests == &study().drawers) of_drawers = smallest;
    }
  EXPECT_GT(of_drawers, 97);
  EXPECT_GT(smallest, 0);
  fmt::print("  smallest contact force {:.1f} N, {:.1f} N in the drawers\n", smallest, of_drawers);
}

/// The paper's model has one contact a side. Here the plateaus' eminences give some poses a third or fourth.
TEST(LaxityStudy, MostPosesHaveTwoContactPointsAndSomeMore) {
  const auto& of = study().poses_of;
  ASSERT_EQ(of.size(), 5u);
  EXPECT_EQ(of[0] + of[1], 0);
  EXPECT_GT(of[2], 0.65 * study().poses);
  for (const LaxityTest& d : study().drawers)
    if (d.flexion < 1 || d.flexion > 70) {
      EXPECT_EQ(*std::max_element(d.contacts.begin(), d.contacts.end()), 2) << d.flexion;
    }
}

TEST(LaxityStudy, TheTibiaGivesWayForthAndBackMostAtTwentyDegrees) {
  ASSERT_EQ(study().drawers.size(), 8u);
  double most = 0, at = 0;
  for (const LaxityTest& d : study().drawers) {
    const double forward = d.displacement_at(100), backward = -d.displacement_at(-100);
    EXPECT_GE(forward, 0.89) << d.flexion;
    EXPECT_LE(forward, 2.32) << d.flexion;
    EXPECT_GE(backward, 1.10) << d.flexion;
    EXPECT_LE(backward, 2.58) << d.flexion;
    if (forward + backward > most) most = forward + backward, at = d.flexion;
  }
  EXPECT_NEAR(at, 20, 1e-6);
  EXPECT_NEAR(most, 4.87, 0.02);
}

TEST(LaxityStudy, TheTibiaTurnsInwardMoreFreelyThanOutwardAndMostInMidFlexion) {
  ASSERT_EQ(study().twists.size(), 8u);
  double most = 0, at = 0;
  for (const LaxityTest& t : study().twists) {
    const double inward = t.rotation_at(2), outward = -t.rotation_at(-2);
    EXPECT_GT(inward, outward) << t.flexion;
    EXPECT_GT(outward, 6) << t.flexion;
    EXPECT_LT(inward, 23) << t.flexion;
    if (inward + outward > most) most = inward + outward, at = t.flexion;
  }
  EXPECT_NEAR(at, 45, 1e-6);
  EXPECT_NEAR(most, 40.3, 0.2);
}

TEST(LaxityStudy, NothingHasHysteresis) {
  double worst = 0;
  for (const auto* tests : {&study().drawers, &study().twists})
    for (const LaxityTest& t : *tests) worst = std::max(worst, t.hysteresis());
  for (const LaxityTest& d : study().drawers) EXPECT_GT(d.stiffness_at(0), 0) << d.flexion;
  EXPECT_LT(worst, 1e-8);
  fmt::print("  hysteresis {:.1e} mm, deg\n", worst);
}

TEST(LaxityStudy, TheTablesInTheFolderAreThoseOfThisBuild) {
  test::expect_same_files(kWismansFolder, laxity_files(study()));
}

/// The polynomials of the scene are those that `genu fit` makes of the points in the folder.
TEST(LaxityStudy, ThePolynomialsAreFittedToThePointsInTheFolder) {
  Diagnostics out;
  const auto scene = read_scene(kWismansFolder + "/scene.toml", out);
  ASSERT_TRUE(scene);
  std::size_t compared = 0;
  for (const std::string body : {"femur", "tibia"}) {
    FitMeshRequest request;
    request.file = kWismansFolder + "/points-" + body + ".ply";
    request.file_unit = 1e-3;
    request.body = body;
    request.degree = 5;
    const std::vector<NamedFit> fits = fit_mesh(request, out);
    ASSERT_EQ(fits.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      const SurfaceDef fitted = surface_def(fits[k]);
      const std::string name = body + (k == 0 ? "_medial" : "_lateral");
      const auto def = std::find_if(scene->surfaces.begin(), scene->surfaces.end(),
                                    [&](const SurfaceDef& s) { return s.name == name; });
      ASSERT_NE(def, scene->surfaces.end());
      EXPECT_LT(fits[k].fit.residual.rms, 1.5e-4) << "m, of which 1e-4 is noise";
      EXPECT_GT(fits[k].fit.residual.count, 280);
      ASSERT_EQ(def->terms.size(), fitted.terms.size());
      for (std::size_t t = 0; t < fitted.terms.size(); ++t, ++compared)
        EXPECT_NEAR(def->terms[t].c, fitted.terms[t].c, 1e-9 * (1e-6 + std::abs(fitted.terms[t].c)))
            << name << " " << t;
    }
  }
  EXPECT_EQ(compared, 4u * 21u);
}

// ---- balance by an independent sum: from the table of results and the scene's numbers alone ----------------------

Vec3 vector(const ResultTable& t, std::size_t row, const std::string& name) {
  return 1e-3 * Vec3(t.number(row, name + ".x_mm"), t.number(row, name + ".y_mm"), t.number(row, name + ".z_mm"));
}

/// The plateau's upward normal at a point, from the polynomial's own derivatives.
Vec3 plateau_normal(const SurfaceDef& plateau, const Vec3& p) {
  const Vec3 own = plateau.placement.R.transpose() * (p - plateau.placement.p);
  const double x = own.x(), y = own.y();
  double zx = 0, zy = 0;
  for (const auto& t : plateau.terms) {
    if (t.i > 0) zx += t.c * t.i * std::pow(x, t.i - 1) * std::pow(y, t.j);
    if (t.j > 0) zy += t.c * t.j * std::pow(x, t.i) * std::pow(y, t.j - 1);
  }
  return plateau.placement.R * Vec3(-zx, -zy, 1).normalized();
}

struct Balance {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  ///< on the femur, about its origin, in the tibia's axes
};

Balance balance_at(const SolvedScene& solved, std::size_t row) {
  const PlacedScene& scene = solved.prepared.scene;
  const ResultTable& t = solved.solution.poses;
  const auto angle = [&](const char* name) { return t.number(row, std::string("knee.") + name + "_deg") * M_PI / 180; };
  const Mat3 R =
      (Eigen::AngleAxisd(-angle("rotation"), Vec3::UnitY()) * Eigen::AngleAxisd(-angle("adduction"), Vec3::UnitX()) *
       Eigen::AngleAxisd(angle("flexion"), Vec3::UnitZ()))
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
    // Several contact points of a pair have columns of their own.
    bool several = false;
    const auto touch = [&](const std::string& contact) {
      const Vec3 p = vector(t, row, contact + ".tibia_" + side);
      add(t.number(row, contact + ".force_N") * plateau_normal(*plateau, p), p);
    };
    for (int k = 1; t.has_column(fmt::format("{}.{}.force_N", side, k)); ++k)
      if (t.number(row, fmt::format("{}.{}.force_N", side, k)) > 0)
        several = true, touch(fmt::format("{}.{}", side, k));
    if (!several) touch(side);
  }
  for (std::size_t k = 0; k < scene.loads.size(); ++k) {
    const double factor = solved.solution.records[row].point.target.load_factors[k];
    add(factor * scene.loads[k].force, origin);
    sum.moment += factor * scene.loads[k].moment;
  }
  // What holds flexion turns about neither of the two other axes: it lies along their cross product, and its part along
  // the femur's own z is the reaction.
  const Vec3 floating = Eigen::AngleAxisd(-angle("rotation"), Vec3::UnitY()) * Vec3::UnitX();
  const Vec3 along = floating.cross(Vec3::UnitY());
  sum.moment += t.number(row, "knee.flexion.reaction_Nm") / along.dot(R.col(2)) * along;
  return sum;
}

TEST(LaxityStudy, EveryPoseBalancesByAnIndependentSum) {
  Diagnostics out;
  const auto solved = solve_scene(kWismansFolder + "/scene.toml", out);
  ASSERT_TRUE(solved);
  const ResultTable& t = solved->solution.poses;
  ASSERT_EQ(t.rows(), 677u);
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
