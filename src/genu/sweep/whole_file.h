// Files of shards that are whole or not there: lines, and a last one with the checksum of all before it.
#pragma once

#include <cstdint>
#include <functional>
#include <istream>
#include <string>
#include <string_view>

#include "genu/core/atomic_output.h"
#include "genu/core/file_checksum.h"

namespace genu {

/// Writes such a file; nothing is there before commit().
class WholeFileWriter {
 public:
  explicit WholeFileWriter(const std::string& path) : file_(path, Durable::yes) {}
  void write(std::string_view text);
  /// Ends the file with "# end COUNT CHECKSUM". Returns what went wrong; an empty text where nothing did.
  [[nodiscard]] std::string commit(std::uint64_t count);

 private:
  StagedFile file_;
  RunningChecksum sum_;
};

/// What such a file is like.
struct WholeFile {
  bool whole = false;  ///< ends with the line that every file ends with
  std::string head, end;
  std::uint64_t lines = 0;  ///< before the end
  std::string sum;          ///< of these

  bool ends_with(std::uint64_t count) const;
};

/// Reads all of it; `each` gets every line before the end, by its number from 0.
WholeFile look_through(std::istream& in, const std::function<void(std::uint64_t number, std::string_view line)>& each);

}  // namespace genu
