// Numbers that are allowed and probably meant in another unit: what is said, and that sound ones are silent.
#include "genu/core/units.h"
#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

const std::string kLaw = "law = \"quadratic\"\nstiffness = 37200.0\nreference_strain = -0.0175\n";

std::string said(const std::string& text) {
  Diagnostics out;
  EXPECT_TRUE(parse_scene(text, "scene.toml", out)) << all_messages(out);
  return all_messages(out);
}

std::string said_of_law(const std::string& law, const std::string& name = "AAC") {
  return said(edited("[ligament.AAC]", "[ligament." + name + "]", edited(kLaw, law)));
}

bool has(const std::string& text, const std::string& piece) { return text.find(piece) != std::string::npos; }

TEST(UnlikelyNumbers, StrainsInPercent) {
  const std::string strain = said_of_law("law = \"quadratic\"\nstiffness = 20000\nreference_strain = 2\n");
  EXPECT_EQ(
      strain,
      "scene.toml:38:20: warning: ligament.AAC.reference_strain = 2: is a strain of 200 %, and ligaments fail at 10 "
      "to 30 %: was 0.02 (2 %) meant?\n");
  const std::string toe =
      said_of_law("law = \"blankevoort\"\nstiffness = 5000\ntransition_strain = 6\nreference_strain = 0.02\n");
  EXPECT_TRUE(has(toe, "ligament.AAC.transition_strain = 6: is a strain of 600 %")) << toe;
  EXPECT_TRUE(has(toe, "was 0.06 (6 %) meant?")) << toe;
  const std::string table =
      said_of_law("law = \"table\"\npoints = [[0, 0], [3, 10], [5, 200]]\nreference_strain = 0\n");
  EXPECT_TRUE(has(table, "ligament.AAC.points[3][1] = 5: is a strain of 500 %")) << table;
  EXPECT_EQ(said_of_law("law = \"blankevoort\"\nstiffness = 5000\ntransition_strain = 0.06\nreference_strain = 0.08\n"),
            "");
}

TEST(UnlikelyNumbers, StretchAtTheReferencePose) {
  const std::string law = "law = \"linear\"\nstiffness = 200\n";
  const std::string slack = said_of_law(law + "slack_length = 10\n");
  EXPECT_TRUE(has(slack, "scene.toml:38:16: warning: ligament.AAC.slack_length = 10: stretches it by ")) << slack;
  EXPECT_TRUE(has(slack, "ligaments fail at 10 to 30 %: was about ")) << slack;
  EXPECT_TRUE(has(said_of_law(law + "reference_strain = 0.4\n"), "stretches it by 40 % at the reference pose"));
  EXPECT_TRUE(has(said_of_law(law + "reference_force = 100\n"), "reference_force = 100: stretches it by 50 %"));
  EXPECT_EQ(said_of_law(law + "reference_strain = 0.29\n"), "");
  EXPECT_EQ(said_of_law("law = \"spring\"\nstiffness = 20\nslack_length = 0\n"), "") << "springs are no ligaments";
}

TEST(UnlikelyNumbers, StiffnessOfABundleByItsName) {
  const auto law = [](const char* stiffness) {
    return std::string("law = \"linear\"\nreference_strain = 0.02\nstiffness = ") + stiffness + "\n";
  };
  const std::string low = said_of_law(law("5"), "ACL_am");
  EXPECT_TRUE(has(low,
                  "ligament.ACL_am.stiffness = 5: is 1.2e+03 times below that of an anterior cruciate ligament, about "
                  "6e+03 N per unit of strain: was 5000 meant?"))
      << low;
  EXPECT_TRUE(has(said_of_law(law("5e6"), "pMCL"), "is 1e+03 times that of a medial collateral ligament"));
  EXPECT_TRUE(has(said_of_law(law("2e7"), "patellar-tendon"), "a patellar tendon"));
  const std::string spring = said_of_law("law = \"spring\"\nstiffness = 500000\nslack_length = 10\n", "PatellarTendon");
  EXPECT_TRUE(has(spring, "about 500 N/mm: was 500 meant?")) << spring;
  for (const char* sound : {"100", "500", "5000", "40000"})
    for (const char* name : {"ACL1", "PCLal", "MCLs3", "LCL", "pCAP8", "patellar_tendon", "PT4", "mPFL2"})
      EXPECT_EQ(said_of_law(law(sound), name) == "" || std::string(sound) == "100", true) << name << sound;
  EXPECT_TRUE(has(said_of_law(law("5"), "PT1"), "that of a patellar tendon"));
  EXPECT_TRUE(has(said_of_law(law("5"), "iliofemoral_r"), "that of a ligament of the hip"));
  for (const char* unknown : {"AAC", "ptx", "PTx1"})
    EXPECT_EQ(said_of_law(law("5"), unknown), "") << "nobody knows what it is";
}

