// Formulas mean what they mean on paper, and what is none is refused with a reason.
#include "hard_cases/formula.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace genu {
namespace {

double value(const std::string& text) {
  std::string why;
  const auto found = evaluate_formula(
      text, [](const std::string& name) { return name == "j.x_mm" ? std::optional(3.0) : std::nullopt; }, why);
  EXPECT_TRUE(found) << text << ": " << why;
  return found.value_or(NAN);
}

std::string reason(const std::string& text) {
  std::string why;
  EXPECT_FALSE(evaluate_formula(text, {}, why)) << text;
  return why;
}

TEST(Formula, MeansWhatItMeansOnPaper) {
  EXPECT_EQ(value("1 + 2 * 3 - 4 / 8"), 6.5);
  EXPECT_EQ(value("-2^2"), -4);
  EXPECT_EQ(value("2^3^2"), 512);
  EXPECT_EQ(value("2^-1"), 0.5);
  EXPECT_EQ(value("(1 + 2) * -(3)"), -9);
  EXPECT_EQ(value("1.5e-3 * 2E3"), 3);
  EXPECT_EQ(value("[j.x_mm]^2 + max(1, min(7, 2))"), 11);
  EXPECT_DOUBLE_EQ(value("sin(30 * deg) + cos(pi) + atan2(1, 1)"), 0.5 - 1 + M_PI / 4);
  EXPECT_DOUBLE_EQ(value("sqrt(2) * cbrt(8) * abs(-1) * exp(log(3))"), std::sqrt(2) * 6);
}

TEST(Formula, SaysWhatIsWrong) {
  EXPECT_EQ(reason("1 +"), "a number is missing");
  EXPECT_EQ(reason("(1"), "a ) is missing");
  EXPECT_EQ(reason("1 2"), "\"2\" is too much");
  EXPECT_EQ(reason("[y]"), "[y] has no value");
  EXPECT_EQ(reason("[y"), "a ] is missing");
  EXPECT_EQ(reason("sinus(1)"), "\"sinus\" is not known");
  EXPECT_EQ(reason("max(1)"), "a second argument is missing of max");
  EXPECT_EQ(reason("sin 1"), "a ( is missing after sin");
  EXPECT_EQ(reason(std::string(100000, '(')), "is too deep");
  EXPECT_EQ(reason(""), "a number is missing");
}

}  // namespace
}  // namespace genu
