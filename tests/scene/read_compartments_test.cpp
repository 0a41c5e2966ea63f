// Compartments of a scene: names of contacts and their regions.
#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

const std::string kAnchor = "[load.push]";

TEST(ReadCompartments, NameContactsAndRegions) {
  const auto c =
      good(edited(kAnchor,
                  "[compartment.inside]\ndirect = [\"medial.inner\"]\nmeniscal = [\"medial.outer\"]\n" + kAnchor))
          .compartments.at(0);
  EXPECT_EQ(c.name, "inside");
  EXPECT_EQ(c.direct, std::vector<std::string>{"medial.inner"});
  EXPECT_EQ(c.meniscal, std::vector<std::string>{"medial.outer"});
}

TEST(ReadCompartments, Errors) {
  expect_refused(kAnchor, "[compartment.inside]\nmeniscal = [@\"medial.iner\"]\n" + kAnchor,
                 "compartment.inside.meniscal[1]", "\"medial.iner\"", "did you mean \"medial.inner\"?");
  expect_refused(kAnchor, "[compartment.@inside]\ndirect = [\"medial\"]\n" + kAnchor, "compartment.inside.meniscal", "",
                 "is missing");
  expect_refused(kAnchor, "[compartment.@medial]\nmeniscal = [\"medial\"]\n" + kAnchor, "compartment.medial", "",
                 "its result column medial.force_N is also one of contact.medial");
}

TEST(ReadCompartments, NothingCountsTwice) {
  for (const char* lists :
       {"direct = [\"medial\"]\nmeniscal = [\"medial\"]\n", "meniscal = [\"medial.inner\", \"medial\"]\n",
        "meniscal = [\"medial.inner\", \"medial.inner\"]\n"})
    expect_refused(kAnchor, std::string("[compartment.@inside]\n") + lists + kAnchor, "compartment.inside", "",
                   " twice");
}

TEST(ReadCompartments, AContactThatIsLeftOutIsNone) {
  std::string text = edited(kAnchor, "[compartment.inside]\nmeniscal = [\"medial.inner\"]\n" + kAnchor);
  text = edited("model = \"rigid\"\n", "model = \"rigid\"\nenabled = false\n", text);
  EXPECT_TRUE(good(text).compartments.at(0).meniscal.empty());
}

}  // namespace
}  // namespace genu::scene_test
