#include "scene/scene_text.h"
#include "support/temporary_folder.h"

namespace genu::scene_test {
namespace {

const std::string kSolids = R"(format = 1
units = { length = "mm", angle = "deg" }
[solid.bone]
blend = 3
parts = [
  { shape = "sphere", radius = 20, origin = [1, 2, 3] },
  { shape = "ellipsoid", radii = [20, 30, 40], blend = 1 },
  { shape = "rod", from = [0, 0, 0], to = [0, 50, 0], radii = [9, 6] },
  { shape = "torus", major_radius = 15, minor_radius = 5, z_axis = [1, 0, 0] },
  { shape = "box", size = [10, 20, 30], rounding = 2, operation = "cut" },
  { shape = "half_space", origin = [0, 40, 0], operation = "keep" },
]
)";

std::optional<Scene> read_file_of(const std::string& text, Diagnostics& out) {
  const test::TemporaryFolder folder;
  return read_surface_file(folder.write("bones.toml", text), out);
}

/// Exactly one error, of this key below solid.bone.
void expect_solid_refused(const std::string& piece, const std::string& by, const std::string& key,
                          const std::string& rule) {
  SCOPED_TRACE(by);
  Diagnostics out;
  EXPECT_FALSE(read_file_of(edited(piece, by, kSolids), out));
  ASSERT_EQ(out.items().size(), 1u) << all_messages(out);
  EXPECT_EQ(out.items()[0].key, "solid.bone" + key);
  EXPECT_GT(out.items()[0].line, 2);
  EXPECT_NE(out.items()[0].rule.find(rule), std::string::npos) << out.items()[0].rule;
}

TEST(ReadSolidShapes, AllOfThemInSiUnits) {
  using Shape = SolidDef::Part::Shape;
  using Operation = SolidDef::Part::Operation;
  Diagnostics out;
  const auto scene = read_file_of(kSolids, out);
  ASSERT_TRUE(scene) << all_messages(out);
  ASSERT_EQ(scene->solids.size(), 1u);
  EXPECT_EQ(scene->solids[0].name, "bone");
  const auto& parts = scene->solids[0].parts;
  ASSERT_EQ(parts.size(), 6u);
  EXPECT_EQ(parts[0].shape, Shape::sphere);
  EXPECT_DOUBLE_EQ(parts[0].radius, 0.02);
  EXPECT_DOUBLE_EQ(parts[0].blend, 0.003);
  EXPECT_EQ(parts[0].placement.p, Vec3(0.001, 0.002, 0.003));
  EXPECT_EQ(parts[1].radii, Vec3(0.02, 0.03, 0.04));
  EXPECT_DOUBLE_EQ(parts[1].blend, 0.001);
  EXPECT_EQ(parts[2].to, Vec3(0, 0.05, 0));
  EXPECT_DOUBLE_EQ(parts[2].radius, 0.009);
  EXPECT_DOUBLE_EQ(parts[2].end_radius, 0.006);
  EXPECT_DOUBLE_EQ(parts[3].major_radius, 0.015);
  EXPECT_DOUBLE_EQ(parts[3].minor_radius, 0.005);
  EXPECT_EQ(parts[3].placement.R.col(2), Vec3::UnitX());
  EXPECT_EQ(parts[4].size, Vec3(0.01, 0.02, 0.03));
  EXPECT_DOUBLE_EQ(parts[4].rounding, 0.002);
  EXPECT_EQ(parts[4].operation, Operation::cut);
  EXPECT_EQ(parts[5].shape, Shape::half_space);
  EXPECT_EQ(parts[5].operation, Operation::keep);
  const auto even = read_file_of(edited("radii = [9, 6]", "radius = 7", kSolids), out);
  ASSERT_TRUE(even) << all_messages(out);
  EXPECT_DOUBLE_EQ(even->solids[0].parts[2].end_radius, 0.007);
}

TEST(ReadSolidShapes, Errors) {
  expect_solid_refused("\"sphere\"", "\"sfere\"", ".parts[1].shape", "sphere");
  expect_solid_refused("shape = \"sphere\", ", "", ".parts[1].shape", "is missing");
  expect_solid_refused("radius = 20", "radius = -20", ".parts[1].radius", "must be > 0 mm");
  expect_solid_refused("radius = 20", "radius = 0", ".parts[1].radius", "must be > 0 mm");
  expect_solid_refused("radius = 20", "radius = nan", ".parts[1].radius", "finite");
  expect_solid_refused("radius = 20, ", "", ".parts[1].radius", "is missing");
  expect_solid_refused("radius = 20", "radius = 20, radii = [1, 2, 3]", ".parts[1].radii", "is no key of a sphere");
  expect_solid_refused("[20, 30, 40]", "[20, -30, 40]", ".parts[2].radii[2]", "must be > 0 mm");
  expect_solid_refused("blend = 1", "blend = -1", ".parts[2].blend", "must be >= 0 mm");
  expect_solid_refused("blend = 3", "blend = -3", ".blend", "must be >= 0 mm");
  expect_solid_refused("[0, 50, 0]", "[0, 0, 0]", ".parts[3].to", "is where the rod begins");
  expect_solid_refused("radii = [9, 6]", "radii = [9, 6], radius = 3", ".parts[3].radius", "leave one of the two out");
  expect_solid_refused("radii = [9, 6]", "radii = [9, 6, 3]", ".parts[3].radii", "[radius at from, radius at to]");
  expect_solid_refused("minor_radius = 5", "minor_radius = 15", ".parts[4].minor_radius", "must be < major_radius");
  expect_solid_refused("rounding = 2", "rounding = 6", ".parts[5].rounding", "at most half the size");
  expect_solid_refused("\"cut\"", "\"chop\"", ".parts[5].operation", "cut");
  expect_solid_refused(", operation = \"keep\"", "", ".parts[6].operation", "can only be cut or kept");
  expect_solid_refused("radius = 20", "radius = 20, operation = \"cut\"", ".parts[1].operation",
                       "the first part is joined");
  expect_solid_refused("blend = 3\n", "blend = 3\nblent = 2\n", ".blent", "is no key of a solid");
  expect_solid_refused("  { shape = \"sphere\"", "  7,\n  { shape = \"sphere\"", ".parts[1]", "must be a table");
}

TEST(ReadSolidShapes, WithoutPartsThereIsNoSolid) {
  const std::string head = "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[solid.bone]\n";
  for (const char* parts : {"parts = []\n", "parts = 3\n", ""}) {
    Diagnostics out;
    EXPECT_FALSE(read_file_of(head + parts, out));
    ASSERT_EQ(out.items().size(), 1u) << all_messages(out);
    EXPECT_EQ(out.items()[0].key, "solid.bone.parts");
  }
  Diagnostics out;
  EXPECT_FALSE(parse_scene(kGoodScene + "[solid.bone]\nparts = []\n", "s", out)) << "no scene has solids";
}

}  // namespace
}  // namespace genu::scene_test
