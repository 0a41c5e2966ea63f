#include <fstream>

#include "scene/scene_text.h"
#include "support/temporary_folder.h"

namespace genu::scene_test {
namespace {

const std::string kHead = R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.link]
)";
const std::string kSolid = "solid = { file = \"link.stl\", units = \"mm\", density = 1100, origin = [10, 0, 0] }\n";
const std::string kTail = R"([joint.h]
type = "revolute"
parent = "ground"
child = "link"
axis = [0, 0, 1]
)";
const std::string kMotion = "[dynamics]\nduration = 2\noutput_interval = 0.5\n";
const std::string kStep = "[[step]]\nincrements = 1\n";

class ReadSolid : public testing::Test {
 protected:
  ReadSolid() { folder_.write("link.stl", "solid"); }

  Scene read(const std::string& text) {
    Diagnostics out;
    const auto scene = parse_scene(text, folder_ / "s.toml", out);
    EXPECT_TRUE(scene) << all_messages(out);
    return scene.value_or(Scene{});
  }

  /// Exactly one error, of this key.
  void refused(const std::string& text, const std::string& key, const std::string& rule) {
    Diagnostics out;
    EXPECT_FALSE(parse_scene(text, folder_ / "s.toml", out));
    ASSERT_EQ(out.items().size(), 1u) << all_messages(out);
    EXPECT_EQ(out.items()[0].key, key);
    EXPECT_GT(out.items()[0].line, 0);
    EXPECT_NE(out.items()[0].rule.find(rule), std::string::npos) << out.items()[0].rule;
  }

  void refused_solid(const std::string& piece, const std::string& by, const std::string& key, const std::string& rule) {
    SCOPED_TRACE(by);
    refused(kHead + edited(piece, by, kSolid) + kTail + kMotion, "body.link.solid" + key, rule);
  }

  test::TemporaryFolder folder_;
};

TEST_F(ReadSolid, InSiUnitsWithDynamicsOrGravity) {
  for (const std::string& text :
       {kHead + kSolid + kTail + kMotion,
        edited("[body.ground]", kGravity + "[body.ground]", kHead) + kSolid + kTail + kStep}) {
    const Scene scene = read(text);
    ASSERT_EQ(scene.bodies.size(), 2u);
    ASSERT_TRUE(scene.bodies[1].solid);
    EXPECT_EQ(scene.bodies[1].solid->file.text(), folder_ / "link.stl");
    EXPECT_EQ(scene.bodies[1].solid->file_unit, 1e-3);
    EXPECT_EQ(scene.bodies[1].solid->density, 1100);
    EXPECT_EQ(scene.bodies[1].solid->placement.p, Vec3(0.01, 0, 0));
    EXPECT_EQ(mesh_files(scene), std::vector<std::string>{folder_ / "link.stl"});
    EXPECT_FALSE(scene.bodies[0].solid);
  }
}

TEST_F(ReadSolid, Errors) {
  refused_solid("link.stl", "none.stl", ".file", "no such file");
  refused_solid("file = \"link.stl\", ", "", ".file", "is missing");
  refused_solid("\"mm\"", "\"dm\"", ".units", "mm");
  refused_solid("1100", "0", ".density", "must be > 0 kg/m^3");
  refused_solid("1100", "-1100", ".density", "must be > 0 kg/m^3");
  refused_solid(", density = 1100", "", ".density", "is missing");
  refused_solid("1100", "1100, colour = 3", ".colour", "is no key");
  refused_solid("{ file = \"link.stl\", units = \"mm\", density = 1100, origin = [10, 0, 0] }", "\"link.stl\"", "",
                "must be a table");
}

TEST_F(ReadSolid, StandsAloneAndWhereAMassIsOfUse) {
  refused(kHead + kSolid + "mass = 3\n" + kTail + kMotion, "body.link.mass", "follows from `solid`");
  refused(kHead + kSolid + "centre_of_mass = [1, 2, 3]\n" + kTail + kMotion, "body.link.centre_of_mass", "`solid`");
  refused(kHead + kSolid + "inertia = [1, 1, 1]\n" + kTail + kMotion, "body.link.inertia", "follows from `solid`");
  refused(kHead + kSolid + kTail + kStep, "body.link.solid", "has no effect");
  const std::string of_ground = edited("fixed = true\n", "fixed = true\n" + kSolid, kHead);
  refused(of_ground + kSolid + kTail + kMotion, "body.ground.solid", "is of a fixed body");
}

}  // namespace
}  // namespace genu::scene_test
