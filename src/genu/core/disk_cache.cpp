#include "genu/core/disk_cache.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <utility>
#include <vector>

#include "genu/core/atomic_output.h"
#include "genu/core/file_checksum.h"
#include "genu/core/program_hash.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".genu-cache";
constexpr std::uintmax_t kRoomToSpare = std::uintmax_t{1} << 30;  // bytes: results have precedence

std::optional<std::string> read_whole(const fs::path& file, std::uintmax_t most) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  if (error || size > most || !fs::is_regular_file(file, error)) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::string bytes(size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  return in ? std::optional(std::move(bytes)) : std::nullopt;
}

fs::path users_folder() {
  const auto named = [](const char* variable) {
    const char* const value = std::getenv(variable);
    return fs::path(value == nullptr ? "" : value);
  };
  // Relative paths are invalid there (XDG Base Directory Specification).
  if (const fs::path cache = named("XDG_CACHE_HOME"); cache.is_absolute()) return cache / "genu";
  const fs::path home = named("HOME");
  return home.is_absolute() ? home / ".cache" / "genu" : fs::path();
}

std::atomic<bool> on = false;

}  // namespace

DiskCache::DiskCache(fs::path folder, std::uintmax_t most) : folder_(std::move(folder)), most_(most) {}

bool DiskCache::is_own() const {
  struct stat facts = {};
  return ::stat(folder_.c_str(), &facts) == 0 && S_ISDIR(facts.st_mode) && facts.st_uid == ::geteuid() &&
         (facts.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

fs::path DiskCache::file_of(std::string_view key) const {
  return folder_ / (checksum(program_hash() + "\n" + std::string(key)).xxh128 + kEnding);
}

std::optional<std::string> DiskCache::find(std::string_view key) const {
  const fs::path file = file_of(key);
  if (!is_own()) return std::nullopt;
  constexpr std::size_t kSum = 32;
  auto bytes = read_whole(file, most_ + kSum);
  if (!bytes || bytes->size() < kSum) return std::nullopt;
  const std::string_view content = std::string_view(*bytes).substr(kSum);
  if (checksum(content).xxh128 != std::string_view(*bytes).substr(0, kSum)) return std::nullopt;
  std::error_code ignored;
  fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);  // used last
  bytes->erase(0, kSum);
  return bytes;
}

void DiskCache::keep(std::string_view key, std::string_view content) const {
  if (content.size() > most_) return;
  std::error_code error;
  if (fs::create_directories(folder_, error)) fs::permissions(folder_, fs::perms::owner_all, error);
  if (error || !is_own()) return;
  const fs::space_info space = fs::space(folder_, error);
  if (error || space.available < content.size() + kRoomToSpare) return;
  const fs::path file = file_of(key);
  // What goes wrong leaves no entry, which is no worse than before.
  if (!write_file_atomically(file, checksum(content).xxh128 + std::string(content)).empty()) return;
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write, error);
  make_room();
}

void DiskCache::make_room() const {
  struct Entry {
    fs::file_time_type used;
    std::uintmax_t bytes;
    fs::path path;
  };
  std::vector<Entry> entries;
  std::uintmax_t all = 0;
  std::error_code error;
  for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
    // With what a writer left that was killed.
    if (it->path().filename().string().find(kEnding) == std::string::npos) continue;
    std::error_code gone;  // another program makes room as well
    const auto bytes = it->file_size(gone);
    const auto used = it->last_write_time(gone);
    if (gone) continue;
    entries.push_back({used, bytes, it->path()});
    all += bytes;
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& x, const Entry& y) { return x.used < y.used; });
  for (std::size_t k = 0; all > most_ && k < entries.size(); all -= entries[k++].bytes)
    fs::remove(entries[k].path, error);
}

const DiskCache* user_cache() {
  static const std::optional<DiskCache> cache = [] {
    const fs::path folder = users_folder();
    return folder.empty() ? std::nullopt : std::optional(DiskCache(folder));
  }();
  return on && cache ? &*cache : nullptr;
}

void use_user_cache(bool wanted) { on = wanted; }

}  // namespace genu
