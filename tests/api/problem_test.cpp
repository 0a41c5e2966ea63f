// Errors with their place.
#include "genu/api/problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/knee.h"

namespace genu::api {
namespace {

using ::testing::HasSubstr;

TEST(Problem, ErrorsHaveTheirPlace) {
  const std::string text = replaced(text_of(knee_file()), "stiffness = 37200.0", "stiffness = -2");
  try {
    (void)parse(text, "bad.toml");
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_EQ(error.first().file, "bad.toml");
    EXPECT_GT(error.first().line, 0);
    EXPECT_GT(error.first().column, 0);
    EXPECT_EQ(error.first().key, "ligament.AAC.stiffness");
    EXPECT_EQ(error.first().code, "out-of-range");
  }
  EXPECT_THAT(refusal_of([] { (void)load("no/such/scene.toml"); }), HasSubstr("no/such/scene.toml"));
}

}  // namespace
}  // namespace genu::api
