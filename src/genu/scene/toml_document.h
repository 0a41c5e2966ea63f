// A TOML file as a plain tree with a place for every key and value. The one door to toml++.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/scene/scene.h"

namespace genu {

struct TomlNode {
  enum class Kind { table, array, string, integer, floating, boolean, date };
  Kind kind = Kind::table;
  std::string key;                 ///< the member's name; empty for the root and for elements of arrays
  SourceLocation key_where;        ///< where the key stands (elements of arrays: the value's place)
  SourceLocation where;            ///< where the value starts
  std::string text;                ///< string
  double number = 0;               ///< integer, floating
  std::int64_t integer = 0;        ///< integer
  bool boolean = false;            ///< boolean
  std::vector<TomlNode> children;  ///< members in the order of the file, or elements

  const TomlNode* member(std::string_view name) const;
};

/// Parses UTF-8 TOML 1.0. A syntax error (toml++ stops at the first) becomes a Diagnostic at its line and column,
/// and nothing is returned. Never throws, never aborts, whatever the text.
[[nodiscard]] std::optional<TomlNode> parse_toml(const std::string& text, const std::string& file, Diagnostics& out);

/// The value as a user would write it, on one line, shortened to about 60 characters.
std::string literal(const TomlNode& node);

}  // namespace genu
