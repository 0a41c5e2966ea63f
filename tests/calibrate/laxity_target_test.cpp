// Laxity tables as targets: which curves and values they hold, and what is refused, with its place.
#include "genu/calibrate/laxity_target.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

TEST(LaxityTarget, HoldsCurvesByFlexionAndLoadsOutward) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("laxity.csv",
                                        "flexion_deg,test,load_N,load_Nm,displacement_mm,displacement_deg\n"
                                        "30,drawer,100,,4,\n30,drawer,50,,2,\n30,drawer,0,,0,\n30,drawer,-50,,-3,\n"
                                        "0,rotation,,5,,12\n");
  EXPECT_TRUE(is_laxity_table(file));
  Diagnostics out;
  const auto target = read_laxity_target(file, {}, {}, out);
  ASSERT_TRUE(target) << test::messages(out);
  ASSERT_EQ(target->curves.size(), 2u);
  EXPECT_EQ(target->curves[0].kind, LaxityTest::Kind::rotation);
  EXPECT_NEAR(target->curves[1].flexion, std::numbers::pi / 6, 1e-15);
  EXPECT_EQ(target->curves[1].loads, (std::vector<double>{50, 100, -50}));  // 0 is the neutral pose
  ASSERT_EQ(target->values.size(), 4u);                                     // no displacement without load
  EXPECT_EQ(target->values[0].curve, 1u);
  EXPECT_EQ(target->values[0].load, 100);
  EXPECT_EQ(target->values[0].value, 4);
  EXPECT_EQ(target->columns[target->values[3].column], "displacement_deg");
}

TEST(LaxityTarget, RefusesRowsWithTheirPlace) {
  const test::TemporaryFolder folder;
  const auto refused = [&](const std::string& rows, const std::string& said) {
    const std::string file = folder.write("bad.csv", "flexion_deg,test,load_N,displacement_mm\n" + rows);
    Diagnostics out;
    EXPECT_FALSE(read_laxity_target(file, {}, {}, out));
    EXPECT_TRUE(test::contains(test::messages(out), said)) << test::messages(out);
    EXPECT_TRUE(test::contains(test::messages(out), "bad.csv:2")) << test::messages(out);
  };
  refused("30,push,100,4\n", "push");
  refused("30,drawer,much,4\n", "much");
  refused("30,drawer,100,far\n", "far");
  EXPECT_FALSE(is_laxity_table(folder.write("other.csv", "time_s,knee.flexion_deg\n0,1\n")));
}

}  // namespace
}  // namespace genu
