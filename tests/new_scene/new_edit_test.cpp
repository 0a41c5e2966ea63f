// A scene of the drawn bones that is written again, with changes of its user.
#include "genu/new_scene/new_edit.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "genu/new_scene/new_scene.h"
#include "support/drawn_knee.h"
#include "support/leskovar.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

using test::contains;
using test::kLeskovar;
using test::read_file;
using test::TemporaryFolder;

NewScene asked_in(const std::string& folder, bool edit) {
  NewScene asked = test::drawn_knee_in(folder);
  asked.edit = edit;
  return asked;
}

void write(const std::string& file, const std::string& text) { std::ofstream(file) << text; }

std::string choices_in(const NewSceneReport& report) {
  std::string out;
  for (const std::string& line : report.choices) out += line + "\n";
  return out;
}

TEST(NewEdit, KeepsChangesAndSaysWhatTheyContradict) {
  const TemporaryFolder folder;
  const NewSceneFiles files{folder / "knee", "knee"};
  Diagnostics out;
  ASSERT_TRUE(write_new_scene(asked_in(folder / "knee", false), out)) << test::messages(out);
  const std::string first = read_file(files.scene());
  EXPECT_EQ(read_file(files.written()), written_copy(first));

  // A softer ligament, a shorter motion, and an end that the landmark below moves, too.
  std::string mine = test::with_first(first, "modulus = 10 ", "modulus = 12 ");
  mine = test::with_first(mine, "[0, 120]", "[0, 20]");
  mine = test::with_first(mine, "increments = 120", "increments = 20");
  const std::string end = mine.substr(mine.find("from = ", mine.find("[ligament.ACLam1]")));
  const std::string line = end.substr(0, end.find('\n'));
  mine = test::with_first(mine, line, "from = { body = \"femur\", point = [1, 8, 2] }   # picked");
  write(files.scene(), mine);

  NewScene again = asked_in(folder / "knee", true);
  again.landmarks = folder / "points.csv";
  write(again.landmarks, "name,x,y,z\nACL femur,1,1.5,4\n");
  const auto report = write_new_scene(again, out);
  ASSERT_TRUE(report) << test::messages(out);
  EXPECT_EQ(report->poses_solved, 30);
  const std::string text = read_file(files.scene());
  EXPECT_TRUE(contains(text, "modulus = 12 "));
  EXPECT_TRUE(contains(text, "[0, 20]"));
  EXPECT_TRUE(contains(text, "point = [1, 8, 2] }   # picked"));
  EXPECT_TRUE(contains(text, "by your landmark ACL femur"));  // the other fibres
  EXPECT_EQ(read_file(files.before()), mine);
  EXPECT_FALSE(contains(read_file(files.written()), "modulus = 12 "));
  EXPECT_FALSE(std::filesystem::exists(files.trial()));
  EXPECT_TRUE(contains(choices_in(*report), "kept        4 changes of yours, 1 of them against what genu writes now"));
  ASSERT_EQ(out.items().size(), 1u) << test::messages(out);
  EXPECT_TRUE(
      contains(to_string(out.items().front()),
               "ligament.ACLam1.from = { body = \"femur\", point = [1, 8, 2] }: is yours and stays; genu has {"));

  // Once more, the same: nothing changes.
  Diagnostics none;
  ASSERT_TRUE(write_new_scene(again, none)) << test::messages(none);
  EXPECT_EQ(read_file(files.scene()), text);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(files.folder), {}), 3);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / ""), {}), 2);
}

TEST(NewEdit, ThatIsRefusedChangesNothing) {
  const TemporaryFolder folder;
  const NewSceneFiles files{folder / "knee", "knee"};
  const auto refused = [&](const NewScene& asked, const std::string& said) {
    Diagnostics out;
    EXPECT_FALSE(write_new_scene(asked, out));
    EXPECT_TRUE(contains(test::messages(out), said)) << test::messages(out);
  };
  const NewScene again = asked_in(folder / "knee", true);
  refused(again, "is no folder of a scene");
  NewScene analytic{.folder = folder / "knee"};
  analytic.edit = true;
  refused(analytic, "--edit: belongs to a scene of meshes");
  std::filesystem::create_directory(files.folder);
  refused(again, "knee.toml");
  EXPECT_TRUE(std::filesystem::is_empty(files.folder));

  Diagnostics out;
  std::filesystem::remove(files.folder);
  ASSERT_TRUE(write_new_scene(asked_in(folder / "knee", false), out)) << test::messages(out);
  const std::string good = read_file(files.scene()), copy = read_file(files.written());
  const auto stands = [&](const std::string& scene, const std::string& written) {
    EXPECT_EQ(read_file(files.scene()), scene);
    EXPECT_EQ(read_file(files.written()), written);
    EXPECT_FALSE(std::filesystem::exists(files.before()));
    EXPECT_FALSE(std::filesystem::exists(files.trial()));
  };
  const std::string wrong = test::with_first(good, "modulus = 10 ", "modulus = -1 ");
  write(files.scene(), wrong);
  NewScene none = again;
  none.femur = folder / "none.stl";
  refused(none, "modulus = -1: must be > 0");
  refused(none, "none.stl");  // both at once
  stands(wrong, copy);
  write(files.scene(), good);
  write(files.written(), "format = 1\n");
  refused(again, "is no copy of what genu wrote");
  stands(good, "format = 1\n");
  std::filesystem::remove(files.written());
  refused(again, "without what genu wrote");
}

}  // namespace
}  // namespace genu
