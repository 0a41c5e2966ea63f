// Tells whether a file is still the one that was read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace genu {

struct FileChecksum {
  std::uintmax_t bytes = 0;
  std::string fnv1a64;  ///< 16 hexadecimal digits
};

/// FNV-1a with 64 bits (Fowler, Noll and Vo) over a file's bytes: finds changes, not forgeries. Empty where the file
/// cannot be read.
std::optional<FileChecksum> file_checksum(const std::string& path);

/// The same of bytes.
FileChecksum checksum(std::string_view bytes);

}  // namespace genu
