#include "hard_cases/formula.h"

#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

namespace genu {
namespace {

using OneArgument = double (*)(double);
using TwoArguments = double (*)(double, double);

const std::map<std::string, OneArgument>& one_argument() {
  static const std::map<std::string, OneArgument> known = {
      {"abs", [](double x) { return std::abs(x); }},   {"sqrt", [](double x) { return std::sqrt(x); }},
      {"cbrt", [](double x) { return std::cbrt(x); }}, {"exp", [](double x) { return std::exp(x); }},
      {"log", [](double x) { return std::log(x); }},   {"sin", [](double x) { return std::sin(x); }},
      {"cos", [](double x) { return std::cos(x); }},   {"tan", [](double x) { return std::tan(x); }},
      {"asin", [](double x) { return std::asin(x); }}, {"acos", [](double x) { return std::acos(x); }},
      {"atan", [](double x) { return std::atan(x); }}};
  return known;
}

const std::map<std::string, TwoArguments>& two_arguments() {
  static const std::map<std::string, TwoArguments> known = {
      {"atan2", [](double y, double x) { return std::atan2(y, x); }},
      {"min", [](double x, double y) { return std::fmin(x, y); }},
      {"max", [](double x, double y) { return std::fmax(x, y); }}};
  return known;
}

class FormulaReader {
 public:
  FormulaReader(const std::string& text, const NameValue& value_of) : text_(text), value_of_(value_of) {}

  std::optional<double> read(std::string& why) {
    const double value = sum();
    if (why_.empty() && next() != '\0') fail("\"" + text_.substr(at_) + "\" is too much");
    why = why_;
    return why_.empty() ? std::optional(value) : std::nullopt;
  }

 private:
  static constexpr int kDeepest = 100;

  char next() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (next() != c) return false;
    ++at_;
    return true;
  }
  double fail(const std::string& why) {
    if (why_.empty()) why_ = why;
    at_ = text_.size();
    return 0;
  }

  double sum() {
    if (++depth_ > kDeepest) return fail("is too deep");
    double value = product();
    while (next() == '+' || next() == '-') value += text_[at_++] == '+' ? product() : -product();
    --depth_;
    return value;
  }
  double product() {
    double value = signed_power();
    while (next() == '*' || next() == '/') {
      const bool times = text_[at_++] == '*';
      const double other = signed_power();
      value = times ? value * other : value / other;
    }
    return value;
  }
  double signed_power() {
    bool negative = false;
    while (next() == '-' || next() == '+') negative ^= text_[at_++] == '-';
    const double base = operand();
    const double value = take('^') ? std::pow(base, exponent()) : base;
    return negative ? -value : value;
  }
  double exponent() {
    if (++depth_ > kDeepest) return fail("is too deep");
    const double value = signed_power();
    --depth_;
    return value;
  }
  double operand() {
    const char c = next();
    if (take('(')) return closed(sum());
    if (take('[')) return named();
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) return word();
    std::size_t used = 0;
    try {
      if (std::isdigit(static_cast<unsigned char>(c)) == 0 && c != '.') return fail("a number is missing");
      const double value = std::stod(text_.substr(at_), &used);
      at_ += used;
      return value;
    } catch (const std::exception&) {
      return fail("a number is missing");
    }
  }
  double closed(double value) { return take(')') ? value : fail("a ) is missing"); }
  double named() {
    const std::size_t end = text_.find(']', at_);
    if (end == std::string::npos) return fail("a ] is missing");
    const std::string name = text_.substr(at_, end - at_);
    at_ = end + 1;
    const auto value = value_of_ ? value_of_(name) : std::nullopt;
    return value ? *value : fail("[" + name + "] has no value");
  }
  double word() {
    std::string name;
    while (at_ < text_.size() && std::isalnum(static_cast<unsigned char>(text_[at_])) != 0) name += text_[at_++];
    if (name == "pi") return std::numbers::pi;
    if (name == "deg") return std::numbers::pi / 180;
    const auto one = one_argument().find(name);
    const auto two = two_arguments().find(name);
    if (one == one_argument().end() && two == two_arguments().end()) return fail("\"" + name + "\" is not known");
    if (!take('(')) return fail("a ( is missing after " + name);
    const double first = sum();
    if (one != one_argument().end()) return closed(one->second(first));
    if (!take(',')) return fail("a second argument is missing of " + name);
    return closed(two->second(first, sum()));
  }

  const std::string& text_;
  const NameValue& value_of_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::string why_;
};

}  // namespace

std::optional<double> evaluate_formula(const std::string& text, const NameValue& value_of, std::string& why) {
  return FormulaReader(text, value_of).read(why);
}

}  // namespace genu
