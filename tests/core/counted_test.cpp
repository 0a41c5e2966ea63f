#include "genu/core/counted.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(Counted, OneIsOneAndAllElseIsMany) {
  EXPECT_EQ(counted(1, "contact"), "1 contact");
  EXPECT_EQ(counted(0, "ligament"), "0 ligaments");
  EXPECT_EQ(counted(12, "ligament"), "12 ligaments");
  EXPECT_EQ(counted(2, "body"), "2 bodies");
}

}  // namespace
}  // namespace genu
