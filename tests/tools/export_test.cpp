// genu export, run as a user runs it.
#include <gtest/gtest.h>

#include "support/places.h"
#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

TEST(CliExport, WritesAModelThatImportReads) {
  const TemporaryFolder folder;
  const std::string scene = source_folder() + "/meshes/joints/total-knee.toml";
  const std::string command = "export " + scene + " --osim --out " + (folder / "knee");
  const Outcome made = genu(command);
  EXPECT_EQ(made.exit_code, 0) << made.err;
  for (const char* words : {"written ", "forces.sto", "left out  1 load (weight): WARNING", "--joints knee,pf"})
    EXPECT_TRUE(contains(made.out, words)) << made.out;
  EXPECT_TRUE(contains(read_file(folder / "knee/export.csv"), "ligament,LCL,kept,/forceset/LCL,"));
  const Outcome back = genu("import " + (folder / "knee/model.osim") + " --joints knee,pf --forces " +
                            (folder / "knee/forces.sto") + " --out " + (folder / "again"));
  EXPECT_EQ(back.exit_code, 0) << back.err;
  EXPECT_EQ(genu("check " + (folder / "again/scene.toml")).exit_code, 0);
  // The command that it prints, with a folder.
  const std::size_t next = made.out.find("genu import ");
  ASSERT_NE(next, std::string::npos) << made.out;
  const std::string line = made.out.substr(next + 5, made.out.find(" --out ", next) - next - 5);
  EXPECT_EQ(genu(line + " --out " + (folder / "printed")).exit_code, 0) << line;
  EXPECT_EQ(genu(command).exit_code, 2);  // nothing is replaced
}

TEST(CliExport, NamesWhatOpenSimHasNot) {
  const TemporaryFolder folder;
  const Outcome made =
      genu("export " + source_folder() + "/meshes/dortmans1984/scene.toml --osim --out " + (folder / "knee"));
  EXPECT_EQ(made.exit_code, 0) << made.err;
  for (const char* words :
       {"2 contacts (medial, lateral): WARNING: OpenSim has no rigid contact",
        "7 ligaments (AAC, PAC, APC, PPC, ...): WARNING: OpenSim has no ligament with the law quadratic"})
    EXPECT_TRUE(contains(made.out, words)) << made.out;
}

TEST(CliExport, RefusesWithoutWriting) {
  const TemporaryFolder folder;
  const std::string scene = source_folder() + "/meshes/joints/total-knee.toml";
  EXPECT_EQ(genu("export " + scene + " --out " + (folder / "knee")).exit_code, 2);
  EXPECT_EQ(genu("export " + scene + " --osim --out ''").exit_code, 2);
  EXPECT_EQ(genu("export " + scene + " --osim --side x --out " + (folder / "knee")).exit_code, 2);
  EXPECT_EQ(genu("export " + scene + " --osim --columns knee.none=a --out " + (folder / "knee")).exit_code, 2);
  EXPECT_EQ(genu("export " + (folder / "none.toml") + " --osim --out " + (folder / "knee")).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "knee"));
}

}  // namespace
}  // namespace genu::test
