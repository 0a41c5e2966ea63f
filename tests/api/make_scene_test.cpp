// Scenes without a file.
#include "genu/api/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/knee.h"

namespace genu::api {
namespace {

using ::testing::HasSubstr;

TEST(MakeScene, OfAFormulaNeedsNoFile) {
  const Results found = make({}).run();
  EXPECT_EQ(found.verdict(), "solved");
  EXPECT_GT(found.rows(), 10U);
  EXPECT_THAT(refusal_of([] { (void)make({.kind = "stl"}); }), HasSubstr("is needed for a scene of meshes"));
}

}  // namespace
}  // namespace genu::api
