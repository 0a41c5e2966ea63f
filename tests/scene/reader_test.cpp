#include "genu/scene/reader.h"
#include "support/places.h"

#include "scene/scene_text.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <random>

namespace genu::scene_test {
namespace {

namespace fs = std::filesystem;

TEST(Reader, Header) {
  const Scene scene = good(kGoodScene);
  EXPECT_EQ(scene.file, "scene.toml");
  EXPECT_EQ(scene.title, "test knee");
  EXPECT_EQ(scene.length_unit, 1e-3);
  EXPECT_DOUBLE_EQ(scene.angle_unit, std::numbers::pi / 180);
  std::string text = edited("\"mm\", angle = \"deg\"", "\"m\", angle = \"rad\"", edited("title = \"test knee\"", ""));
  for (const auto& [in_mm_deg, in_m_rad] :
       {std::pair{"flexion = 30", "flexion = 0.5"}, {"radius = 20", "radius = 0.02"}, {"[0, 70]", "[0, 1.2]"}})
    text = edited(in_mm_deg, in_m_rad, text);
  const Scene si = good(text);
  EXPECT_EQ(si.length_unit, 1);
  EXPECT_EQ(si.angle_unit, 1);
  EXPECT_EQ(si.title, "");
  EXPECT_EQ(si.surfaces[0].radius, 0.02);
}

TEST(Reader, HeaderErrors) {
  expect_refused("format = 1", "format = @2", "format", "2", "must be 1");
  expect_refused("format = 1", "format = @1.0", "format", "1.0", "must be 1");
  expect_refused("format = 1", "@", "format", "", "is missing");
  expect_refused("\"test knee\"", "@5", "title", "5", "must be a string");
  expect_refused("\"mm\"", "@\"cm\"", "units.length", "\"cm\"", "must be one of \"mm\", \"m\"");
  expect_refused("\"deg\"", "@1", "units.angle", "1", "must be one of \"deg\", \"rad\"");
  expect_refused("units = { length = \"mm\", angle = \"deg\" }", "@units = { length = \"mm\" }", "units.angle", "",
                 "is missing");
  expect_refused("units = { length", "units = { @force = \"N\", length", "units.force", "\"N\"", "is no key of units");
  expect_refused("{ length = \"mm\", angle = \"deg\" }", "@\"mm\"", "units", "\"mm\"", "must be a table");
}

TEST(Reader, UnknownAndUnbuiltKeysAtTheTop) {
  expect_one_error(kGoodScene + "[@ligamnet]\n", "ligamnet", "a table", "did you mean \"ligament\"?");
  expect_one_error(kGoodScene + "[@friction]\n", "friction", "a table", "is no key of a scene");
}

TEST(Reader, TextThatIsNoScene) {
  const auto refused = [](const std::string& text, const std::string& message) {
    Diagnostics out;
    EXPECT_FALSE(parse_scene(text, "s", out));
    ASSERT_EQ(out.items().size(), 1u);
    EXPECT_EQ(to_string(out.items()[0]).substr(0, message.size()), message);
  };
  refused("a = \"\xff\"", "s:1:6: is not UTF-8 text from here on");
  refused("format = 1\n[.", "s:2:2: not valid TOML: ");
  refused("format = 1\nformat = 1\n", "s:2:10: not valid TOML: ");
}

TEST(Reader, TenErrorsOfOneFileAtOnceInItsOrder) {
  std::string text = kGoodScene;
  const std::pair<std::string, std::string> spoil[] = {
      {"format = 1", "format = 3"},
      {"[body.femur]\n", "[body.femur]\nmass = 3\n"},
      {"\"adduction x\"", "\"adduction q\""},
      {"radius = 20", "radius = -20"},
      {"model = \"rigid\"", "model = \"cartilege\""},
      {"\"z < 0\"", "\"z = 0\""},
      {"body = \"tibia\", point = [-6.04, 4.0, -3.0]", "body = \"tbia\", point = [-6.04, nan, -3.0]"},
      {"stiffness = 37200.0", "stifness = 37200.0"},
      {"frame = \"body\"", "frame = \"bdy\""},
      {"increments = 70", "increments = 0"},
  };
  for (const auto& [from, to] : spoil) text = edited(from, to, text);
  Diagnostics out;
  EXPECT_FALSE(parse_scene(text, "s", out));
  const std::vector<std::string> expected = {
      "s:1:10: format = 3: must be 1",
      "s:9:1: body.femur.mass = 3: has no effect",
      "s:15:28: joint.knee.rotations[2] = \"adduction q\": must be",
      "s:22:10: surface.ball.radius = -20: must be > 0 mm",
      "s:31:9: contact.medial.model = \"cartilege\": must be one of",
      "s:32:21: contact.medial.regions.inner = \"z = 0\": must be",
      "s:34:11: ligament.AAC.stiffness: is missing",
      "s:36:15: ligament.AAC.to.body = \"tbia\": unknown body",
      "s:36:39: ligament.AAC.to.point[2] = nan: must be a finite number",
      "s:38:1: ligament.AAC.stifness = 37200.0: is no key of a quadratic ligament; did you mean \"stiffness\"?",
      "s:45:9: load.push.frame = \"bdy\": must be one of",
      "s:50:14: step[1].increments = 0: must be an integer",
  };
  ASSERT_EQ(out.items().size(), expected.size()) << all_messages(out);
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(to_string(out.items()[k]).substr(0, expected[k].size()), expected[k]);
  }
}

TEST(Reader, FilesThatCannotBeRead) {
  const auto refused = [](const std::string& path, const std::string& rule) {
    Diagnostics out;
    EXPECT_FALSE(read_scene(path, out));
    ASSERT_EQ(out.items().size(), 1u);
    EXPECT_EQ(out.items()[0].file, path);
    EXPECT_NE(out.items()[0].rule.find(rule), std::string::npos) << to_string(out.items()[0]);
  };
  const fs::path folder = fs::path(testing::TempDir()) / "genu_reader";
  fs::create_directories(folder);
  refused((folder / "none.toml").string(), "no such file");
  refused((folder / "none" / "none.toml").string(), "no such file");
  refused(folder.string(), "is a folder");
  refused("", "no scene file is named");
  refused("/dev/null", "is not a regular file");
  refused(std::string(5000, 'a'), "cannot be read");
  if (fs::exists("/proc/self/mem")) refused("/proc/self/mem", "cannot be read");
  std::ofstream(folder / "huge.toml") << "#" << std::string(17u << 20, 'a');
  refused((folder / "huge.toml").string(), "is larger than 16 MB");
  fs::remove_all(folder);
}

TEST(Reader, SceneFileInItsFolder) {
  const fs::path folder = fs::path(testing::TempDir()) / "genu_reader_good";
  fs::create_directories(folder);
  std::ofstream(folder / "scene.toml") << "\xef\xbb\xbf" << kGoodScene;  // with the mark some editors put first
  Diagnostics out;
  const auto scene = read_scene((folder / "scene.toml").string(), out);
  ASSERT_TRUE(scene) << all_messages(out);
  EXPECT_EQ(scene->file, (folder / "scene.toml").string());
  fs::remove_all(folder);
}

TEST(Reader, TruncationsAtEveryByteNeverCrash) {
  std::size_t refused = 0;
  for (std::size_t size = 0; size < kGoodScene.size(); ++size) {
    Diagnostics out;
    const auto scene = parse_scene(kGoodScene.substr(0, size), "s", out);
    EXPECT_EQ(scene.has_value(), !out.has_errors()) << size;
    refused += scene ? 0 : 1;
  }
  EXPECT_GT(refused, kGoodScene.size() - 60) << "only what follows the first [[step]] may be left out";
}

TEST(Reader, FlippedBytesNeverCrash) {
  std::mt19937 random(20240229);
  for (int run = 0; run < 20000; ++run) {
    std::string text = kGoodScene;
    for (unsigned flips = 1 + random() % 4; flips > 0; --flips) {
      char& c = text[random() % text.size()];
      // Any byte, or one of those that mean something to TOML.
      constexpr char kSyntax[] = "[]{}=.,\"'#\n-+e_0";
      c = random() % 2 ? static_cast<char>(random() % 256) : kSyntax[random() % (sizeof(kSyntax) - 1)];
    }
    Diagnostics out;
    const auto scene = parse_scene(text, "s", out);
    ASSERT_EQ(scene.has_value(), !out.has_errors()) << text;
    for (const Diagnostic& d : out.items()) ASSERT_TRUE(d.line > 0 && d.column > 0 && !d.rule.empty()) << to_string(d);
  }
}

TEST(Reader, SceneOfTheReferencePageIsGood) {
  std::ifstream page(fs::path(genu::test::source_folder()) / "docs" / "scene-reference.md");
  ASSERT_TRUE(page);
  const std::string text((std::istreambuf_iterator<char>(page)), std::istreambuf_iterator<char>());
  const std::string fence = "```toml\n";
  const std::size_t begin = text.find(fence) + fence.size(), end = text.find("```\n", begin);
  ASSERT_NE(end, std::string::npos);
  const Scene scene = good(text.substr(begin, end - begin));
  EXPECT_EQ(scene.ligaments.size(), 2u);
}

std::optional<Scene> real_scene(const std::string& name) {
  const fs::path path = fs::path(genu::test::source_folder()) / ".." / "shared" / "scenes" / name;
  if (!fs::exists(path)) return std::nullopt;
  Diagnostics out;
  auto scene = read_scene(path.string(), out);
  EXPECT_TRUE(scene) << all_messages(out);
  return scene.value_or(Scene{});
}

TEST(Reader, DortmansKnee) {
  const auto scene = real_scene("dortmans_knee.toml");
  if (!scene) GTEST_SKIP() << "dortmans_knee.toml is not here";
  ASSERT_EQ(scene->surfaces.size(), 4u);
  EXPECT_EQ(scene->surfaces[0].shape, SurfaceDef::Shape::torus);
  EXPECT_DOUBLE_EQ(scene->surfaces[0].major_radius, 0.015);
  EXPECT_TRUE(scene->surfaces[0].placement.R.col(0).isApprox(Vec3::UnitY(), 1e-15));
  EXPECT_TRUE(scene->surfaces[0].placement.R.col(2).isApprox(Vec3::UnitX(), 1e-15));
  EXPECT_EQ(scene->contacts.size(), 2u);
  ASSERT_EQ(scene->ligaments.size(), 7u);
  EXPECT_EQ(scene->ligaments[0].name, "AAC");
  EXPECT_EQ(scene->ligaments[6].name, "PMC");
  EXPECT_EQ(scene->ligaments[6].number("stiffness"), 23000);
  EXPECT_EQ(scene->ligaments[6].rest_value, 0.0625);
  EXPECT_DOUBLE_EQ(scene->joints.at(0).reference[4], 2.38e-3);
  EXPECT_EQ(scene->steps.at(0).increments, 70);
}

TEST(Reader, LenhartKnee) {
  const auto scene = real_scene("lenhart_knee.toml");
  if (!scene) GTEST_SKIP() << "lenhart_knee.toml is not here";
  ASSERT_EQ(scene->surfaces.size(), 2u);
  EXPECT_EQ(scene->surfaces[1].file_unit, 1);
  EXPECT_TRUE(fs::exists(scene->surfaces[1].file.text()));
  EXPECT_EQ(scene->contacts.at(0).regions.size(), 2u);
  ASSERT_EQ(scene->ligaments.size(), 55u);
  const LigamentDef& last = scene->ligaments.back();
  EXPECT_EQ(last.name, "pCAP8");
  EXPECT_EQ(last.law, "blankevoort");
  EXPECT_DOUBLE_EQ(last.rest_value, 54.6568e-3);
  EXPECT_EQ(scene->loads.at(0).frame, LoadDef::Frame::body);
}

}  // namespace
}  // namespace genu::scene_test
