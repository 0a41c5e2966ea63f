// What can be said about a mesh file before a parser sees it: parsers ask for all memory, or take text
// for numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "genu/core/diagnostics.h"

namespace genu {

/// What is wrong with a file of that name, and what to do; none where it is a regular file of a known format, not
/// empty, and not larger than this computer's memory. It is not opened.
[[nodiscard]] std::optional<Fault> check_mesh_name(const std::string& path);

/// What is wrong with the bytes of a file whose ending is `extension` (".stl", in small letters): text in an encoding
/// that genu's readers do not know.
[[nodiscard]] std::string check_mesh_bytes(const std::string& extension, std::string_view bytes);

/// The ending of a file's name, in small letters, with its dot.
std::string mesh_extension(const std::string& path);

inline constexpr const char* kCannotOpen = "cannot be opened; check its permissions";

}  // namespace genu
