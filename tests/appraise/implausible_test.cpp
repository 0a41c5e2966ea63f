// Each limit of [plausible], just above and just below the largest number of its kind.
#include "genu/appraise/implausible.h"

#include <algorithm>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/scenes.h"

namespace genu {
namespace {

using ::testing::HasSubstr;

class Implausible : public ::testing::Test {
 protected:
  Implausible() {
    Diagnostics out;
    scene_ = *read_scene(test::dortmans_file(), out);
    scene_.plausible = {1e9, 1e9, 1e9, 1e15, 1e9, 1e9};
    first_ = test::solved(scene_);
  }
  /// The largest number in columns that end so, of contacts or ligaments.
  double largest(const std::string& ending) const {
    double most = 0;
    for (const std::string& column : first_.poses.columns())
      if (column.ends_with(ending))
        for (std::size_t row = 0; row < first_.poses.rows(); ++row)
          most = std::max(most, first_.poses.number(row, column));
    return most;
  }
  std::string headline(double PlausibleDef::*member, double limit) {
    scene_.plausible.*member = limit;
    const RunSummary s = test::solved(scene_).summary;
    EXPECT_EQ(s.exit_code == kExitDoubtful, s.verdict[0].starts_with("Solved, but"));
    return s.verdict[0];
  }

  Scene scene_;
  Solution first_;
};

TEST_F(Implausible, NothingWithinTheLimits) { EXPECT_EQ(first_.summary.exit_code, kExitOk); }

TEST_F(Implausible, StrainOfALigament) {
  double most = 0;
  for (const LigamentDef& l : scene_.ligaments)
    for (std::size_t row = 0; row < first_.poses.rows(); ++row)
      if (first_.poses.number(row, l.name + ".force_N") > 0)
        most = std::max(most, first_.poses.number(row, l.name + ".strain"));
  ASSERT_GT(most, 0);
  EXPECT_THAT(headline(&PlausibleDef::strain, 1.001 * most), HasSubstr("Every pose is solved"));
  EXPECT_THAT(headline(&PlausibleDef::strain, 0.999 * most), HasSubstr("Solved, but the strain of "));
}

TEST_F(Implausible, RotationBesideWhatIsPrescribed) {
  const auto change = [&](const std::string& column) {
    double most = 0;
    for (std::size_t row = 0; row < first_.poses.rows(); ++row)
      most = std::max(most, std::abs(first_.poses.number(row, column) - first_.poses.number(0, column)));
    return most * M_PI / 180;
  };
  const double most = std::max(change("knee.adduction_deg"), change("knee.rotation_deg"));
  EXPECT_LT(most, change("knee.flexion_deg"));
  EXPECT_THAT(headline(&PlausibleDef::rotation, 1.001 * most), HasSubstr("Every pose is solved"));
  EXPECT_THAT(headline(&PlausibleDef::rotation, 0.999 * most),
              HasSubstr(" deg from where it began at knee.flexion = "));
}

TEST_F(Implausible, ForceOfALigament) {
  double most = 0;
  for (const LigamentDef& l : scene_.ligaments) most = std::max(most, largest(l.name + ".force_N"));
  EXPECT_THAT(headline(&PlausibleDef::ligament_force, 1.001 * most), HasSubstr("Every pose is solved"));
  EXPECT_THAT(headline(&PlausibleDef::ligament_force, 0.999 * most), HasSubstr("Solved, but the force of "));
}

TEST_F(Implausible, TravelOfAContactIsThatOfTheSurfaceItMovesLessOn) {
  for (JointDef& joint : scene_.joints) joint.grood_suntay.reset();
  double most = 0;
  for (const ContactDef& contact : scene_.contacts)
    for (std::size_t row = 0; row < first_.records.size(); ++row) {
      double least = std::numeric_limits<double>::infinity();
      for (const bool second : {false, true}) {
        const auto at_row = [&](std::size_t r) {
          for (const ActiveContact& c : first_.records[r].point.pose.state.contacts)
            if (scene_.contacts[static_cast<std::size_t>(c.pair)].name == contact.name)
              return second ? c.geometry.b.p : c.geometry.a.p;
          ADD_FAILURE() << contact.name;
          return Vec3(Vec3::Zero());
        };
        least = std::min(least, (at_row(row) - at_row(0)).norm());
      }
      most = std::max(most, least);
    }
  EXPECT_THAT(headline(&PlausibleDef::travel, 1.001 * most), HasSubstr("Every pose is solved"));
  EXPECT_THAT(headline(&PlausibleDef::travel, 0.999 * most), HasSubstr("mm from where it began, on both surfaces"));
}

/// With the femur's origin moved in the scene itself: where it moves least decides.
TEST_F(Implausible, TranslationsOfAKnee) {
  const auto farthest = [](const ResultTable& poses) {
    const auto at_row = [&](std::size_t row) {
      return Vec3(poses.number(row, "knee.gs.lateral_mm"), poses.number(row, "knee.gs.anterior_mm"),
                  poses.number(row, "knee.gs.distraction_mm"));
    };
    double most = 0;
    for (std::size_t row = 0; row < poses.rows(); ++row) most = std::max(most, (at_row(row) - at_row(0)).norm() / 1000);
    return most;
  };
  double least = std::numeric_limits<double>::infinity();
  for (const double height : {0.0, 0.005, 0.01, 0.015, 0.02, 0.025, 0.03}) {
    Scene raised = scene_;
    GroodSuntayDef::Bone& femur = raised.joints[0].grood_suntay->femur;
    femur.origin += height * femur.proximal;
    least = std::min(least, farthest(test::solved(raised).poses));
  }
  ASSERT_GT(least, 0.003);
  for (const double factor : {0.98, 1.02}) {  // the contacts travel farther; adduction and rotation are small
    scene_.plausible.travel = factor * least;
    const auto said = ::testing::Contains(HasSubstr("by Grood and Suntay's translations, at knee.flexion = "));
    const std::vector<std::string> verdict = test::solved(scene_).summary.verdict;
    if (factor < 1)
      EXPECT_THAT(verdict, said);
    else
      EXPECT_THAT(verdict, ::testing::Not(said));
  }
}

/// Where the origins are far away, a knee that flexes moves them by much.
TEST_F(Implausible, TranslationsOfFarOriginsSayNothing) {
  for (JointDef& joint : scene_.joints) {
    joint.grood_suntay->femur.origin += Vec3(0, 0, 1);
    joint.grood_suntay->tibia.origin += Vec3(0, 0, 1);
  }
  EXPECT_THAT(headline(&PlausibleDef::travel, 0.03), HasSubstr("Every pose is solved"));
}

TEST_F(Implausible, ForceOfAContactOverTheLoads) {
  EXPECT_THAT(headline(&PlausibleDef::contact_force, 1e-9), HasSubstr("Every pose is solved")) << "there are no loads";
  Diagnostics out;
  scene_ = *read_scene(test::source_folder() + "/meshes/lenhart_polynomial/scene.toml", out);
  EXPECT_THAT(headline(&PlausibleDef::contact_force, 1e-3), HasSubstr("times all loads at knee.flexion = "));
  EXPECT_THAT(headline(&PlausibleDef::contact_force, 1e3), HasSubstr("Every pose is solved"));
}

/// The measured limits of common sense leave every shipped path alone.
TEST_F(Implausible, DefaultsLetTheKneePass) {
  scene_.plausible = {};
  EXPECT_EQ(test::solved(scene_).summary.exit_code, kExitOk);
}

}  // namespace
}  // namespace genu
