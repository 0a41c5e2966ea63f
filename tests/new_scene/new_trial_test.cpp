#include "genu/new_scene/new_trial.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

TEST(NewTrial, WithoutAPoseTheReferenceStays) {
  Words words{{"reference", "x = 1"}};
  refer_to_balance(words, Solution());
  EXPECT_EQ(words.at("reference"), "x = 1");
  EXPECT_FALSE(words.contains("reference_note"));
}

TEST(NewTrial, ErrorsNameTheSceneAsItWillBeCalled) {
  const test::TemporaryFolder folder;
  const std::string staged = folder.write("staged.toml", "format = 1\nnonsense = 2\n");
  Diagnostics out;
  EXPECT_FALSE(try_out(staged, "knee/knee.toml", {}, true, out));
  ASSERT_TRUE(out.has_errors());
  for (const Diagnostic& d : out.items()) EXPECT_EQ(d.file, "knee/knee.toml") << d.rule;
}

}  // namespace
}  // namespace genu
