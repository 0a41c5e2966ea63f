// Lengths of a scene beside the sizes of its surfaces.
#include "genu/assemble/unlikely_lengths.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/scene/centre_bodies.h"
#include "genu/scene/reader.h"
#include "support/scene_model.h"

namespace genu {
namespace {

/// What is said of a ligament of this length (in the scene's unit) over a ball of 20 mm, beside a mesh.
std::string said(double length, double meshes, const std::string& unit = "mm") {
  std::string text = test::bone_on_ground() +
                     test::surface("ball", "bone", "sphere", unit == "mm" ? "radius = 20" : "radius = 0.02") +
                     test::ligament("l", "[0, 0, 0]", fmt::format("[{}, 0, 0]", length),
                                    "law = \"linear\"\nstiffness = 500\nreference_strain = 0.02") +
                     "[[step]]\n";
  text.replace(text.find("\"mm\""), 4, '"' + unit + '"');
  Diagnostics out;
  const auto scene = parse_scene(text, "scene.toml", out);
  EXPECT_TRUE(scene) << text;
  if (!scene) return "no scene";
  const PlacedScene placed = place(*scene);
  warn_unlikely_lengths(placed, std::vector<Pose>(placed.bodies.size()), meshes, out);
  std::string all;
  for (const Diagnostic& d : out.items()) all += to_string(d) + "\n";
  return all;
}

TEST(UnlikelyLengths, ALigamentBesideItsSurfaces) {
  EXPECT_EQ(said(40, 0), "");
  EXPECT_EQ(said(300, 0.08), "");
  EXPECT_EQ(said(1, 0.08), "");
  EXPECT_NE(said(1300, 0.08).find("beside surfaces 80 mm across"), std::string::npos);
  EXPECT_EQ(said(1300, 0), "") << "a closed form may be a small part of its surface";
  const std::string large = said(4000, 0);
  EXPECT_NE(
      large.find("ligament.l: is 4000 mm long at the reference pose, beside surfaces 40 mm across: was 4 mm meant?"),
      std::string::npos)
      << large;
  const std::string small = said(0.02, 0);
  EXPECT_NE(small.find("ligament.l: is 0.02 mm long"), std::string::npos) << small;
  EXPECT_NE(small.find("was 20 mm meant?"), std::string::npos) << small;
}

TEST(UnlikelyLengths, AUnitThatIsNotThatOfTheMeshes) {
  const std::string metres = said(40, 0.08, "m");
  EXPECT_NE(
      metres.find("scene.toml:2:20: warning: units.length = \"m\": the lengths of the scene reach 4e+04 mm, and its "
                  "meshes are 80 mm across: was \"mm\" meant (then they reach 40 mm)?"),
      std::string::npos)
      << metres;
  const std::string millimetres = said(0.04, 0.08);
  EXPECT_NE(millimetres.find("units.length = \"mm\": the lengths of the scene reach 0.04 mm"), std::string::npos)
      << millimetres;
  EXPECT_EQ(said(0.04, 0.08, "m"), "");
}

}  // namespace
}  // namespace genu
