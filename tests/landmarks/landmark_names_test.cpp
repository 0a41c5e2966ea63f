#include "genu/landmarks/landmark_names.h"

#include <gtest/gtest.h>

#include "support/text.h"

namespace genu {
namespace {

std::string name_of(const std::string& said) {
  const auto found = meaning_of(said);
  return found ? found->name : "";
}

TEST(LandmarkNames, InTheSpellingsOfPeople) {
  const std::pair<const char*, std::vector<const char*>> spellings[] = {
      {"ACL femur",
       {"ACL_femur", "acl femur", "ACLFemur", "aclfemur", "femur ACL", "Femoral ACL insertion", "ACL_fem", "ACL-F",
        "ACL origin", "ACL_femur_3", "Anterior cruciate ligament, femoral attachment", "ACL femoral footprint centre"}},
      {"ACL tibia", {"ACL_tibia", "tibACL", "ACL insertion", "ACL tibial footprint", "ACL distal end"}},
      {"ACLam femur", {"ACLam femur", "AM bundle femur", "ACL_AM_fem", "anteromedial bundle of the ACL, femur"}},
      {"PCLpm tibia", {"PCLpm_tibia", "posteromedial bundle tibia", "PMB tibia"}},
      {"MCL tibia", {"MCL tibia", "sMCL_tibia", "MCLs tibia", "superficial MCL tibial attachment"}},
      {"MCLd femur", {"dMCL femur", "deep MCL femoral"}},
      {"LCL fibula",
       {"LCL fibula", "LCL_tibia", "FCL fibular head", "lateral collateral ligament fibula", "LCL insertion"}},
      {"PFL femur", {"popliteofibular ligament femur"}},
      {"pCAP tibia", {"pCAP tibia", "posterior capsule tibia"}},
      {"medial epicondyle",
       {"medial epicondyle", "Medial_Epicondyle", "MEC", "epicondyle medial", "medial epicondyle of the femur"}},
      {"lateral epicondyle", {"LateralEpicondyle", "lat epicondyle", "lateral femoral epicondyle"}},
      {"knee centre", {"KJC", "knee joint center", "KneeCenter"}},
      {"hip centre", {"HJC", "femoral head center", "hip joint centre"}},
      {"ankle centre", {"ankle centre"}}};
  for (const auto& [name, said] : spellings)
    for (const char* spelling : said) EXPECT_EQ(name_of(spelling), name) << spelling;
}

TEST(LandmarkNames, OfNothingThatIsKnown) {
  for (const char* said : {"", "F-1", "F", "1", "_", "ACL", "femur", "ACL fibula", "ACL femur tibia",
                           "medial epicondyle tibia", "left", "patellar tendon", "L", "knee"})
    EXPECT_EQ(name_of(said), "") << said;
  EXPECT_TRUE(test::contains(known_landmarks(), "LCL, PFL with femur or fibula"));
  EXPECT_TRUE(test::contains(known_landmarks(), "hip centre"));
}

TEST(LandmarkNames, SideAndBundles) {
  EXPECT_EQ(meaning_of("left ACL femur")->left, true);
  EXPECT_EQ(meaning_of("ACL_femur_R")->left, false);
  EXPECT_EQ(name_of("L_LCL_F"), "LCL femur");
  EXPECT_EQ(meaning_of("L_LCL_F")->left, true);
  EXPECT_FALSE(meaning_of("LCL_F")->left.has_value());
  EXPECT_EQ(meaning_of("ACL tibia")->bundles, (std::vector<std::string>{"ACLam", "ACLpl"}));
  EXPECT_TRUE(meaning_of("ACL femur")->femur);
  EXPECT_FALSE(meaning_of("ACL tibia")->femur);
  EXPECT_TRUE(meaning_of("LCL tibia")->fibula);
  EXPECT_FALSE(meaning_of("LCL femur")->fibula);
}

}  // namespace
}  // namespace genu
