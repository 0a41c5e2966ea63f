// The question of Blankevoort and Huiskes (1991), asked of the measured knee (meshes/lenhart2015/STUDY-wrapping.md).
#include "studies/wrapping_study.h"

#include <gtest/gtest.h>

#include "support/data.h"
#include "support/places.h"
#include "validation/study_files.h"

namespace genu::studies {
namespace {

const std::string kKneeFolder = genu::test::source_folder() + "/meshes/lenhart2015";

TEST(WrappingStudy, TheEdgeHelpsAgainstValgusAndLeavesRotationAlone) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl");
  Diagnostics out;
  const auto study = solve_wrapping(kKneeFolder, out);
  ASSERT_TRUE(study && study->complete());
  const auto open = WrappingStudy::opening(study->straight), open_wrapped = WrappingStudy::opening(study->wrapped);
  const auto turn = WrappingStudy::rotation_laxity(study->straight);
  const auto turn_wrapped = WrappingStudy::rotation_laxity(study->wrapped);
  for (std::size_t row = 0; row < open.size(); ++row) {
    EXPECT_LT(open_wrapped[row], open[row]) << row;
    EXPECT_GT(study->wrapped[WrappingStudy::valgus].ligament[row], study->straight[WrappingStudy::valgus].ligament[row])
        << row;
    EXPECT_NEAR(turn_wrapped[row] / turn[row], 1, 0.05) << row;
  }
  test::expect_same_files(kKneeFolder, wrapping_files(*study));
}

}  // namespace
}  // namespace genu::studies
