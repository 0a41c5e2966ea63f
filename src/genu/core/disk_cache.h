// What took long to compute, kept in files for the next run. Off until a program turns it on.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace genu {

/// Entries are found by a key that names everything they depend on; program_hash() is added to it, so that other code
/// never finds them. An entry that is damaged counts as absent. What cannot be written is not kept: no result depends
/// on it. A folder that others own or may write to is not used: entries are trusted. Calls from several threads and
/// programs are safe.
class DiskCache {
 public:
  /// In this folder, which is made for its owner alone; the entries used last, at most `most` bytes, stay.
  explicit DiskCache(std::filesystem::path folder, std::uintmax_t most = kMostBytes);

  std::optional<std::string> find(std::string_view key) const;
  void keep(std::string_view key, std::string_view content) const;

  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 30;

 private:
  bool is_own() const;
  std::filesystem::path file_of(std::string_view key) const;
  void make_room() const;

  std::filesystem::path folder_;
  std::uintmax_t most_;
};

/// The user's: $XDG_CACHE_HOME/genu, or ~/.cache/genu. Null while it is off, and where neither is named.
const DiskCache* user_cache();

/// For a whole program, before it computes anything.
void use_user_cache(bool on);

}  // namespace genu
