#include "genu/core/file_checksum.h"

#include <array>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

namespace genu {
namespace {

class Fnv1a64 {
 public:
  void add(std::string_view bytes) {
    constexpr std::uint64_t kPrime = 0x100000001b3;
    for (const char c : bytes) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * kPrime;
    bytes_ += bytes.size();
  }
  FileChecksum checksum() const { return {bytes_, fmt::format("{:016x}", hash_)}; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
  std::uintmax_t bytes_ = 0;
};

}  // namespace

FileChecksum checksum(std::string_view bytes) {
  Fnv1a64 sum;
  sum.add(bytes);
  return sum.checksum();
}

std::optional<FileChecksum> file_checksum(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return std::nullopt;
  Fnv1a64 sum;
  std::array<char, 1 << 16> block;
  while (stream.read(block.data(), block.size()) || stream.gcount() > 0)
    sum.add({block.data(), static_cast<std::size_t>(stream.gcount())});
  if (stream.bad()) return std::nullopt;
  return sum.checksum();
}

}  // namespace genu
