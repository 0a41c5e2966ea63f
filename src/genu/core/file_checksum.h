// Tells whether a file is still the one that was read.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace genu {

struct FileChecksum {
  std::uintmax_t bytes = 0;
  std::string xxh128;  ///< 32 hexadecimal digits, as `xxhsum -H2 FILE` prints them
};

/// 128 bits of XXH3 (Collet's xxHash) over a file's bytes: finds changes, not forgeries. Empty where the path is no
/// regular file or cannot be read.
[[nodiscard]] std::optional<FileChecksum> file_checksum(const std::string& path);

/// The same of bytes in memory.
FileChecksum checksum(std::string_view bytes);

/// The same of bytes that come piece by piece.
class RunningChecksum {
 public:
  RunningChecksum();
  ~RunningChecksum();
  RunningChecksum(const RunningChecksum&) = delete;
  RunningChecksum& operator=(const RunningChecksum&) = delete;

  void add(std::string_view bytes);
  /// Of all that was added so far.
  FileChecksum sum() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace genu
