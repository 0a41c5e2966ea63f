// Results as columns, and what becomes of them without their scene.
#include "genu/api/results.h"

#include <cmath>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/knee.h"
#include "genu/api/scene.h"
#include "support/temporary_folder.h"

namespace genu::api {
namespace {

using ::testing::HasSubstr;

TEST(Results, OutliveTheirSceneAndItsChanges) {
  auto knee = std::make_unique<Scene>(load(knee_file()));
  const Results found = knee->run();
  const auto column = found["knee.rotation_deg"];
  const double first = column[0], last = column[70];
  knee->set("AAC.stiffness", 1000);
  knee.reset();
  EXPECT_EQ(found["knee.rotation_deg"].data(), column.data());
  EXPECT_EQ(column[0], first);
  EXPECT_EQ(column[70], last);
}

TEST(Results, HaveWordsNumbersAndEmptyCells) {
  const Results found = load(knee_file()).run();
  EXPECT_EQ(found.rows(), 71U);
  EXPECT_TRUE(found.poses().has_words("stability"));
  EXPECT_EQ(found.poses().words("status")[3], "ok");
  EXPECT_EQ(found.poses().words("increment")[3], "3");
  EXPECT_EQ(found["increment"][3], 3);
  EXPECT_THROW((void)found["stability"], SceneError);
  try {
    (void)found["knee.rotatoin_deg"];
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean \"knee.rotation_deg\""));
    EXPECT_EQ(error.first().code, "unknown-column");
  }
  EXPECT_GT(found.events().rows(), 0U);
  EXPECT_TRUE(found.events().has_words("event"));
}

TEST(Results, CoordinatesAreThoseOfTheColumns) {
  const Results found = load(knee_file()).run();
  const std::vector<double> q = found.coordinates();
  ASSERT_EQ(q.size(), 6 * found.rows());
  EXPECT_NEAR(q[6 * 30], found["knee.flexion_deg"][30] * M_PI / 180, 1e-15);
  EXPECT_NEAR(q[6 * 30 + 5], found["knee.z_mm"][30] / 1000, 1e-15);
}

TEST(Results, StopWhenAskedAndKeepWhatIsThere) {
  int poses = 0;
  RunOptions options;
  options.progress = [&](int done, int) { poses = done; };
  options.cancelled = [&] { return poses >= 5; };
  const Results found = load(knee_file()).run(options);
  EXPECT_TRUE(found.partial());
  EXPECT_EQ(found.rows(), static_cast<std::size_t>(poses));
  EXPECT_LT(poses, 71);
}

TEST(Results, ReportNamesTheChanges) {
  const test::TemporaryFolder folder;
  Scene knee = load(knee_file());
  knee.set("AAC.stiffness", 20000);
  const std::string file = folder / "report.html";
  knee.run().report(file);
  EXPECT_THAT(text_of(file), HasSubstr("AAC.stiffness = 20000 N (37200)"));
  EXPECT_THROW(knee.run().report(folder / "no/folder.html"), SceneError);
  knee.run().report(file);  // its own page may go
  const std::string scene = folder.write("scene.toml", "the only copy");
  EXPECT_THROW(knee.run().report(scene), SceneError);
  EXPECT_EQ(text_of(scene), "the only copy");
}

}  // namespace
}  // namespace genu::api
