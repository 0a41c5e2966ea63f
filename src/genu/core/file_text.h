// Files of text, read whole.
#pragma once

#include <optional>
#include <string>

#include "genu/core/diagnostics.h"

namespace genu {

/// What a file holds. Empty, with an error in `out`, where it is none: what is no regular file (a folder, a pipe, a
/// device) might have no end.
[[nodiscard]] std::optional<std::string> text_of_file(const std::string& path, Diagnostics& out);

/// A word for a shell's command line: as it is where that is safe, else in single quotes, with ./ before a leading -.
std::string shell_word(const std::string& word);

/// A cell of a CSV table (RFC 4180): in quotes where it has to be.
std::string csv_word(const std::string& word);

}  // namespace genu
