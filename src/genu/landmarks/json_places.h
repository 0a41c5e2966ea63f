// JSON with the place of each value, for messages about them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "genu/core/diagnostics.h"

namespace genu {

struct JsonValue {
  enum class Kind { null, boolean, number, string, array, object };
  Kind kind = Kind::null;
  std::string name{};                 ///< of a member of an object
  SourceLocation at{};                ///< where the value begins
  double number = 0;                  ///< of a number
  std::string text{};                 ///< of a string; else the value as the file has it
  std::vector<JsonValue> children{};  ///< of an array or object, in the file's order

  /// The first member of that name; null where there is none, or this is no object.
  const JsonValue* find(std::string_view member) const;
};

/// Empty, with an error in `out`, where the text is no JSON (RFC 8259), or nested more than kMostNested deep.
[[nodiscard]] std::optional<JsonValue> read_json(const std::string& file, const std::string& text, Diagnostics& out);

}  // namespace genu
