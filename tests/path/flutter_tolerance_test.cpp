#include "genu/path/flutter_tolerance.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(FlutterTolerance, IsAShareOfTheSubstepWhereLayersActAndThatOfOtherEventsElsewhere) {
  JointModel model;
  EXPECT_EQ(flutter_tolerance(model, 1e-9, 0.1), 1e-9);
  model.layers.emplace_back();
  EXPECT_EQ(flutter_tolerance(model, 1e-9, 0.1), 0.1 / 128);
  EXPECT_EQ(flutter_tolerance(model, 1e-9, 1e-8), 1e-9);
}

}  // namespace
}  // namespace genu
