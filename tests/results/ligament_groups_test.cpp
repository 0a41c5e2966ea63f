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

}  // namespace
}  // namespace genu
