#include "genu/assemble/long_errors.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

std::size_t listed(const Diagnostics& out, Diagnostic::Severity severity) {
  std::size_t count = 0;
  for (const Diagnostic& d : out.items()) count += d.severity == severity ? 1 : 0;
  return count;
}

TEST(LongErrors, TheFirstAreListedAndTheOthersCounted) {
  Diagnostics out;
  {
    LongErrors errors("poses.csv", out);
    for (int row = 1; row <= 23; ++row) errors.add({row, 2}, Code::wrong_form, "knee.x_mm", "abc", "must be a number");
    for (int row = 1; row <= 7; ++row) errors.warn({row, 3}, Code::wrong_form, "knee.y_mm", "", "is empty");
    EXPECT_EQ(errors.count(), 23u);
  }
  EXPECT_EQ(listed(out, Diagnostic::Severity::error), 21u);
  EXPECT_EQ(listed(out, Diagnostic::Severity::warning), 6u);
  EXPECT_EQ(out.items()[0].file, "poses.csv");
  EXPECT_EQ(out.items()[0].line, 1);
  bool more = false, warned = false;
  for (const Diagnostic& d : out.items()) {
    more = more || d.rule == "3 more errors like these";
    warned = warned || d.rule == "2 more warnings like these";
  }
  EXPECT_TRUE(more);
  EXPECT_TRUE(warned);
}

TEST(LongErrors, FewAreListedAlone) {
  Diagnostics out;
  { LongErrors("poses.csv", out).add({1, 1}, Code::wrong_form, "time", "x", "must be a number"); }
  EXPECT_EQ(out.items().size(), 1u);
}

}  // namespace
}  // namespace genu
