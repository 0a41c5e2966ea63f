// Loads held while the knee bends.
#include "genu/study/laxity_solve.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "genu/study/envelope_table.h"
#include "genu/study/laxity.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"
#include "support/wheel_knee.h"

namespace genu {
namespace {

LaxityChoice held_loads(const std::vector<double>& degrees) {
  LaxityChoice choice;
  choice.envelope = true;
  choice.tests = {{LaxityTest::Kind::drawer, 20}, {LaxityTest::Kind::rotation, 0.2}};
  choice.increments = 4;
  for (const double angle : degrees) choice.flexions.push_back(units::kDegree * angle);
  return choice;
}

TEST(LaxityEnvelope, AHeldLoadEndsWhereTheSameLoadPutOnThereEnds) {
  const test::TemporaryFolder folder;
  const LaxityChoice choice = held_loads({20, 0, 7});
  LaxityResult result;
  Diagnostics out;
  ASSERT_EQ(run_laxity(folder.write("scene.toml", test::wheel_knee()), folder / "out", choice, out, result), kExitOk)
      << test::messages(out);
  const LaxityOfScene& s = result.scenes.at(0);
  ASSERT_EQ(s.envelope.size(), 5u) << "without load, two tests each way";
  double worst = 0, least = 1;
  for (const EnvelopePath& path : s.envelope) {
    ASSERT_EQ(path.rows.size(), 12u) << "0, 1.75, ..., 7, 8.86, ..., 20 deg";
    EXPECT_TRUE(path.ended.empty()) << path.ended;
    for (std::size_t k = 1; k < path.rows.size(); ++k)
      EXPECT_GT(path.rows[k].flexion, path.rows[k - 1].flexion) << "angles are taken in order";
    for (const LaxityAngle& angle : s.angles) {
      const LaxityRow* held = path.at(angle.flexion);
      ASSERT_TRUE(held) << angle.flexion;
      if (path.held == 0) {
        worst = std::max(worst, std::abs(held->motion.anterior - angle.neutral.motion.anterior));
        continue;
      }
      for (const LaxityCurve& curve : angle.curves) {
        if (curve.test.kind != path.test.kind) continue;
        const LaxityRow* put_on = curve.at(path.held);
        ASSERT_TRUE(put_on);
        worst =
            std::max(worst, std::abs(path.test.displacement(held->motion) - path.test.displacement(put_on->motion)));
        least = std::min(least,
                         std::abs(path.test.displacement(held->motion) - path.test.displacement(angle.neutral.motion)));
      }
    }
  }
  std::printf("held and put on: %.2g m or rad apart; smallest displacement %.2g\n", worst, least);
  EXPECT_LT(worst, 1e-10);
  EXPECT_GT(least, 1e-5);
  EXPECT_EQ(result.verdict.size(), 1u) << result.verdict.back();
  EXPECT_TRUE(test::contains(result.text, "20 N held while the knee bends")) << result.text;
  for (const char* file : {"envelope.csv", "envelope-drawer.svg", "envelope-rotation.svg"})
    EXPECT_TRUE(std::filesystem::exists(folder / (std::string("out/") + file))) << file;
  const ResultTable table = envelope_rows(result.scenes);
  ASSERT_EQ(table.rows(), 60u);
  EXPECT_TRUE(std::isnan(table.number(0, "displacement_mm"))) << "the path without load";
  EXPECT_NEAR(table.number(12, "displacement_mm"),
              1e3 * (s.envelope[1].rows[0].pose.motion.anterior - s.envelope[0].rows[0].pose.motion.anterior), 1e-12);
}

TEST(LaxityEnvelope, APathThatEndsSaysWhere) {
  const std::string text = test::with_first(test::wheel_knee(), "shape = \"plane\"\n",
                                            "shape = \"plane\"\npatch = { x = [-0.2, 3], y = [-20, 20] }\n");
  const test::TemporaryFolder folder;
  LaxityResult result;
  Diagnostics out;
  LaxityChoice choice = held_loads({0, 20});
  choice.tests = {{LaxityTest::Kind::drawer, 50}};
  EXPECT_EQ(run_laxity(folder.write("scene.toml", text), {}, choice, out, result), kExitIncomplete)
      << test::messages(out);
  int ended = 0;
  const std::vector<std::string> notes = envelope_notes(result.scenes.at(0), ended);
  ASSERT_GT(ended, 0);
  EXPECT_TRUE(test::contains(notes.at(0), " deg: ")) << notes.at(0);
  EXPECT_TRUE(test::contains(result.verdict.at(0), "of envelopes end")) << result.verdict.at(0);
}

TEST(LaxityEnvelope, OneAngleIsNoMotion) {
  const test::TemporaryFolder folder;
  LaxityResult result;
  Diagnostics out;
  EXPECT_EQ(run_laxity(folder.write("scene.toml", test::wheel_knee()), {}, held_loads({10, 10}), out, result),
            kExitRefused);
  EXPECT_TRUE(test::contains(test::messages(out), "--envelope")) << test::messages(out);
}

}  // namespace
}  // namespace genu
