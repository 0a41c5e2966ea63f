// Diagnostics as problems of the API.
#include "genu/api/inside.h"

#include <thread>

#include <gtest/gtest.h>

namespace genu::api {
namespace {

TEST(Inside, AWarningIsNoErrorAndAnOptionHasNoDashes) {
  Diagnostics out;
  out.warning(Code::layout, "knee.toml", "looks like a left knee");
  EXPECT_NO_THROW(check(out));
  out.add(error_at({}, Code::unknown_name, "--without", "\"XYZ\"", "is no ligament"));
  try {
    check(out);
    FAIL();
  } catch (const SceneError& error) {
    ASSERT_EQ(error.problems().size(), 2u);
    EXPECT_EQ(error.first().key, "without");
    EXPECT_EQ(error.first().found, "\"XYZ\"");
    EXPECT_EQ(std::string(error.what()).find("left knee"), std::string::npos);
  }
}

TEST(Inside, AModelInUseIsCopied) {
  Ready ready;
  const auto* own = &ready.prepared;
  use(ready, [&](const Prepared& first) {
    EXPECT_EQ(&first, own);
    return 0;
  });
  const std::unique_lock<std::mutex> busy(ready.running);
  std::thread([&] {
    use(ready, [&](const Prepared& second) {
      EXPECT_NE(&second, own);
      return 0;
    });
  }).join();
}

}  // namespace
}  // namespace genu::api
