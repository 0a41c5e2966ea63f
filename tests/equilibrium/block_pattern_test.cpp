// The order of elimination: a chain and a ring stay as sparse as they are, and a row of many bodies comes last.
#include "genu/equilibrium/block_pattern.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace genu {
namespace {

void couple(MatX& m, int a, int b) { m.block<6, 6>(6 * a, 6 * b) = m.block<6, 6>(6 * b, 6 * a) = Mat6::Ones(); }

BlockPattern pattern_of(const MatX& matrix, int bodies) {
  Coupling coupling(bodies, static_cast<int>(matrix.rows()) - 6 * bodies);
  EXPECT_TRUE(coupling.look_at(matrix));
  EXPECT_FALSE(coupling.look_at(matrix)) << "nothing changed";
  return block_pattern(coupling);
}

std::size_t blocks_after_pivots(const BlockPattern& pattern) {
  std::size_t out = 0;
  for (const auto& later : pattern.later) out += later.size();
  return out;
}

TEST(BlockPattern, ChainsFillNothingAndRingsOneBlockABody) {
  const int n = 12;
  MatX m = MatX::Zero(6 * n, 6 * n);
  for (int i = 0; i < n; ++i) couple(m, i, i);
  for (int i = 1; i < n; ++i) couple(m, i - 1, i);
  EXPECT_EQ(blocks_after_pivots(pattern_of(m, n)), 11u);
  couple(m, 0, n - 1);
  EXPECT_EQ(blocks_after_pivots(pattern_of(m, n)), 12u + 9u);
}

TEST(BlockPattern, TheBodyThatAllMeetComesLast) {
  const int n = 15;
  MatX m = MatX::Zero(6 * n, 6 * n);
  for (int i = 0; i < n; ++i) {
    couple(m, i, i);
    couple(m, 4, i);
  }
  const BlockPattern pattern = pattern_of(m, n);
  EXPECT_EQ(blocks_after_pivots(pattern), 14u);
  // The last two differ in nothing.
  const auto& rows = pattern.rows;
  EXPECT_TRUE(rows[13].front() == 24 || rows[14].front() == 24);
}

TEST(BlockPattern, FurtherRowsComeWithTheirFirstBody) {
  const int n = 11;
  MatX m = MatX::Zero(6 * n + 2, 6 * n + 2);
  for (int i = 0; i < n; ++i) couple(m, i, i);
  for (int i = 1; i < n; ++i) couple(m, i - 1, i);
  m(6 * n, 6 * 5) = m(6 * 5, 6 * n) = 1;
  m.row(6 * n + 1).setOnes();  // of an arc-length step
  m.col(6 * n + 1).setOnes();
  const BlockPattern pattern = pattern_of(m, n);
  for (std::size_t k = 0; k < pattern.rows.size(); ++k) {
    const auto& rows = pattern.rows[k];
    const auto has = [&](int row) { return std::find(rows.begin(), rows.end(), row) != rows.end(); };
    EXPECT_EQ(has(6 * n), has(30));
    EXPECT_EQ(has(6 * n + 1), k + 1 == pattern.rows.size());
  }
}

TEST(BlockPattern, EveryRowHasOneNode) {
  const int n = 10;
  MatX m = MatX::Zero(6 * n + 8, 6 * n + 8);
  for (int i = 0; i < n; ++i) couple(m, i, i);
  for (int i = 0; i < 8; ++i) m(6 * n + i, 13) = 1;  // more than six of one body
  std::vector<int> all;
  for (const auto& rows : pattern_of(m, n).rows) all.insert(all.end(), rows.begin(), rows.end());
  std::sort(all.begin(), all.end());
  ASSERT_EQ(all.size(), 68u);
  for (int i = 0; i < 68; ++i) EXPECT_EQ(all[static_cast<std::size_t>(i)], i);
}

}  // namespace
}  // namespace genu
