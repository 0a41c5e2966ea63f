// The tree keeps the rules of the house, and the rules would notice if it did not.
#include "style/house_rules.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace genu::style {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class TheTree : public ::testing::Test {
 protected:
  const std::vector<SourceFile> files_ = read_sources(GENU_SOURCE_DIR);
};

TEST_F(TheTree, IsRead) {
  ASSERT_THAT(files_, Not(IsEmpty()));
  bool has_pose = false;
  for (const SourceFile& file : files_) has_pose |= file.path == "src/genu/core/pose.h" && !file.lines.empty();
  EXPECT_TRUE(has_pose);
}

TEST_F(TheTree, FollowsTheOrderOfLayers) { EXPECT_THAT(wrong_arrows(files_), IsEmpty()); }
TEST_F(TheTree, KeepsLibrariesBehindOneOrTwoSources) { EXPECT_THAT(wandering_libraries(files_), IsEmpty()); }
TEST_F(TheTree, HasNoLongFiles) { EXPECT_THAT(long_files(files_), IsEmpty()); }

TEST(WrongArrows, AreNamedWithFileAndLine) {
  const SourceFile solver{"src/genu/solver/newton.cpp",
                          {"// text", "#include \"genu/model/model.h\"", "  #  include <genu/geometry/torus.h>"}};
  const SourceFile core{"src/genu/core/pose.h", {"#include \"genu/run/run.h\""}};
  EXPECT_THAT(
      wrong_arrows({solver, core}),
      ElementsAre("src/genu/solver/newton.cpp:3: includes genu/geometry/torus.h: wrong arrow solver -> geometry",
                  "src/genu/core/pose.h:1: includes genu/run/run.h: wrong arrow core -> run"));
}

TEST(WrongArrows, GeometryAndSceneDoNotKnowEachOther) {
  const SourceFile geometry{"src/genu/geometry/torus.cpp", {"#include \"genu/scene/scene.h\""}};
  const SourceFile scene{"src/genu/scene/reader.cpp", {"#include \"genu/geometry/mesh.h\""}};
  EXPECT_THAT(wrong_arrows({geometry, scene}), SizeIs(2));
}

TEST(WrongArrows, CannotHideInAPathOrAnUnknownFolder) {
  const SourceFile relative{"src/genu/solver/newton.cpp", {"#include \"../geometry/torus.h\""}};
  const SourceFile unknown{"src/genu/utils/misc.h", {}};
  const SourceFile missing{"src/genu/run/run.cpp", {"#include \"genu/utils/misc.h\""}};
  EXPECT_THAT(wrong_arrows({relative, unknown, missing}),
              ElementsAre(HasSubstr("newton.cpp:1:"), HasSubstr("no layer"), HasSubstr("no layer utils")));
}

TEST(WrongArrows, TheJudgeKnowsFilesOfMeshesAndNothingElseOfWhatItJudges) {
  const SourceFile judge{"src/genu/judge/subject.cpp",
                         {"#include \"genu/geometry/mesh_reader.h\"", "#include \"genu/scene/scene.h\"",
                          "#include \"genu/geometry/surface.h\"", "#include \"genu/contact/layer_law.h\"",
                          "#include \"genu/model/ligament_law.h\"", "#include \"genu/run/run_scene.h\""}};
  EXPECT_THAT(wrong_arrows({judge}), ElementsAre(HasSubstr("judge -> geometry"), HasSubstr("judge -> contact"),
                                                 HasSubstr("judge -> model"), HasSubstr("judge -> run")));
  const SourceFile judged{"src/genu/run/run_scene.cpp", {"#include \"genu/judge/judge.h\""}};
  EXPECT_THAT(wrong_arrows({judged}), SizeIs(1));
}

TEST(WrongArrows, RightOnesPass) {
  const SourceFile contact{"src/genu/contact/candidates.cpp",
                           {"#include \"genu/contact/candidates.h\"", "#include <vector>",
                            "#include \"genu/geometry/mesh.h\"", "// #include \"genu/run/run.h\""}};
  const SourceFile tool{"tools/cli/main.cpp", {"#include \"genu/run/run.h\"", "#include \"genu/core/timer.h\""}};
  EXPECT_THAT(wrong_arrows({contact, tool}), IsEmpty());
}

TEST(WanderingLibraries, InAHeaderOrAThirdSourceAreNamed) {
  const SourceFile header{"src/genu/geometry/repair.h", {"#include <CGAL/Surface_mesh.h>"}};
  const std::string fcl = "#include <fcl/fcl.h>";
  const SourceFile a{"src/genu/contact/a.cpp", {fcl, fcl}};
  const SourceFile b{"src/genu/contact/b.cpp", {fcl}};
  const SourceFile c{"src/genu/contact/c.cpp", {"", fcl}};
  EXPECT_THAT(wandering_libraries({a, b}), IsEmpty());
  EXPECT_THAT(wandering_libraries({a, b, c, header}), ElementsAre(HasSubstr("repair.h:1: includes CGAL/Surface_mesh.h"),
                                                                  HasSubstr("c.cpp:2: includes fcl/fcl.h")));
}

TEST(LongFiles, StartAtFourHundredAndOneLines) {
  const SourceFile longest{"src/genu/core/a.cpp", std::vector<std::string>(400)};
  const SourceFile too_long{"src/genu/core/b.cpp", std::vector<std::string>(401)};
  EXPECT_THAT(long_files({longest, too_long}), ElementsAre(HasSubstr("b.cpp: 401 lines")));
}

}  // namespace
}  // namespace genu::style
