// The files that a piece of work reads: each is opened once, so that all who use it see the same bytes.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "genu/core/file_checksum.h"

namespace genu {

/// Calls from several threads are safe.
class InputFiles {
 public:
  /// The bytes of a regular file, read whole at the first call for its path; null where that fails.
  std::shared_ptr<const std::string> bytes(const std::string& path);

  /// Gives a file its bytes: the one of that path is not opened.
  void put(const std::string& path, std::string bytes);

  /// Of the bytes that were read; reads the file where nobody has asked for it yet. Empty where that fails.
  std::optional<FileChecksum> checksum(const std::string& path);

  /// Frees the memory of a file whose content may be needed again. bytes() then reads it once more, and is null where
  /// it has other content by then. Does nothing to bytes that were put().
  void set_aside(const std::string& path);

  /// Frees the memory of a file whose content is no longer needed. Its checksum is kept; bytes() is null from now on.
  void release(const std::string& path);

 private:
  struct File {
    std::shared_ptr<const std::string> bytes;
    std::optional<FileChecksum> checksum;
    bool aside = false, given = false;
  };
  const File& read(const std::string& path);

  std::mutex mutex_;
  std::map<std::string, File> files_;
};

}  // namespace genu
