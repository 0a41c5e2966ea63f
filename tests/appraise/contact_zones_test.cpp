#include "genu/appraise/contact_zones.h"

#include <gtest/gtest.h>

#include "support/judged.h"
#include "support/meshed_scene.h"

namespace genu {
namespace {

TEST(ContactZones, PartContactsThatStayApart) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  const auto prepared = prepare(test::meshed_scene(folder), out);
  ASSERT_TRUE(prepared);
  ContactField field(prepared->model);
  const auto zones = contact_zones(*prepared, test::judged(*prepared, solve(*prepared, field, {})), 0.015);
  ASSERT_EQ(zones.size(), 2u);
  EXPECT_EQ(zones[0].name, "medial");
  EXPECT_EQ(zones[0].points_a.size(), zones[0].normals_b.size());
  for (const Vec3& p : zones[0].points_b) EXPECT_LT(p.x(), 0);
}

}  // namespace
}  // namespace genu