TEST(UnlikelyNumbers, SizesOfMetresOrMicrons) {
  const std::string large = said(edited("radius = 20", "radius = 20000"));
  EXPECT_TRUE(has(large, "surface.ball.radius = 20000: is 20 m: was 20 mm meant?")) << large;
  const std::string small = said(edited("radius = 20", "radius = 0.02"));
  EXPECT_TRUE(has(small, "surface.ball.radius = 0.02: is 0.02 mm: was 20 mm meant?")) << small;
  const std::string radii = said(edited(kBall, "shape = \"ellipsoid\"\nradii = [20, 30000, 20]\n"));
  EXPECT_TRUE(has(radii, "surface.ball.radii = [20, 30000, 20]: is 30 m: was 30 mm")) << radii;
  for (const char* sound : {"0.5", "20", "1000"})
    EXPECT_EQ(said(edited("radius = 20", std::string("radius = ") + sound)), "");
}

TEST(UnlikelyNumbers, ModulusOfALayerInPaOrGPa) {
  const auto said_of_modulus = [](const std::string& modulus) {
    const std::string layer =
        "model = \"cartilage\"\nmodulus = " + modulus + "\npoisson = 0.4\nthickness = 4\nquadrature = \"triangles\"";
    return said(edited("model = \"rigid\"", layer));
  };
  const std::string in_pa = said_of_modulus("4e6");
  EXPECT_TRUE(has(in_pa, "modulus = 4000000.0: is 4e+06 MPa, where cartilage has 1 to 20 MPa")) << in_pa;
  EXPECT_TRUE(has(in_pa, "was 4 meant?")) << in_pa;
  const std::string in_gpa = said_of_modulus("0.005");
  EXPECT_TRUE(has(in_gpa, "is 0.005 MPa")) << in_gpa;
  EXPECT_TRUE(has(in_gpa, "was 5 meant?")) << in_gpa;
  EXPECT_TRUE(has(said_of_modulus("1e9"), "polyethylene about 1000: check its unit"));
  for (const char* sound : {"0.3", "5", "1000", "4000"}) EXPECT_EQ(said_of_modulus(sound), "") << sound;
}

TEST(UnlikelyNumbers, ThicknessOfALayerInAnotherUnit) {
  const auto said_of_thickness = [](const std::string& thickness) {
    return said(edited("model = \"rigid\"", "model = \"cartilage\"\nmodulus = 5\npoisson = 0.4\nthickness = " +
                                                thickness + "\nquadrature = \"triangles\""));
  };
  EXPECT_TRUE(has(said_of_thickness("4000"), "thickness = 4000: is 4e+03 mm, where cartilage has 1 to 6 mm"));
  EXPECT_TRUE(has(said_of_thickness("0.004"), "is 0.004 mm"));
  for (const char* sound : {"0.2", "4", "12"}) EXPECT_EQ(said_of_thickness(sound), "") << sound;
}

TEST(UnlikelyNumbers, AnglesBeyondATurn) {
  const std::string in_rad = said(edited("angle = \"deg\"", "angle = \"rad\""));
  EXPECT_TRUE(has(in_rad, "turns, as units.angle is \"rad\": was \"deg\" meant?")) << in_rad;
  EXPECT_EQ(in_rad.find("turns"), in_rad.rfind("turns")) << "said once\n" << in_rad;
}

TEST(UnlikelyNumbers, WarningsWaitUntilThereIsNoError) {
  Diagnostics out;
  EXPECT_FALSE(parse_scene(edited(kLaw, "law = \"linear\"\nstiffness = -2\nreference_strain = 2\n"), "s", out));
  EXPECT_EQ(out.items().size(), 1u) << all_messages(out);
}

}  // namespace
}  // namespace genu::scene_test
