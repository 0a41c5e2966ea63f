#include "genu/model/parameters.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/scene_model.h"

namespace genu {
namespace {

std::vector<Parameter> parameters(const std::string& more) {
  return parameters_of(test::scene_model(test::bone_on_ground() + more).scene);
}

std::string names(const std::vector<Parameter>& parameters) {
  std::string out;
  for (const Parameter& p : parameters) out += p.name + " ";
  return out;
}

TEST(Parameters, AreNamedByTheirKeys) {
  EXPECT_EQ(names(parameters(test::ligament("l", "[1, 0, 0]", "[0, 0, 9]",
                                            "law = \"quadratic\"\nstiffness = 5\nreference_strain = 0.1"))),
            "l.stiffness l.reference_strain l.from.x l.from.y l.from.z l.to.x l.to.y l.to.z ");
  EXPECT_EQ(names(parameters(test::surface("s", "bone", "polynomial", "terms = [[2, 0, 0.1], [0, 1, 0.3]]"))),
            "s.terms.2.0 s.terms.0.1 s.origin.x s.origin.y s.origin.z s.offset ");
  EXPECT_EQ(names(parameters(test::surface("s", "bone", "torus", "major_radius = 3\nminor_radius = 1"))),
            "s.major_radius s.minor_radius s.origin.x s.origin.y s.origin.z s.offset ");
  EXPECT_EQ(names(parameters("[load.turn]\non = \"j.a\"\nvalue = 2\n" +
                             test::step("prescribe = { \"j.b\" = 0.1, \"j.x\" = [0, 2] }"))),
            "turn.value turn.factor j.b j.x ");
  EXPECT_EQ(names(parameters(test::load("f", "force = [1, 2, 3]"))),
            "f.force.x f.force.y f.force.z f.moment.x f.moment.y f.moment.z f.point.x f.point.y f.point.z f.factor ");
}

TEST(Parameters, HaveUnitsAndStandardChanges) {
  const auto all =
      parameters(test::ligament("l", "[1, 0, 0]", "[0, 0, 9]", "law = \"spring\"\nstiffness = 5\nslack_length = 8") +
                 test::surface("s", "bone", "polynomial", "terms = [[2, 0, 0.1], [1, 0, 0.3], [0, 0, 1]]"));
  const auto find = [&](const std::string& name) {
    const auto it = std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.name == name; });
    EXPECT_NE(it, all.end()) << name;
    return *it;
  };
  EXPECT_EQ(find("l.stiffness").unit, "N/mm");
  EXPECT_DOUBLE_EQ(find("l.stiffness").change, 50);  // N/m: 1 % of 5 N/mm
  EXPECT_DOUBLE_EQ(find("l.slack_length").change, 0.08e-3);
  EXPECT_DOUBLE_EQ(find("l.from.y").change, 1e-3);
  // 1 mm at 10 mm: 0.01 / mm, 0.1, 1 mm
  EXPECT_EQ(find("s.terms.2.0").change_text, "0.01 mm^-1");
  EXPECT_DOUBLE_EQ(find("s.terms.2.0").change, 10);
  EXPECT_EQ(find("s.terms.1.0").change_text, "0.1");
  EXPECT_EQ(find("s.terms.0.0").change_text, "1 mm");
  for (const Parameter& p : all) EXPECT_GT(p.change, 0) << p.name;
}

TEST(Parameters, OfTheSameNameAreToldApart) {
  const std::string all = names(
      parameters(test::ligament("f", "[1, 0, 0]", "[0, 0, 9]", "law = \"spring\"\nstiffness = 5\nslack_length = 1") +
                 "[body.shin]\n[joint.f]\ntype = \"revolute\"\nparent = \"bone\"\nchild = \"shin\"\naxis = [1, 0, 0]\n"
                 "stiffness = 3\n"));
  EXPECT_EQ(all.rfind("ligament.f.stiffness f.slack_length ", 0), 0u) << all;
  EXPECT_NE(all.find(" joint.f.stiffness "), std::string::npos) << all;
}

}  // namespace
}  // namespace genu
