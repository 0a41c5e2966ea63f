#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

TEST(ReadMomentArms, CoordinatesOrErrors) {
  const std::string title = "title = \"test knee\"\n";
  const Scene scene = good(edited(title, title + "moment_arms = [\"knee.flexion\", \"knee.x\"]\n"));
  ASSERT_EQ(scene.moment_arms.size(), 2u);
  EXPECT_EQ(scene.moment_arms[1], (CoordinateRef{0, 3}));
  const auto refused = [&](const std::string& value, const std::string& key, const std::string& found,
                           const std::string& rule) {
    expect_refused(title, title + "moment_arms = " + value + "\n", key, found, rule);
  };
  refused("@\"knee.flexion\"", "moment_arms", "\"knee.flexion\"", "must be a list of coordinates");
  refused("@[]", "moment_arms", "[]", "must be a list of coordinates");
  refused("[@\"knee.flexon\"]", "moment_arms[1]", "\"knee.flexon\"", "did you mean \"knee.flexion\"?");
  refused("[@3]", "moment_arms[1]", "3", "must be");
  refused("[\"knee.x\", @\"knee.x\"]", "moment_arms[2]", "\"knee.x\"", "is named twice");
}

}  // namespace
}  // namespace genu::scene_test
