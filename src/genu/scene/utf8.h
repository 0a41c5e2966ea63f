// Where a text stops being UTF-8.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "genu/scene/scene.h"

namespace genu {

/// Line and column (1-based, in characters) of the first byte that is not part of valid UTF-8 (RFC 3629: no overlong
/// forms, no surrogates, nothing past U+10FFFF) or is NUL; empty if the text is valid.
std::optional<SourceLocation> first_invalid_utf8(std::string_view text);

/// The text with '?' for every byte that is not part of valid UTF-8: names of files may be any bytes.
std::string valid_utf8(std::string_view text);

}  // namespace genu
