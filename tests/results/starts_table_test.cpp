#include "genu/results/starts_table.h"

#include <gtest/gtest.h>

#include "support/scene_model.h"

namespace genu {
namespace {

TEST(StartsTable, OneRowAnEquilibriumThenOneAFailedStart) {
  const auto s = test::scene_model(test::bone_on_ground());
  StartSearch search;
  search.count = 4;
  Equilibrium e;
  e.pose.state = reference_state(s.model);
  e.pose.state.coordinates[0] = {0.5, 0, 0, 0, 0, 0.02};
  e.report.status = PoseStatus::ok;
  e.energy = 0.25;
  e.stability.smallest = -0.5;
  e.stability.verdict = Stability::Verdict::unstable;
  e.starts = {2, 4};
  e.first_start = 2;
  e.found = Equilibrium::Found::downhill;
  search.equilibria = {e, e};
  search.equilibria[1].energy.reset();
  search.equilibria[1].stability.complex_pair = search.equilibria[1].stability.flutter = true;
  search.failed.push_back({3, {}});
  const ResultTable t = starts_table(s.scene, s.model, search);
  ASSERT_EQ(t.rows(), 3u);
  EXPECT_EQ(t.number(0, "equilibrium"), 1);
  EXPECT_EQ(t.number(1, "equilibrium"), 2);
  EXPECT_EQ(t.number(0, "starts"), 2);
  EXPECT_EQ(t.number(0, "first_start"), 2);
  EXPECT_DOUBLE_EQ(t.number(0, "j.a_deg"), 90 / M_PI);
  EXPECT_DOUBLE_EQ(t.number(0, "j.z_mm"), 20);
  EXPECT_DOUBLE_EQ(t.number(0, "energy_Nmm"), 250);
  EXPECT_DOUBLE_EQ(t.number(0, "stability.min_eigenvalue_Nmm"), -500);
  const auto word = [&](std::size_t row, const char* column) {
    return std::get<std::string>(t.at(row, t.column_index(column)));
  };
  EXPECT_EQ(word(0, "found"), "downhill");
  EXPECT_EQ(word(0, "stability"), "unstable");
  EXPECT_EQ(word(1, "stability"), "flutter");
  EXPECT_TRUE(std::isnan(t.number(1, "energy_Nmm")));
  EXPECT_EQ(word(2, "status"), "no_equilibrium");
  EXPECT_EQ(t.number(2, "first_start"), 3);
  EXPECT_TRUE(std::isnan(t.number(2, "equilibrium")));
}

}  // namespace
}  // namespace genu
