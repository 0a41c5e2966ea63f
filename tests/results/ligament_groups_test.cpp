#include "genu/results/ligament_groups.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(LigamentGroups, AreFibresWithOneName) {
  Scene scene;
  for (const char* name : {"ACL1", "MCL", "ACL2", "7", "2MCL10"}) {
    LigamentDef l;
    l.name = name;
    scene.ligaments.push_back(l);
  }
  const auto groups = ligament_groups(scene);
  ASSERT_EQ(groups.size(), 4u);
  EXPECT_EQ(groups[0].name, "ACL");
  EXPECT_EQ(groups[0].members, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(groups[1].name, "MCL");
  EXPECT_EQ(groups[2].name, "7");  // nothing but a number is a name
  EXPECT_EQ(groups[3].name, "2MCL");
  EXPECT_TRUE(ligament_groups(SceneTables{}).empty());
}

/// A bundle holds what the scene says, whatever its fibres are called; fibres that it leaves out keep their own names.
TEST(LigamentGroups, BundlesOfTheSceneComeFirst) {
  Scene scene;
  for (const char* name : {"a1", "a2", "front", "a3", "solo"}) {
    LigamentDef l;
    l.name = name;
    scene.ligaments.push_back(l);
  }
  scene.bundles = {{"off", {"gone"}, {}, {}}, {"ACL", {"a1", "front"}, {0, 2}, {}}};
  const auto groups = ligament_groups(scene);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].name, "ACL");
  EXPECT_TRUE(groups[0].bundle);
  EXPECT_EQ(groups[0].members, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(groups[1].name, "a");
  EXPECT_FALSE(groups[1].bundle);
  EXPECT_EQ(groups[1].members, (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(groups[2].name, "solo");
  EXPECT_EQ(force_column(scene, groups[0]), "ACL.force_N");
  EXPECT_EQ(force_column(scene, groups[1]), "");
  EXPECT_EQ(force_column(scene, groups[2]), "solo.force_N");
}

}  // namespace
}  // namespace genu
