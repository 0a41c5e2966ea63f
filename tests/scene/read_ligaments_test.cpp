#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

using Rest = LigamentDef::Rest;

const std::string kLaw = "law = \"quadratic\"\nstiffness = 37200.0\nreference_strain = -0.0175\n";
const std::string kFrom = R"(from = { body = "femur", point = [12.25, -7.84, 0.0] })";
const std::string kTo = R"(to = { body = "tibia", point = [-6.04, 4.0, -3.0] })";

LigamentDef ligament(const std::string& law) { return good(edited(kLaw, law)).ligaments.at(0); }

void expect_law_refused(const std::string& law, const std::string& key, const std::string& found,
                        const std::string& rule) {
  expect_refused(kLaw, law, "ligament.AAC." + key, found, rule);
}

TEST(ReadLigaments, Ends) {
  const LigamentDef l = ligament(kLaw);
  EXPECT_EQ(l.name, "AAC");
  EXPECT_EQ(l.from.body, 1);
  EXPECT_EQ(l.to.body, 0);
  EXPECT_TRUE(l.from.point.isApprox(Vec3(12.25e-3, -7.84e-3, 0), 1e-15));
  EXPECT_TRUE(l.to.point.isApprox(Vec3(-6.04e-3, 4e-3, -3e-3), 1e-15));
}

TEST(ReadLigaments, EveryLawInSi) {
  const LigamentDef quadratic = ligament(kLaw);
  EXPECT_EQ(quadratic.law, "quadratic");
  EXPECT_EQ(quadratic.number("stiffness"), 37200);
  const LigamentDef linear = ligament("law = \"linear\"\nstiffness = 200\nslack_length = 20\n");
  EXPECT_EQ(linear.law, "linear");
  EXPECT_EQ(linear.number("stiffness"), 200);
  const LigamentDef blankevoort =
      ligament("law = \"blankevoort\"\nstiffness = 500\ntransition_strain = 0.06\nslack_length = 20\n");
  EXPECT_EQ(blankevoort.law, "blankevoort");
  EXPECT_EQ(blankevoort.number("stiffness"), 500);
  EXPECT_EQ(blankevoort.number("transition_strain"), 0.06);
  const LigamentDef spring = ligament("law = \"spring\"\nstiffness = 100\nslack_length = 0\n");
  EXPECT_EQ(spring.law, "spring");
  EXPECT_DOUBLE_EQ(spring.number("stiffness"), 1e5) << "100 N/mm";
  EXPECT_EQ(spring.rest_value, 0);
  const LigamentDef table =
      ligament("law = \"table\"\npoints = [[-0.1, 0], [0.02, 10.5], [0.1, 200]]\nslack_length = 20\n");
  EXPECT_EQ(table.law, "table");
  EXPECT_EQ(table.points, (std::vector<std::pair<double, double>>{{-0.1, 0}, {0.02, 10.5}, {0.1, 200}}));
  const LigamentDef abdel = ligament(
      "law = \"abdel-rahman\"\nstiffness = 110\ntoe_stiffness = 22\ntransition_strain = 0.06\nslack_length = 20\n");
  EXPECT_EQ(abdel.law, "abdel-rahman");
  EXPECT_DOUBLE_EQ(abdel.number("stiffness"), 110e3) << "N/mm";
  EXPECT_DOUBLE_EQ(abdel.number("toe_stiffness"), 22e6) << "N/mm^2";
}

TEST(ReadLigaments, EveryRestForm) {
  const std::string law = "law = \"linear\"\nstiffness = 200\n";
  const LigamentDef slack = ligament(law + "slack_length = 20\n");
  EXPECT_EQ(slack.rest, Rest::slack_length);
  EXPECT_DOUBLE_EQ(slack.rest_value, 0.02);
  const LigamentDef strain = ligament(law + "reference_strain = -0.5\n");
  EXPECT_EQ(strain.rest, Rest::reference_strain);
  EXPECT_EQ(strain.rest_value, -0.5);
  const LigamentDef force = ligament(law + "reference_force = 35\n");
  EXPECT_EQ(force.rest, Rest::reference_force);
  EXPECT_EQ(force.rest_value, 35);
  EXPECT_EQ(ligament("law = \"spring\"\nstiffness = 1\nreference_force = -3\n").rest_value, -3) << "it can push";
}

