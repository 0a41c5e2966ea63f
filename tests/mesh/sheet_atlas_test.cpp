// Sheets that several threads ask for at once are the same for all of them.
#include "genu/mesh/sheet_atlas.h"

#include <thread>

#include <gtest/gtest.h>

#include "support/layers.h"

namespace genu {
namespace {

TEST(SheetAtlas, PiecesHoldEachTriangleOnce) {
  const auto tree = std::make_shared<const TriangleTree>(test::ball(0.02, 1e-3));
  const SheetAtlas atlas(tree, 4e-3);
  ASSERT_GT(atlas.pieces(), 10);
  std::vector<int> count(static_cast<std::size_t>(atlas.pieces()), 0);
  for (int place = 0; place < tree->size(); ++place) {
    ASSERT_GE(atlas.piece_of(place), 0);
    ++count.at(static_cast<std::size_t>(atlas.piece_of(place)));
  }
  for (const int c : count) EXPECT_GT(c, 0);
}

TEST(SheetAtlas, IsTheSameForAllThreads) {
  const auto tree = std::make_shared<const TriangleTree>(test::ball(0.02, 0.6e-3));
  const SheetAtlas atlas(tree, 4e-3);
  std::vector<std::vector<const TriangleSheet*>> seen(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < seen.size(); ++i)
    threads.emplace_back([&, i] {
      for (int k = 0; k < atlas.pieces(); ++k) {
        const int piece = i % 2 == 0 ? k : atlas.pieces() - 1 - k;
        seen[i].push_back(&atlas.sheet(piece));
        EXPECT_TRUE(seen[i].back()->good());
      }
    });
  for (std::thread& t : threads) t.join();
  for (int k = 0; k < atlas.pieces(); ++k)
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const auto piece = static_cast<std::size_t>(i % 2 == 0 ? k : atlas.pieces() - 1 - k);
      EXPECT_EQ(seen[i][piece], &atlas.sheet(k));
    }
}

TEST(SheetAtlas, OfNoTriangles) {
  const SheetAtlas atlas(std::make_shared<const TriangleTree>(), 4e-3);
  EXPECT_EQ(atlas.pieces(), 0);
}

}  // namespace
}  // namespace genu
