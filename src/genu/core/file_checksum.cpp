#include "genu/core/file_checksum.h"

#include <array>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

namespace genu {

std::optional<FileChecksum> file_checksum(const std::string& path) {
  constexpr std::uint64_t kOffset = 0xcbf29ce484222325, kPrime = 0x100000001b3;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return std::nullopt;
  std::uint64_t hash = kOffset;
  FileChecksum out;
  std::array<char, 1 << 16> block;
  while (stream.read(block.data(), block.size()) || stream.gcount() > 0) {
    const auto count = static_cast<std::size_t>(stream.gcount());
    for (std::size_t i = 0; i < count; ++i) hash = (hash ^ static_cast<unsigned char>(block[i])) * kPrime;
    out.bytes += count;
  }
  if (stream.bad()) return std::nullopt;
  out.fnv1a64 = fmt::format("{:016x}", hash);
  return out;
}

}  // namespace genu
