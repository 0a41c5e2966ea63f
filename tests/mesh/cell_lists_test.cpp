// The lists must name every ball that holds a point; brute force is the truth.
#include "genu/mesh/cell_lists.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(CellLists, NameEveryBallThatHoldsAPoint) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-1, 1), size(0.01, 0.3);
  std::vector<Vec3> centres;
  std::vector<double> radii;
  for (int i = 0; i < 300; ++i) {
    centres.push_back(Vec3{place(random), place(random), place(random)});
    radii.push_back(size(random));
  }
  const CellLists cells(centres, radii, 0.1);
  for (int k = 0; k < 5000; ++k) {
    const Vec3 x = 1.5 * Vec3{place(random), place(random), place(random)};
    const auto list = cells.at(x);
    EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
    for (int i = 0; i < 300; ++i) {
      if ((x - centres[i]).norm() >= radii[i]) continue;
      EXPECT_TRUE(std::binary_search(list.begin(), list.end(), i)) << "ball " << i << " of point " << x.transpose();
    }
  }
}

TEST(CellLists, KeepTheirSizeWhateverTheCell) {
  const std::vector<Vec3> centres = {Vec3::Zero(), Vec3(1, 1, 1)};
  const std::vector<double> radii = {1e-3};
  const CellLists cells(centres, radii, 1e-6);
  EXPECT_LE(cells.cell_count(), 1 << 22);
  EXPECT_TRUE(std::ranges::count(cells.at(Vec3(0.9995, 1, 1)), 1));
  EXPECT_TRUE(cells.at(Vec3(0.5, 0.5, 0.5)).empty());
  EXPECT_TRUE(cells.at(Vec3(3, 0, 0)).empty());
  EXPECT_TRUE(cells.at(Vec3::Constant(std::nan(""))).empty());
  EXPECT_TRUE(CellLists(std::span<const Vec3>(), radii, 1).at(Vec3::Zero()).empty());
}

}  // namespace
}  // namespace genu
