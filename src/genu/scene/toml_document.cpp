#include "genu/scene/toml_document.h"

// Without NDEBUG an assertion of toml++ 3.3 aborts on malformed input such as "[.". Its parser is compiled here (header
// only, own inline namespace "noex"), because the shared library's was built with exceptions and perhaps with asserts.
#ifndef NDEBUG
#define NDEBUG
#endif
#undef TOML_HEADER_ONLY
#undef TOML_SHARED_LIB
#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#define TOML_MAX_NESTED_VALUES 16
#include <toml++/toml.h>

#include <fmt/format.h>
#include <algorithm>
#include <tuple>

namespace genu {

namespace {

// Deeper than any scene; what lies below is dropped, since the reader refuses the table that holds it.
constexpr int kMaxDepth = 32;
// Dotted keys nest without bound and tables are destroyed recursively: bounded here, before the stack is at stake.
constexpr int kMaxDotsInKey = 250;

SourceLocation location(const toml::source_region& region) {
  return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

TomlNode converted(const toml::node& from, int depth);

void convert_members(const toml::table& table, TomlNode& to, int depth) {
  for (auto&& [key, value] : table) {
    TomlNode child = converted(value, depth + 1);
    child.key = std::string(key.str());
    child.key_where = location(key.source());
    to.children.push_back(std::move(child));
  }
  // toml++ sorts by name; people read files from the top.
  std::stable_sort(to.children.begin(), to.children.end(), [](const TomlNode& a, const TomlNode& b) {
    return std::tie(a.key_where.line, a.key_where.column) < std::tie(b.key_where.line, b.key_where.column);
  });
}

TomlNode converted(const toml::node& from, int depth) {
  TomlNode to;
  to.where = to.key_where = location(from.source());
  if (const auto* table = from.as_table()) {
    to.kind = TomlNode::Kind::table;
    if (depth < kMaxDepth) convert_members(*table, to, depth);
  } else if (const auto* array = from.as_array()) {
    to.kind = TomlNode::Kind::array;
    if (depth >= kMaxDepth) return to;
    for (auto&& element : *array) to.children.push_back(converted(element, depth + 1));
  } else if (const auto* string = from.as_string()) {
    to.kind = TomlNode::Kind::string;
    to.text = string->get();
  } else if (const auto* integer = from.as_integer()) {
    to.kind = TomlNode::Kind::integer;
    to.integer = integer->get();
    to.number = static_cast<double>(to.integer);
  } else if (const auto* floating = from.as_floating_point()) {
    to.kind = TomlNode::Kind::floating;
    to.number = floating->get();
  } else if (const auto* boolean = from.as_boolean()) {
    to.kind = TomlNode::Kind::boolean;
    to.boolean = boolean->get();
  } else {
    to.kind = TomlNode::Kind::date;
  }
  return to;
}

/// The first line whose dots, uninterrupted by a delimiter or comment, could nest too deep; 0 where there is none.
int line_nested_too_deep(const std::string& text) {
  constexpr std::string_view kDelimiters = "=,{}[]";
  int line = 1, dots = 0;
  bool comment = false;
  for (const char c : text) {
    if (c == '\n') {
      ++line;
      comment = false;
      dots = 0;
    } else if (c == '#') {
      comment = true;
    } else if (kDelimiters.find(c) != std::string_view::npos) {
      dots = 0;
    } else if (c == '.' && !comment && ++dots > kMaxDotsInKey) {
      return line;
    }
  }
  return 0;
}

std::string escaped(const std::string& text) {
  std::string s;
  for (const char c : text) {
    if (c == '\n')
      s += "\\n";
    else if (c == '\t')
      s += "\\t";
    else if (c == '"' || c == '\\')
      s += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      s += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      s += c;
  }
  return s;
}

/// Cuts after `size` bytes, never inside a UTF-8 character.
std::string shortened(std::string s, std::size_t size) {
  if (s.size() <= size) return s;
  while (size > 0 && (static_cast<unsigned char>(s[size]) & 0xc0) == 0x80) --size;
  return s.substr(0, size) + "...";
}

/// The shortest digits that read back as the same number; 3.0 stays distinct from the integer 3.
std::string floating_literal(double value) {
  const std::string digits = fmt::format("{}", value);
  return digits.find_first_not_of("-0123456789") == std::string::npos ? digits + ".0" : digits;
}

constexpr std::size_t kLiteralSize = 60;

std::string array_literal(const TomlNode& node) {
  std::string s = "[";
  for (const TomlNode& child : node.children) {
    if (s.size() > kLiteralSize) break;
    if (s.size() > 1) s += ", ";
    s += literal(child);
  }
  return s + "]";
}

}  // namespace

const TomlNode* TomlNode::member(std::string_view name) const {
  for (const TomlNode& child : children) {
    if (child.key == name) return &child;
  }
  return nullptr;
}

std::optional<TomlNode> parse_toml(const std::string& text, const std::string& file, Diagnostics& out) {
  if (const int line = line_nested_too_deep(text); line > 0) {
    out.add({.file = file,
             .line = line,
             .column = 1,
             .key = {},
             .found = {},
             .rule = fmt::format("more than {} dots in one key", kMaxDotsInKey)});
    return std::nullopt;
  }
  const toml::parse_result result = toml::parse(std::string_view(text), std::string_view(file));
  if (!result) {
    const SourceLocation where = location(result.error().source());
    out.add({.file = file,
             .line = where.line,
             .column = where.column,
             .key = {},
             .found = {},
             .rule = "not valid TOML: " + std::string(result.error().description())});
    return std::nullopt;
  }
  return converted(result.table(), 0);
}

std::string literal(const TomlNode& node) {
  switch (node.kind) {
    case TomlNode::Kind::table:
      return "a table";
    case TomlNode::Kind::array:
      return shortened(array_literal(node), kLiteralSize);
    case TomlNode::Kind::string:
      return "\"" + shortened(escaped(node.text), kLiteralSize) + "\"";
    case TomlNode::Kind::integer:
      return std::to_string(node.integer);
    case TomlNode::Kind::floating:
      return floating_literal(node.number);
    case TomlNode::Kind::boolean:
      return node.boolean ? "true" : "false";
    case TomlNode::Kind::date:
      return "a date or time";
  }
  return {};
}

}  // namespace genu