TEST(ReadLigaments, EndErrors) {
  expect_refused(kTo, R"(to = { body = @"tibai", point = [0, 0, 0] })", "ligament.AAC.to.body", "\"tibai\"",
                 "unknown body; known: \"tibia\", \"femur\"; did you mean \"tibia\"?");
  expect_refused(kTo, R"(to = { body = @"femur", point = [0, 0, 0] })", "ligament.AAC.to.body", "\"femur\"",
                 "both ends are on the same body");
  expect_refused(kTo, R"(to = { body = "tibia", point = @[0, 0] })", "ligament.AAC.to.point", "[0, 0]",
                 "must be three numbers [x, y, z], in mm");
  expect_refused(kTo, R"(to = { body = "tibia", point = [0, @inf, 0] })", "ligament.AAC.to.point[2]", "inf", "finite");
  expect_refused(kTo, R"(to = { body = "tibia", point = [0, @"1", 0] })", "ligament.AAC.to.point[2]", "\"1\"",
                 "must be a number, in mm");
  expect_refused(kTo, R"(@to = { body = "tibia" })", "ligament.AAC.to.point", "", "is missing");
  expect_refused(kTo, R"(@to = { point = [0, 0, 0] })", "ligament.AAC.to.body", "", "is missing");
  expect_refused(kTo, R"(to = { body = "tibia", point = [0, 0, 0], @frame = 1 })", "ligament.AAC.to.frame", "1",
                 "is no key of the end of a ligament");
  expect_refused(kTo, R"(to = @"tibia")", "ligament.AAC.to", "\"tibia\"", "must be a table");
  expect_refused("[ligament.AAC]\n" + kFrom, "[ligament.@AAC]", "ligament.AAC.from", "", "is missing");
}

TEST(ReadLigaments, FixedEnds) {
  const std::string ground = "[body.ground]\nfixed = true\n";
  expect_one_error(edited(kFrom + "\nto = { body = \"tibia\"",
                          R"(from = { body = "ground", point = [12.25, -7.84, 0.0] })"
                          "\nto = { body = @\"tibia\"",
                          kGoodScene + ground),
                   "ligament.AAC.to.body", "\"tibia\"", "both ends are on fixed bodies");
}

TEST(ReadLigaments, LawErrors) {
  expect_law_refused("law = @\"quadratc\"\nstiffness = 1\nslack_length = 1\n", "law", "\"quadratc\"",
                     "did you mean \"quadratic\"?");
  expect_refused("[ligament.AAC]\n" + kFrom + "\n" + kTo + "\nlaw = \"quadratic\"",
                 "[ligament.@AAC]\n" + kFrom + "\n" + kTo, "ligament.AAC.law", "", "is missing");
}

TEST(ReadLigaments, StiffnessErrors) {
  expect_law_refused("law = \"quadratic\"\nstiffness = @-2\nslack_length = 1\n", "stiffness", "-2", "must be > 0 N");
  expect_law_refused("law = \"linear\"\nstiffness = @0\nslack_length = 1\n", "stiffness", "0", "must be > 0 N");
  expect_law_refused("law = \"spring\"\nstiffness = @0\nslack_length = 1\n", "stiffness", "0", "must be > 0 N/mm");
  expect_law_refused("law = \"spring\"\nstiffness = @true\nslack_length = 1\n", "stiffness", "true",
                     "must be a number, in N/mm");
  expect_law_refused("law = \"spring\"\nstiffness = @nan\nslack_length = 1\n", "stiffness", "nan", "finite");
  const std::string abdel = "law = \"abdel-rahman\"\ntransition_strain = 0.06\nslack_length = 20\n";
  expect_law_refused(abdel + "stiffness = 1\ntoe_stiffness = @0.0\n", "toe_stiffness", "0.0", "must be > 0 N/mm^2");
  expect_law_refused("law = \"quadratic\"\nstiffness = 2\nslack_length = 1\n@toe_stiffness = 2\n", "toe_stiffness", "2",
                     "is no key of a quadratic ligament");
  expect_law_refused("law = \"quadratic\"\n@stifness = 2\nstiffness = 2\nslack_length = 1\n", "stifness", "2",
                     "did you mean \"stiffness\"?");
  for (const auto& [law, key] : {std::pair("abdel-rahman", "toe_stiffness"), std::pair("spring", "stiffness"),
                                 std::pair("blankevoort", "transition_strain"), std::pair("table", "points")}) {
    std::string keys;
    const std::string name = law;
    if (name != "table" && std::string(key) != "stiffness") keys += "stiffness = 1\n";
    if (name == "abdel-rahman") keys += "transition_strain = 1\n";
    expect_refused("[ligament.AAC]\n" + kFrom + "\n" + kTo + "\n" + kLaw,
                   "[ligament.@AAC]\n" + kFrom + "\n" + kTo + "\nlaw = \"" + name + "\"\nslack_length = 20\n" + keys,
                   std::string("ligament.AAC.") + key, "", "is missing");
  }
}

