// Numbers that rules forbid are refused; ligaments, contacts and loads are left out.
#include "genu/api/scene_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/knee.h"

namespace genu::api {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(SceneNumbers, GivesThoseOfAFileWithoutWhatIsLeftOut) {
  const Scene knee = load(knee_file());
  const std::string before = csv(knee);
  const Scene cut = knee.without("ligament.A*C");
  std::string text = text_of(knee_file());
  for (const char* name : {"AAC", "APC", "AMC"}) text = without_table(text, std::string("ligament.") + name);
  EXPECT_EQ(csv(cut), csv(parse(text, knee_file())));
  EXPECT_THAT(cut.ligaments(), ElementsAre("PAC", "PPC", "LC", "PMC"));
  EXPECT_THAT(cut.changes(), ElementsAre("without ligament.A*C: 3 ligaments"));
  EXPECT_EQ(csv(knee), before);
  EXPECT_EQ(csv(knee.without("medial")),
            csv(parse(without_table(text_of(knee_file()), "contact.medial"), knee_file())));
}

TEST(SceneNumbers, KeepsStepsFactorsOfTheLoadsThatStay) {
  const std::string loads =
      "\n[load.a]\nbody = \"femur\"\nforce = [1, 0, 0]\n[load.b]\nbody = \"femur\"\nforce = [0, 2, 0]\n";
  const std::string factors = "load = { a = [0, 1], b = [1, 0] }\n";
  const std::string text = text_of(knee_file());
  const auto step = text.find("[[step]]\n");
  ASSERT_NE(step, std::string::npos);
  const auto with = [&](const std::string& these, const std::string& those) {
    return parse(text.substr(0, step) + these + "\n[[step]]\n" + those + text.substr(step + 9), knee_file());
  };
  EXPECT_EQ(csv(with(loads, factors).without("load.a")),
            csv(with("\n[load.b]\nbody = \"femur\"\nforce = [0, 2, 0]\n", "load = { b = [1, 0] }\n")));
}

TEST(SceneNumbers, KeepsTheDriversThatStayAndNeedsOne) {
  const std::string text = text_of(knee_file());
  const auto step = text.find("[[step]]\n");
  ASSERT_NE(step, std::string::npos);
  const auto pull = [](const std::string& name) {
    return "\n[load." + name + "]\nbody = \"femur\"\nforce = [0, 1, 0]\npoint = [0, 0, 30]\n";
  };
  const auto driven = [&](const std::string& loads, const std::string& drive) {
    return parse(text.substr(0, step) + loads +
                     "\n[[step]]\nprescribe = { \"knee.flexion\" = [10, 12] }\nincrements = 2\ndrive = " + drive + "\n",
                 knee_file());
  };
  const Scene knee = driven(pull("a") + pull("b") + pull("c"), "[\"b\", \"c\"]");
  EXPECT_EQ(csv(knee.without("load.a")), csv(driven(pull("b") + pull("c"), "[\"b\", \"c\"]")));
  EXPECT_EQ(csv(knee.without("load.b")), csv(driven(pull("a") + pull("c"), "\"c\"")));
  EXPECT_THAT(refusal_of([&] { (void)knee.without("load.*"); }),
              HasSubstr("would leave nothing that holds knee.flexion"));
}

TEST(SceneNumbers, RefusesWhatItsRulesForbidAndStaysAsItWas) {
  Scene knee = load(knee_file());
  EXPECT_THAT(refusal_of([&] { knee.set("AAC.stiffness", -2); }),
              HasSubstr("AAC.stiffness = -2: stiffness must be > 0"));
  EXPECT_THAT(refusal_of([&] { knee.set("AAC.stiffness", std::nan("")); }), HasSubstr("must be > 0"));
  EXPECT_THAT(refusal_of([&] {
                knee.set("A?C.stiffness", std::vector<double>{1, 2, -3});
              }),
              HasSubstr("AMC.stiffness"));
  EXPECT_THAT(refusal_of([&] { knee.set("A?C.stiffness", std::vector<double>{1, 2}); }), HasSubstr("means 3 numbers"));
  EXPECT_THAT(refusal_of([&] { knee.set("AAC.stifness", 2); }), HasSubstr("did you mean \"AAC.stiffness\""));
  EXPECT_THAT(refusal_of([&] { (void)knee.value("A?C.stiffness"); }), HasSubstr("means 3 numbers, not one"));
  EXPECT_THAT(refusal_of([&] { (void)knee.without("XYZ*"); }),
              HasSubstr("no ligament, bundle, bushing, contact, load or body"));
  EXPECT_TRUE(knee.changes().empty());
  EXPECT_EQ(csv(knee), csv(load(knee_file())));
}

}  // namespace
}  // namespace genu::api
