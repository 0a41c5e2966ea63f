// A new scene that the user stops while it is tried out and tested.
#include "genu/new_scene/new_settling.h"

#include <atomic>
#include <filesystem>

#include <gtest/gtest.h>

#include "genu/new_scene/new_scene.h"
#include "support/drawn_knee.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

TEST(NewSettling, StoppedAnywhereNothingIsWritten) {
  const test::TemporaryFolder folder;
  NewScene asked = test::drawn_knee_in(folder / "knee");
  std::atomic<int> calls = 0;
  asked.cancelled = [&] { return ++calls < 0; };
  Diagnostics out;
  ASSERT_TRUE(write_new_scene(asked, out)) << test::messages(out);
  const int all = calls;
  std::filesystem::remove_all(folder / "knee");
  for (const double part : {0.02, 0.7, 0.95}) {  // among the trials, and twice among the tests of laxity
    calls = 0;
    asked.cancelled = [&] { return ++calls > part * all; };
    Diagnostics stopped;
    EXPECT_FALSE(write_new_scene(asked, stopped)) << part;
    EXPECT_TRUE(test::contains(test::messages(stopped), "nothing is written")) << part << test::messages(stopped);
    EXPECT_FALSE(std::filesystem::exists(folder / "knee")) << part;
  }
}

}  // namespace
}  // namespace genu
