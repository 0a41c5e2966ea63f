#include "genu/core/program_hash.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(ProgramHash, StaysTheSame) {
  EXPECT_EQ(program_hash().size(), 32u);
  EXPECT_EQ(program_hash(), program_hash());
}

}  // namespace
}  // namespace genu
