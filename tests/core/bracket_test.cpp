#include "genu/core/bracket.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace genu {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// Evaluations until the bracket is narrower than 1e-12, and where it ends.
template <typename F>
int find(F f, double low, double high, bool known, double& root) {
  Bracket bracket(low, known ? f(low) : kUnknown, high, known ? f(high) : kUnknown, 1e-12);
  const bool rising = f(high) > 0;
  int count = 0;
  for (; bracket.open() && count < 300; ++count) {
    const double x = bracket.next(), value = f(x);
    EXPECT_GT(x, bracket.low());
    EXPECT_LT(x, bracket.high());
    (value > 0) == rising ? bracket.move_high(x, value) : bracket.move_low(x, value);
  }
  EXPECT_FALSE(bracket.open());
  root = bracket.high();
  return count;
}

TEST(Bracket, FindsSmoothRootsInFewSteps) {
  double root = 0;
  EXPECT_LE(find([](double x) { return std::cos(x) - x; }, 0, 1, true, root), 10);
  EXPECT_NEAR(root, 0.7390851332151607, 2e-12);
  EXPECT_LE(find([](double x) { return 2 - std::exp(3 * x); }, -1, 2, true, root), 25);
  EXPECT_NEAR(root, std::log(2) / 3, 2e-12);
}

TEST(Bracket, BisectsWhereValuesAreNotKnown) {
  Bracket bracket(0, kUnknown, 1, -1, 1e-9);
  EXPECT_EQ(bracket.next(), 0.5);
  bracket.move_low(0.5, kUnknown);
  EXPECT_EQ(bracket.next(), 0.75);
}

TEST(Bracket, AJumpIsFoundAsFast) {
  double root = 0;
  EXPECT_LE(find([](double x) { return x < 0.3 ? -1e-3 : 1e3; }, 0, 1, true, root), 60);
  EXPECT_NEAR(root, 0.3, 1e-12);
}

TEST(Bracket, AValueThatIsZeroOverARangeIsLeftAsFast) {
  double root = 0;
  const auto plateau = [](double x) { return x < 0.02 ? -1.0 : x > 0.07 ? 1.0 : 0.0; };
  EXPECT_LE(find(plateau, 0, 0.1, true, root), 60);
  EXPECT_LE(find([](double x) { return x > 0.07 ? 0.3 : 0.0; }, 0, 0.1, true, root), 60);
  EXPECT_NEAR(root, 0.07, 1e-12);
}

TEST(Bracket, ARootMetExactlyClosesItAtOnce) {
  double root = 0;
  EXPECT_LE(find([](double x) { return x - 0.25; }, 0, 1, true, root), 2);
  EXPECT_NEAR(root, 0.25, 1e-12);
}

}  // namespace
}  // namespace genu
