#include <charconv>
#include <cmath>
#include <string_view>

#include "genu/scene/read_parts.h"
#include "genu/scene/region_text.h"

namespace genu {

namespace {

/// Reads "AXIS COMPARISON NUMBER [and ...]" from left to right. Each function takes a piece off the front, or fails.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  bool at_end() {
    skip_spaces();
    return rest_.empty();
  }

  bool axis(int& out) {
    skip_spaces();
    if (rest_.empty() || rest_[0] < 'x' || rest_[0] > 'z') return false;
    out = rest_[0] - 'x';
    rest_.remove_prefix(1);
    return true;
  }

  bool comparison(RegionDef::Comparison& out) {
    using Comparison = RegionDef::Comparison;
    skip_spaces();
    if (word("<="))
      out = Comparison::less_equal;
    else if (word(">="))
      out = Comparison::greater_equal;
    else if (word("<"))
      out = Comparison::less;
    else if (word(">"))
      out = Comparison::greater;
    else
      return false;
    return true;
  }

  bool number(double& out) {
    skip_spaces();
    // Not strtod: that one follows the locale.
    const auto [end, failed] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), out);
    if (failed != std::errc() || !std::isfinite(out)) return false;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return true;
  }

  bool word_and() {
    skip_spaces();
    return word("and");
  }

 private:
  bool word(std::string_view w) {
    if (rest_.substr(0, w.size()) != w) return false;
    rest_.remove_prefix(w.size());
    return true;
  }

  void skip_spaces() {
    while (!rest_.empty() && (rest_[0] == ' ' || rest_[0] == '\t')) rest_.remove_prefix(1);
  }

  std::string_view rest_;
};

}  // namespace

std::optional<std::vector<RegionDef::Condition>> parse_region(const std::string& text, double length_unit) {
  std::vector<RegionDef::Condition> conditions;
  Scanner scan(text);
  do {
    RegionDef::Condition c;
    if (!scan.axis(c.axis) || !scan.comparison(c.comparison) || !scan.number(c.value)) return std::nullopt;
    c.value *= length_unit;
    conditions.push_back(c);
  } while (scan.word_and());
  if (!scan.at_end()) return std::nullopt;
  return conditions;
}

std::vector<RegionDef::Condition> read_region(ReadContext& context, const Item& item) {
  const auto text = read_string(context, item);
  if (!text) return {};
  auto conditions = parse_region(*text, context.scene.length_unit);
  if (!conditions) refuse(context, item, Code::wrong_form, kRegionForm);
  return conditions.value_or(std::vector<RegionDef::Condition>{});
}

}  // namespace genu
