#include "genu/core/timer.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace genu {
namespace {

constexpr double kPause = 0.02;  // s

void pause() { std::this_thread::sleep_for(std::chrono::duration<double>(kPause)); }

TEST(Timer, CountsSecondsAndNeverRunsBackwards) {
  const Timer timer;
  double last = timer.seconds();
  EXPECT_GE(last, 0);
  for (int i = 0; i < 1000; ++i) {
    const double now = timer.seconds();
    ASSERT_GE(now, last);
    last = now;
  }
  pause();
  const double seconds = timer.seconds();
  EXPECT_GE(seconds, kPause);
  EXPECT_LT(seconds, 10) << "milliseconds or nanoseconds taken for seconds";
}

TEST(ScopedTimer, AddsItsScopeToTheTotal) {
  double total = 1000;
  {
    const ScopedTimer timer(total);
    pause();
    EXPECT_EQ(total, 1000) << "nothing is added before the scope ends";
  }
  EXPECT_GE(total, 1000 + kPause);
  EXPECT_LT(total, 1010);
  const double first = total;
  {
    const ScopedTimer timer(total);
    pause();
  }
  EXPECT_GE(total, first + kPause) << "the second scope replaced the first instead of adding to it";
}

}  // namespace
}  // namespace genu
