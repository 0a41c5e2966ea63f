#include "genu/core/length_units.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(LengthUnits, AreThoseOfTheSystemAndTheInch) {
  EXPECT_EQ(metres_in("mm"), 1e-3);
  EXPECT_EQ(metres_in("m"), 1.0);
  EXPECT_EQ(metres_in("cm"), 1e-2);
  EXPECT_EQ(metres_in("inch"), 0.0254);
  EXPECT_EQ(metres_in("um"), 1e-6);
  EXPECT_EQ(metres_in("feet"), std::nullopt);
  EXPECT_EQ(metres_in(""), std::nullopt);
}

TEST(LengthUnits, HaveNamesThatLeadBack) {
  for (const std::string& name : length_unit_names()) EXPECT_EQ(length_unit_name(metres_in(name).value()), name);
}

}  // namespace
}  // namespace genu
