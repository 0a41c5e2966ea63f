// The tree keeps the rules of the house, and the rules would notice if it did not.
#include "style/house_rules.h"
#include "support/places.h"

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
  const std::vector<SourceFile> files_ = read_sources(genu::test::source_folder());
  const Rooms rooms_ = read_rooms(genu::test::source_folder());
};

TEST_F(TheTree, IsRead) {
  ASSERT_THAT(files_, Not(IsEmpty()));
  bool has_pose = false;
  for (const SourceFile& file : files_) has_pose |= file.path == "src/genu/core/pose.h" && !file.lines.empty();
  EXPECT_TRUE(has_pose);
}

TEST_F(TheTree, FollowsTheOrderOfRooms) { EXPECT_THAT(wrong_arrows(files_, rooms_), IsEmpty()); }
TEST_F(TheTree, HasRoomsWithoutCycles) {
  EXPECT_GT(rooms_.size(), 15U);
  EXPECT_THAT(room_cycles(rooms_), IsEmpty());
}
TEST_F(TheTree, HasUnitsWithoutCycles) { EXPECT_THAT(unit_cycles(files_), IsEmpty()); }
TEST_F(TheTree, HasNoCrowdedRooms) { EXPECT_THAT(crowded_rooms(files_), IsEmpty()); }
TEST_F(TheTree, KeepsLibrariesBehindOneOrTwoSources) { EXPECT_THAT(wandering_libraries(files_), IsEmpty()); }
TEST_F(TheTree, HasNoLongFiles) { EXPECT_THAT(long_files(files_), IsEmpty()); }

// A small house: who may include whom.
Rooms house() {
  return {{"core", {}},
          {"mesh", {"core"}},
          {"mesh_files", {"core", "mesh"}},
          {"scene", {"core"}},
          {"contact", {"core", "mesh"}},
          {"model", {"core", "contact", "scene"}},
          {"judge", {"core", "scene", "mesh", "mesh_files"}},
          {"study", {"core", "model"}}};
}

TEST(WrongArrows, AreNamedWithFileAndLine) {
  const SourceFile model{"src/genu/model/load.cpp",
                         {"// text", "#include \"genu/contact/pair.h\"", "  #  include <genu/mesh/mesh.h>"}};
  const SourceFile core{"src/genu/core/pose.h", {"#include \"genu/study/run.h\""}};
  EXPECT_THAT(wrong_arrows({model, core}, house()),
              ElementsAre("src/genu/model/load.cpp:3: includes genu/mesh/mesh.h: wrong arrow model -> mesh",
                          "src/genu/core/pose.h:1: includes genu/study/run.h: wrong arrow core -> study"));
}

TEST(WrongArrows, CannotHideInAPathOrAnUnknownFolder) {
  const SourceFile relative{"src/genu/model/load.cpp", {"#include \"../mesh/mesh.h\""}};
  const SourceFile unknown{"src/genu/utils/misc.h", {}};
  const SourceFile missing{"src/genu/study/run.cpp", {"#include \"genu/utils/misc.h\""}};
  EXPECT_THAT(wrong_arrows({relative, unknown, missing}, house()),
              ElementsAre(HasSubstr("load.cpp:1:"), HasSubstr("no room"), HasSubstr("no room utils")));
}

TEST(WrongArrows, TheJudgeKnowsFilesOfMeshesAndNothingElseOfWhatItJudges) {
  const SourceFile judge{"src/genu/judge/subject.cpp",
                         {"#include \"genu/mesh_files/mesh_reader.h\"", "#include \"genu/scene/scene.h\"",
                          "#include \"genu/mesh/mesh.h\"", "#include \"genu/mesh/triangle_tree.h\"",
                          "#include \"genu/contact/layer_law.h\"", "#include \"genu/model/ligament_law.h\""}};
  EXPECT_THAT(wrong_arrows({judge}, house()),
              ElementsAre(HasSubstr("judge -> mesh"), HasSubstr("judge -> contact"), HasSubstr("judge -> model")));
  const SourceFile judged{"src/genu/study/run_scene.cpp", {"#include \"genu/judge/judge.h\""}};
  EXPECT_THAT(wrong_arrows({judged}, house()), SizeIs(1));
}

TEST(WrongArrows, RightOnesPass) {
  const SourceFile contact{"src/genu/contact/candidates.cpp",
                           {"#include \"genu/contact/candidates.h\"", "#include <vector>",
                            "#include \"genu/mesh/mesh.h\"", "// #include \"genu/study/run.h\""}};
  const SourceFile tool{"tools/cli/main.cpp", {"#include \"genu/study/run.h\"", "#include \"genu/core/timer.h\""}};
  EXPECT_THAT(wrong_arrows({contact, tool}, house()), IsEmpty());
}

TEST(RoomCycles, AreNamed) {
  EXPECT_THAT(room_cycles(house()), IsEmpty());
  Rooms turned = house();
  turned["mesh"].insert("model");
  EXPECT_THAT(room_cycles(turned), ElementsAre(HasSubstr("contact"), HasSubstr("mesh"), HasSubstr("model")));
}

TEST(UnitCycles, AreSeenThroughHeadersAndSources) {
  const SourceFile path{"src/genu/path/path.h", {"#include \"genu/path/path_follower.h\""}};
  const SourceFile follower{"src/genu/path/path_follower.h", {"#include <string>"}};
  const SourceFile source{"src/genu/path/path_follower.cpp", {"#include \"genu/path/event.h\""}};
  const SourceFile event{"src/genu/path/event.h", {"#include \"genu/path/path.h\""}};
  const SourceFile own{"src/genu/path/path.cpp", {"#include \"genu/path/path.h\""}};
  EXPECT_THAT(unit_cycles({path, follower, event, own}), IsEmpty());
  EXPECT_THAT(unit_cycles({path, follower, source, event, own}),
              ElementsAre("cycle of units: genu/path/event genu/path/path genu/path/path_follower"));
}

TEST(CrowdedRooms, HaveMoreThanATenth) {
  std::vector<SourceFile> files;
  for (int i = 0; i < 10; ++i)
    files.push_back({"src/genu/room" + std::to_string(i) + "/a.cpp", std::vector<std::string>(100)});
  EXPECT_THAT(crowded_rooms(files), IsEmpty());
  files.front().lines.emplace_back();
  EXPECT_THAT(crowded_rooms(files), ElementsAre("room room0 has 101 of 1001 lines, more than a tenth"));
}

TEST(WanderingLibraries, InAHeaderOrAThirdSourceAreNamed) {
  const SourceFile header{"src/genu/mesh_care/repair.h", {"#include <CGAL/Surface_mesh.h>"}};
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
