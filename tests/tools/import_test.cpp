// genu import, run as a user runs it.
#include <gtest/gtest.h>

#include "support/places.h"
#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

TEST(CliImport, SaysWhatBecameOfEachKindOfElement) {
  const TemporaryFolder folder;
  const std::string model = genu::test::source_folder() + "/tests/osim/model/leg.osim";
  const std::string command = "import " + model + " --joints 'knee_r, ankle_r' --out " + (folder / "leg");
  const Outcome made = genu(command);
  EXPECT_EQ(made.exit_code, 0) << made.err;
  for (const char* words :
       {"joints      knee_r, ankle_r", "left out    1 SomethingNew (novelty): WARNING", "genu check "})
    EXPECT_TRUE(contains(made.out, words)) << made.out;
  EXPECT_EQ(genu("check " + (folder / "leg/scene.toml")).exit_code, 0);
  const std::string before = read_file(folder / "leg/scene.toml");
  EXPECT_EQ(genu(command).exit_code, 2);  // nothing is replaced
  EXPECT_EQ(read_file(folder / "leg/scene.toml"), before);
}

TEST(CliImport, RefusesWithThePlace) {
  const TemporaryFolder folder;
  std::string text = read_file(genu::test::source_folder() + "/tests/osim/model/leg.osim");
  text.replace(text.find("<mass>3"), 7, "<mass>x");
  const std::string model = folder.write("leg.osim", text);
  const Outcome refused = genu("import " + model + " --out " + (folder / "leg"));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "leg.osim:")) << refused.err;
  EXPECT_TRUE(contains(refused.err, "Body tibia_r.mass = x: \"x\" is no finite number")) << refused.err;
  EXPECT_TRUE(contains(refused.err, "what to do: correct the model there")) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "leg"));
  EXPECT_EQ(genu("import " + model + " --row 2 --out " + (folder / "leg")).exit_code, 2);
  EXPECT_EQ(genu("import " + model + " --out ''").exit_code, 2);
}

}  // namespace
}  // namespace genu::test
