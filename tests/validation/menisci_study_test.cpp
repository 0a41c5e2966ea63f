// The experiment of Guess et al. (2010) on the measured knee with its menisci (meshes/smith2019/DRIVEN.md).
#include "studies/menisci_study.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/data.h"
#include "support/places.h"
#include "validation/study_files.h"

namespace genu::studies {
namespace {

TEST(MenisciStudy, AForceOnTheTibiaDrivesTheKneeSteeperThanASine) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-med-meniscus-sup.stl");
  const std::string meshes = genu::test::source_folder() + "/meshes/", folder = meshes + "smith2019";
  Diagnostics out;
  const auto study = solve_menisci(folder, meshes + "leskovar2019", out);
  ASSERT_TRUE(study && study->stable && study->knee.complete && study->hinges.complete);
  EXPECT_GT(study->knee.steepest, 1.3);
  EXPECT_NEAR(study->hinges.steepest, 1, 0.05);
  // Nothing is left of a period in the next: the elastic knee has one pose for a force.
  const std::vector<double>&time = study->knee.time, &angle = study->knee.angle;
  ASSERT_EQ(time.size(), 171u);
  for (std::size_t row = 10; row + 80 < time.size(); ++row) EXPECT_NEAR(angle[row], angle[row + 80], 1e-6) << row;
  test::expect_same_files(folder, menisci_files(*study));
}

}  // namespace
}  // namespace genu::studies
