#include "genu/sweep/finished_rows.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

TEST(FinishedRows, AreThereAtTheNextStart) {
  const test::TemporaryFolder folder;
  {
    FinishedRows rows(folder / "a.part", "study");
    rows.add(7, "a,\"b c\",1.5");
    rows.add(3, "x");
  }
  FinishedRows again(folder / "a.part", "study");
  const auto earlier = again.take_earlier();
  ASSERT_EQ(earlier.size(), 2u);
  EXPECT_EQ(earlier.at(7), "a,\"b c\",1.5");
  EXPECT_TRUE(again.take_earlier().empty());
  EXPECT_EQ(again.problem(), "");
}

TEST(FinishedRows, LeaveOutOtherStudiesAndBrokenLines) {
  const test::TemporaryFolder folder;
  {
    FinishedRows rows(folder / "a.part", "study");
    rows.add(1, "one");
    rows.add(2, "two");
  }
  folder.write("a.part", test::with_first(test::read_file(folder / "a.part"), "one", "won"));
  {
    FinishedRows rows(folder / "a.part", "study");
    EXPECT_EQ(rows.take_earlier().size(), 1u);
    rows.add(3, "three");
  }
  EXPECT_EQ(FinishedRows(folder / "a.part", "study").take_earlier().size(), 2u);
  EXPECT_TRUE(FinishedRows(folder / "a.part", "other").take_earlier().empty());
}

TEST(FinishedRows, BelongToOneProcessAtATime) {
  const test::TemporaryFolder folder;
  FinishedRows first(folder / "a.part", "study");
  FinishedRows second(folder / "a.part", "study");
  EXPECT_TRUE(test::contains(second.problem(), "another process computes this shard"));
  EXPECT_TRUE(second.taken());
  EXPECT_FALSE(first.taken());
  second.add(1, "nothing");
}

}  // namespace
}  // namespace genu
