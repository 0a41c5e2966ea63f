// A scene in memory: the same bytes as a file with the change, copies in threads.
#include "genu/api/scene.h"

#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/knee.h"

namespace genu::api {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(SceneInside, GivesTheBytesOfAFileWithTheChangedNumber) {
  Scene knee = load(knee_file());
  const std::string before = csv(knee);
  const std::string value = "37200.0";
  knee.set("ligament.AAC.stiffness", 0.5 * knee.value("AAC.stiffness"));
  EXPECT_EQ(csv(knee), csv(parse(replaced(text_of(knee_file()), value, "18600.0"), knee_file())));
  EXPECT_NE(csv(knee), before);
  EXPECT_THAT(knee.changes(), ElementsAre("AAC.stiffness = 18600 N (37200)"));
  knee.set("AAC.stiffness", 37200);
  EXPECT_EQ(csv(knee), before);
  EXPECT_TRUE(knee.changes().empty());
}

TEST(SceneInside, GivesThoseOfAFileWithAnotherPointOrAnotherSurface) {
  Scene knee = load(knee_file());
  knee.set("AAC.from.x", 12.5);
  const std::string moved = replaced(text_of(knee_file()), "12.25", "12.5");
  EXPECT_EQ(csv(knee), csv(parse(moved, knee_file())));
  knee.set("femur_medial.minor_radius", 5.25);
  EXPECT_EQ(csv(knee), csv(parse(replaced(moved, "minor_radius = 5", "minor_radius = 5.25"), knee_file())));
}

TEST(SceneInside, OfCartilageGivesThoseOfAFileWithTheChange) {
  const std::string file = genu::test::source_folder() + "/meshes/lenhart_polynomial/scene-cells.toml";
  const std::string text = replaced(text_of(file), "increments = 9", "increments = 1");
  Scene knee = parse(text, file);
  const std::string before = csv(knee);
  knee.set("medial.modulus", 8);  // MPa
  const std::string softer = replaced(text, "modulus = 10", "modulus = 8");
  EXPECT_EQ(csv(knee), csv(parse(softer, file)));
  knee.set("MCLd1.stiffness", 250);
  EXPECT_EQ(csv(knee), csv(parse(replaced(softer, "stiffness = 500", "stiffness = 250"), file)));
  EXPECT_NE(csv(knee), before);
  EXPECT_THAT(refusal_of([&] { knee.set("*.poisson", 0.5); }), HasSubstr("must be >= 0 and < 0.5"));
}

TEST(SceneInside, CopiesAreSolvedSideBySideToTheSameBytes) {
  Scene knee = load(knee_file());
  const std::string before = csv(knee);
  Scene other = knee;
  other.set("PAC.stiffness", 20000);
  const std::string changed = csv(other);
  std::vector<std::string> found(8);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < found.size(); ++k)
    threads.emplace_back([&, k, copy = k % 2 == 0 ? knee : other] { found[k] = csv(copy); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k], k % 2 == 0 ? before : changed) << k;
}

}  // namespace
}  // namespace genu::api
