#include "genu/core/file_checksum.h"

#include <xxhash.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <vector>

#include <fmt/format.h>

namespace genu {
namespace {

std::string digits(const XXH128_hash_t& hash) { return fmt::format("{:016x}{:016x}", hash.high64, hash.low64); }

}  // namespace

FileChecksum checksum(std::string_view bytes) {
  return {bytes.size(), digits(XXH3_128bits(bytes.data(), bytes.size()))};
}

std::optional<FileChecksum> file_checksum(const std::string& path) {
  constexpr std::size_t kBytesAtOnce = std::size_t{1} << 16;  // bytes read at a time
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return std::nullopt;
  RunningChecksum running;
  std::vector<char> block(kBytesAtOnce);
  while (stream.read(block.data(), kBytesAtOnce) || stream.gcount() > 0)
    running.add({block.data(), static_cast<std::size_t>(stream.gcount())});
  if (stream.bad()) return std::nullopt;
  return running.sum();
}

struct RunningChecksum::State {
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash{XXH3_createState(), XXH3_freeState};
  std::uintmax_t bytes = 0;
};

RunningChecksum::RunningChecksum() : state_(std::make_unique<State>()) { XXH3_128bits_reset(state_->hash.get()); }
RunningChecksum::~RunningChecksum() = default;

void RunningChecksum::add(std::string_view bytes) {
  XXH3_128bits_update(state_->hash.get(), bytes.data(), bytes.size());
  state_->bytes += bytes.size();
}

FileChecksum RunningChecksum::sum() const { return {state_->bytes, digits(XXH3_128bits_digest(state_->hash.get()))}; }

}  // namespace genu
