// The multipliers of a state when what is prescribed changes from step to step.
#include "genu/model/state.h"

#include <gtest/gtest.h>

#include "support/scene_model.h"

namespace genu {
namespace {

TEST(State, MultipliersOfJointsAreKeptWhenThePrescribedChange) {
  const test::SceneModel s = test::scene_model(test::bone_on_ground() + R"(
[body.tool]
[joint.hinge]
type = "revolute"
parent = "bone"
child = "tool"
axis = [0, 0, 1]
)");
  const auto prescribing = [](int count) {
    Target target;
    for (int i = 0; i < count; ++i) target.prescribed.push_back({{0, i}, 0});
    return target;
  };
  State state = reference_state(s.model);
  fit_multipliers(s.model, prescribing(1), state);
  EXPECT_EQ(state.multipliers, std::vector<double>(6, 0));
  state.multipliers = {1, 11, 12, 13, 14, 15};
  fit_multipliers(s.model, prescribing(3), state);
  EXPECT_EQ(state.multipliers, (std::vector<double>{1, 0, 0, 11, 12, 13, 14, 15}));
  fit_multipliers(s.model, prescribing(0), state);
  EXPECT_EQ(state.multipliers, (std::vector<double>{11, 12, 13, 14, 15}));
  EXPECT_EQ(constraint_count(s.model, prescribing(2)), 7u);
  EXPECT_TRUE(is_rotation(s.model, prescribing(2), 3)) << "hinge: two rotations, then three translations";
  EXPECT_FALSE(is_rotation(s.model, prescribing(2), 4));
}

}  // namespace
}  // namespace genu
