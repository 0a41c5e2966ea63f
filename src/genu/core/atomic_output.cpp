#include "genu/core/atomic_output.h"

#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

namespace genu {
namespace {

namespace fs = std::filesystem;

// A folder with this file in it was written by genu and may be replaced by genu.
constexpr const char* kMarkFile = "summary.json";

std::string failure(const fs::path& path, const std::string& what, const std::error_code& code) {
  return path.string() + ": " + what + ": " + code.message();
}

// A free name in the same folder, so that a rename never crosses file systems; hidden, and telling whose it is.
fs::path sibling(const fs::path& path, const std::string& purpose) {
  const std::string stem = "." + path.filename().string() + "." + purpose + "-" + std::to_string(::getpid());
  std::error_code code;
  for (int n = 0;; ++n) {
    fs::path candidate = path.parent_path() / (stem + "-" + std::to_string(n));
    if (!fs::exists(fs::symlink_status(candidate, code))) return candidate;
  }
}

bool is_folder_or_above(const fs::path& folder, const fs::path& inner) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), inner.begin(), inner.end());
  return end == folder.end();
}

bool is_marked(const fs::path& folder) {
  std::ifstream file(folder / kMarkFile, std::ios::binary);
  char start[64] = {};
  file.read(start, sizeof start - 1);
  return std::strstr(start, "\"genu\"") != nullptr;
}

// Exchanges two names in one step where the file system can; false where it cannot.
bool exchange(const fs::path& a, const fs::path& b) {
  return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
}

// Why `target`, a canonical path, must not be replaced by a folder; empty if it may.
std::string why_not_replaceable(const fs::path& target) {
  std::error_code code;
  if (target == target.root_path()) return target.string() + ": is the root folder: choose a folder of its own";
  const fs::path cwd = fs::canonical(fs::current_path(code), code);
  if (!code && is_folder_or_above(target, cwd)) {
    return target.string() + ": is the working folder or above it: choose a folder of its own";
  }
  const fs::file_status status = fs::status(target, code);
  if (status.type() == fs::file_type::not_found) return {};
  if (code) return failure(target, "cannot be read", code);
  if (!fs::is_directory(status)) return target.string() + ": is a file: choose a folder";
  const bool empty = fs::is_empty(target, code);
  if (code) return failure(target, "cannot be read", code);
  if (!empty && !is_marked(target)) {
    return target.string() + ": has content but no " + kMarkFile +
           " of genu, so it is not a result of genu and will not be replaced: choose another folder";
  }
  return {};
}

}  // namespace

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
}

std::string StagedFolder::open(const fs::path& target) {
  if (target.empty()) return "the output folder has no name";
  if (!staging_.empty()) return target.string() + ": another output folder is still open";
  std::error_code code;
  if (fs::is_symlink(target, code) && !fs::exists(target, code))
    return target.string() + ": is a symbolic link to nothing";
  fs::path canonical = fs::weakly_canonical(fs::absolute(target, code), code);
  if (code) return failure(target, "cannot be used as a folder", code);
  if (!canonical.has_filename()) canonical = canonical.parent_path();  // "out/" is "out"
  if (std::string why = why_not_replaceable(canonical); !why.empty()) return why;
  fs::create_directories(canonical.parent_path(), code);
  if (code) return failure(canonical.parent_path(), "cannot be made", code);
  fs::path staging = sibling(canonical, "partial");
  fs::create_directory(staging, code);
  if (code) return failure(canonical.parent_path(), "cannot be written to", code);
  target_ = std::move(canonical);
  staging_ = std::move(staging);
  return {};
}

std::string StagedFolder::commit() {
  if (staging_.empty()) return "there is no open output folder";
  // Looked at again: a long run leaves time for someone to put something there.
  if (std::string why = why_not_replaceable(target_); !why.empty()) return why;
  std::error_code code;
  const bool replaces = fs::exists(target_, code);
  if (replaces && exchange(staging_, target_)) {
    // The earlier result has the staging name now.
    fs::remove_all(staging_, code);
    const fs::path earlier = std::exchange(staging_, fs::path());
    return code ? failure(earlier, "is the earlier result and cannot be removed", code) : std::string();
  }
  const fs::path old = sibling(target_, "old");
  if (replaces) {
    fs::rename(target_, old, code);
    if (code) return failure(target_, "cannot be replaced", code);
  }
  fs::rename(staging_, target_, code);
  if (code) {
    std::error_code ignored;
    if (replaces) fs::rename(old, target_, ignored);
    return failure(target_, "cannot be put in place", code);
  }
  staging_.clear();
  if (replaces) fs::remove_all(old, code);
  return code ? failure(old, "is the earlier result and cannot be removed", code) : std::string();
}

bool folder_holds(const fs::path& folder, const fs::path& file) {
  std::error_code code;
  const fs::path outer = fs::weakly_canonical(fs::absolute(folder, code), code),
                 inner = fs::weakly_canonical(fs::absolute(file, code), code);
  const fs::path relative = inner.lexically_relative(outer.has_filename() ? outer : outer.parent_path());
  return !relative.empty() && *relative.begin() != ".." && fs::exists(inner, code);
}

std::string write_file_atomically(const fs::path& path, std::string_view content) {
  std::error_code code;
  const fs::file_status status = fs::symlink_status(path, code);
  if (fs::is_symlink(status)) return path.string() + ": is a symbolic link, which a file would replace: name another";
  if (fs::exists(status) && !fs::is_regular_file(status)) return path.string() + ": is not a file that can be replaced";
  if (!path.has_filename()) return path.string() + ": is not the name of a file";
  const fs::path partial = sibling(path, "partial");
  errno = 0;
  std::ofstream file(partial, std::ios::binary | std::ios::trunc);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();  // a full disk may show only here
  if (file) {
    fs::rename(partial, path, code);
    if (!code) return {};
  } else {
    code.assign(errno != 0 ? errno : EIO, std::generic_category());
  }
  std::error_code ignored;
  fs::remove(partial, ignored);
  return failure(path, "cannot be written", code);
}

std::string why_not_replaced(const std::string& path, const std::string& mark) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) return {};
  if (!std::filesystem::is_regular_file(status)) return path + ": is no file: choose another name";
  std::ifstream in(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (content.empty() || content.find(mark) != std::string::npos) return {};
  return path + ": is there already and was not written by this command: it will not be replaced; choose another name";
}

}  // namespace genu