TEST(ReadLigaments, TransitionStrain) {
  const std::string law = "law = \"blankevoort\"\nstiffness = 1\nslack_length = 20\n";
  expect_law_refused(law + "transition_strain = @0\n", "transition_strain", "0", "must be > 0");
  expect_law_refused(law + "transition_strain = @-0.03\n", "transition_strain", "-0.03", "must be > 0");
  expect_law_refused(
      "law = \"abdel-rahman\"\nstiffness = 1\ntoe_stiffness = 1\nslack_length = 20\ntransition_strain = "
      "@-1\n",
      "transition_strain", "-1", "must be > 0");
  expect_law_refused("law = \"spring\"\nstiffness = 1\nslack_length = 20\n@transition_strain = 1\n",
                     "transition_strain", "1", "is no key of a spring");
}

TEST(ReadLigaments, TablePoints) {
  const std::string law = "law = \"table\"\nslack_length = 20\n";
  expect_law_refused(law + "points = @[[0, 0]]\n", "points", "[[0, 0]]", "needs at least two points");
  expect_law_refused(law + "points = @7\n", "points", "7", "must be points [[strain, N], ...]");
  expect_law_refused(law + "points = [[0, 0], @[1]]\n", "points[2]", "[1]", "must be a point [strain, N]");
  expect_law_refused(law + "points = [[0, 0], [@0, 1]]\n", "points[2][1]", "0", "strains must increase");
  expect_law_refused(law + "points = [[0, 0], [@-0.5, 1]]\n", "points[2][1]", "-0.5", "strains must increase");
  expect_law_refused(law + "points = [[0, 0], [1, @-3]]\n", "points[2][2]", "-3", "must be >= 0 N");
  expect_law_refused(law + "points = [[@-1, 0], [0, 0], [1, 1]]\n", "points[1][1]", "-1", "must be > -1");
  expect_law_refused(law + "points = [[0, 0], [1, @inf]]\n", "points[2][2]", "inf", "finite");
  expect_law_refused(law + "points = [[0, 0], [1, 1]]\n@stiffness = 3\n", "stiffness", "3",
                     "is no key of a table ligament");
  expect_law_refused("law = \"table\"\npoints = [[0, 0], [1, 10]]\nreference_force = @11\n", "reference_force", "11",
                     "must be a force of the table, from 0 to 10 N");
}

TEST(ReadLigaments, RestErrors) {
  const std::string linear = "law = \"linear\"\nstiffness = 1\n", spring = "law = \"spring\"\nstiffness = 1\n";
  expect_law_refused(linear + "slack_length = @0\n", "slack_length", "0", "must be > 0 mm");
  expect_law_refused(linear + "slack_length = @-1\n", "slack_length", "-1", "must be > 0 mm");
  expect_law_refused(spring + "slack_length = @-1\n", "slack_length", "-1", "must be >= 0 mm");
  expect_law_refused(linear + "reference_strain = @-1\n", "reference_strain", "-1", "must be > -1");
  expect_law_refused(linear + "reference_strain = @-inf\n", "reference_strain", "-inf", "finite");
  expect_law_refused(linear + "reference_force = @-1\n", "reference_force", "-1", "must be >= 0 N");
  expect_law_refused(linear + "slack_length = 20\nreference_strain = @0.1\n", "reference_strain", "0.1",
                     "only one of slack_length, reference_strain and reference_force");
  expect_refused("[ligament.AAC]\n" + kFrom + "\n" + kTo + "\n" + kLaw,
                 "[ligament.@AAC]\n" + kFrom + "\n" + kTo + "\n" + linear, "ligament.AAC.slack_length", "",
                 "give one of slack_length, reference_strain, reference_force");
}

TEST(ReadLigaments, ViaPointsInOrder) {
  const LigamentDef l =
      ligament(kLaw + "via = [{ body = \"tibia\", point = [1, 2, 3] }, { body = \"femur\", point = [4, 5, 6] }]\n");
  ASSERT_EQ(l.via.size(), 2u);
  EXPECT_EQ(l.via[0].body, 0);
  EXPECT_EQ(l.via[1].body, 1);
  EXPECT_TRUE(l.via[1].point.isApprox(Vec3(4e-3, 5e-3, 6e-3), 1e-15));
}

TEST(ReadLigaments, ViaPointsThatCannotBe) {
  expect_law_refused(kLaw + "via = @50\n", "via", "50", "via points");
  expect_law_refused(kLaw + "via = [{ body = @\"fibula\", point = [1, 2, 3] }]\n", "via[1].body", "\"fibula\"",
                     "unknown body");
  const std::string head = "]\n" + kFrom + "\n" + kTo + "\n" + kLaw;
  expect_refused("[ligament.AAC" + head,
                 "[ligament.@AAC" + head + "via = [{ body = \"tibia\", point = [-6.04, 4.0, -3.0] }]\n", "ligament.AAC",
                 "", "via point 1 and its last end coincide at the reference pose");
}

TEST(ReadLigaments, DampingOutsideMotion) {
  expect_law_refused(kLaw + "@damping = 50\n", "damping", "50", "only in a scene with [dynamics]");
}

}  // namespace
}  // namespace genu::scene_test
