#include "genu/equilibrium/held_drivers.h"

#include <gtest/gtest.h>

#include "genu/model/build_model.h"

namespace genu {
namespace {

TEST(HeldDrivers, AreDeadLoadsForASeedAndFactorsAgainAfterIt) {
  const JointModel model;
  Target target;
  target.load_factors = {1, 0, 0};
  target.prescribed.push_back({CoordinateRef{0, 0}, 0.3});
  target.prescribed.push_back({CoordinateRef{0, 1}, 0.1, {1, 2}});
  State state;
  const HeldDrivers fresh(model, target, state);
  EXPECT_EQ(state.multipliers, (std::vector<double>{0, 0})) << "reactions";
  EXPECT_EQ(fresh.target().load_factors, (std::vector<double>{1, 1, 1})) << "the search begins at the factor 1";
  EXPECT_TRUE(fresh.target().prescribed[1].drivers.empty());

  state.multipliers = {7, 2.5};
  const HeldDrivers held(model, target, state);
  EXPECT_EQ(held.target().load_factors, (std::vector<double>{1, 2.5, 2.5}));
  EXPECT_EQ(held.target().prescribed[1].value, 0.1);
  EXPECT_EQ(state.multipliers, (std::vector<double>{7, 0}));
  EXPECT_EQ(load_factor(held.target(), state, 2), 2.5);
  state.multipliers = {8, -40};  // what a seed has found
  held.give_back(state);
  EXPECT_EQ(state.multipliers, (std::vector<double>{8, 2.5}));
  EXPECT_EQ(load_factor(target, state, 0), 1);
  EXPECT_EQ(load_factor(target, state, 2), 2.5);
}

}  // namespace
}  // namespace genu
