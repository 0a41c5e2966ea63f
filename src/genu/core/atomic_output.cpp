#include "genu/core/atomic_output.h"

#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "genu/core/file_list.h"
#include "genu/core/file_text.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

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

// Exchanges two names in one step where the file system can; false where it cannot.
bool exchange(const fs::path& a, const fs::path& b) {
  return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
}

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::symlink_status(path, ignored).type() == fs::file_type::directory;
}

// The first folder, this one or one in it, out of which nothing can be moved; empty where there is none.
fs::path read_only_folder(const fs::path& folder) {
  const auto is_read_only = [](const fs::path& at) { return is_folder(at) && ::access(at.c_str(), W_OK | X_OK) != 0; };
  if (is_read_only(folder)) return folder;
  std::error_code code;
  for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
    if (is_read_only(it->path())) return it->path();
  return {};
}

using MayBeFault = std::optional<Fault>;

// Why a folder with content must not be replaced by results of `kind`; none if it may.
MayBeFault why_not_of_kind(const fs::path& target, const std::string& kind) {
  const auto list = read_file_list(target);
  const std::string another = " will not be replaced: choose another folder";
  const std::string other =
      list ? ": holds genu's " + list->kind
           : ": has content" + (kind.empty() ? std::string() : " that genu did not list as its " + kind);
  if (!list || list->kind != kind) return Fault{Code::would_overwrite, target.string() + other + ", so it" + another};
  if (const fs::path closed = read_only_folder(target); !closed.empty())
    return Fault{Code::cannot_write, closed.string() + ": is read-only, so it" + another};
  return {};
}

// Why `target`, a canonical path, must not be replaced by a folder; none if it may.
MayBeFault why_not_replaceable(const fs::path& target, const std::string& kind) {
  std::error_code code;
  const auto no_folder = [&](const char* why) { return Fault{Code::no_output_folder, target.string() + why}; };
  if (target == target.root_path()) return no_folder(": is the root folder: choose a folder of its own");
  const fs::path cwd = fs::canonical(fs::current_path(code), code);
  if (!code && is_folder_or_above(target, cwd)) {
    return no_folder(": is the working folder or above it: choose a folder of its own");
  }
  const fs::file_status status = fs::status(target, code);
  if (status.type() == fs::file_type::not_found) return {};
  if (code) return Fault{Code::cannot_read, failure(target, "cannot be read", code)};
  if (!fs::is_directory(status)) return no_folder(": is a file: choose a folder");
  const bool empty = fs::is_empty(target, code);
  if (code) return Fault{Code::cannot_read, failure(target, "cannot be read", code)};
  return empty ? std::nullopt : why_not_of_kind(target, kind);
}

// Puts one file, link or empty folder of others into the new folder too: a second name of the same file where the file
// system has that, else a copy.
std::string keep(const fs::path& from, const fs::path& to) {
  if (fs::exists(fs::symlink_status(to)))
    return from.string() + ": was not written by genu and would be replaced: move it, or choose another folder";
  std::error_code code;
  fs::create_directories(to.parent_path(), code);
  if (is_folder(from)) {
    fs::create_directory(to, from, code);
  } else if (fs::is_symlink(fs::symlink_status(from))) {
    fs::copy_symlink(from, to, code);
  } else {
    fs::create_hard_link(from, to, code);
    if (code) fs::copy_file(from, to, code);
  }
  return code ? failure(from, "cannot be kept", code) : std::string();
}

// All that is not genu's in `old` is in `fresh` too, afterwards.
std::string keep_others(const fs::path& old, const fs::path& fresh) {
  const auto list = read_file_list(old);
  if (!list) return {};
  for (const std::string& file : not_listed(old, *list))
    if (std::string error = keep(old / file, fresh / file); !error.empty()) return error;
  return {};
}

// Why no file can be put at `path`; empty where one can.
std::string why_no_file(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(path, ignored);
  if (fs::is_symlink(status)) return path.string() + ": is a symbolic link, which a file would replace: name another";
  if (fs::exists(status) && !fs::is_regular_file(status)) return path.string() + ": is not a file that can be replaced";
  return path.has_filename() ? std::string() : path.string() + ": is not the name of a file";
}

// Waits until the disk has the names in a folder.
void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
}

MayBeFault StagedFolder::open(const fs::path& target) {
  const auto no_folder = [](std::string text) { return Fault{Code::no_output_folder, std::move(text)}; };
  if (target.empty()) return no_folder("the output folder has no name");
  if (!staging_.empty()) return no_folder(target.string() + ": another output folder is still open");
  std::error_code code;
  if (fs::is_symlink(target, code) && !fs::exists(target, code))
    return no_folder(target.string() + ": is a symbolic link to nothing");
  fs::path canonical = fs::weakly_canonical(fs::absolute(target, code), code);
  if (code) return no_folder(failure(target, "cannot be used as a folder", code));
  if (!canonical.has_filename()) canonical = canonical.parent_path();  // "out/" is "out"
  if (auto why = why_not_replaceable(canonical, kind_)) return why;
  fs::create_directories(canonical.parent_path(), code);
  if (code) return Fault{Code::cannot_write, failure(canonical.parent_path(), "cannot be made", code)};
  fs::path staging = sibling(canonical, "partial");
  fs::create_directory(staging, code);
  if (code) return Fault{Code::cannot_write, failure(canonical.parent_path(), "cannot be written to", code)};
  target_ = std::move(canonical);
  staging_ = std::move(staging);
  return {};
}

std::string StagedFolder::commit() {
  if (staging_.empty()) return "there is no open output folder";
  // Looked at again: a long run leaves time for someone to put something there.
  if (const auto why = why_not_replaceable(target_, kind_)) return why->text;
  if (!kind_.empty())
    if (std::string error = write_file_list(staging_, kind_); !error.empty()) return error;
  std::error_code code;
  const bool replaces = fs::exists(target_, code);
  if (replaces)
    if (std::string error = keep_others(target_, staging_); !error.empty()) return error;
  fs::path old = staging_;  // where the earlier result is afterwards
  if (!replaces || !exchange(staging_, target_)) {
    if (replaces) {
      old = sibling(target_, "old");
      fs::rename(target_, old, code);
      if (code) return failure(target_, "cannot be replaced", code);
    }
    fs::rename(staging_, target_, code);
    if (code) {
      std::error_code ignored;
      if (replaces) fs::rename(old, target_, ignored);
      return failure(target_, "cannot be put in place", code);
    }
  }
  staging_.clear();
  if (replaces) fs::remove_all(old, code);  // what it cannot remove stays under its hidden name: the result is there
  return {};
}

bool folder_holds(const fs::path& folder, const fs::path& file) {
  std::error_code code;
  const fs::path outer = fs::weakly_canonical(fs::absolute(folder, code), code),
                 inner = fs::weakly_canonical(fs::absolute(file, code), code);
  const fs::path relative = inner.lexically_relative(outer.has_filename() ? outer : outer.parent_path());
  return !relative.empty() && *relative.begin() != ".." && fs::exists(inner, code);
}

StagedFile::StagedFile(fs::path path, Durable durable) : target_(std::move(path)), durable_(durable) {
  error_ = why_no_file(target_);
  if (!error_.empty()) return;
  do {  // another thread or process may take the same free name
    partial_ = sibling(target_, "partial");
    descriptor_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) fail(errno);
}

StagedFile::~StagedFile() {
  if (descriptor_ < 0) return;
  close();
  ::unlink(partial_.c_str());
}

void StagedFile::fail(int error) {
  if (error_.empty()) error_ = failure(target_, "cannot be written", {error, std::generic_category()});
}

void StagedFile::close() {
  if (::close(descriptor_) != 0) fail(errno);  // a full disk may show only here
  descriptor_ = -1;
}

void StagedFile::write(std::string_view content) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 20;
  waiting_ += content;
  if (waiting_.size() >= kAtOnce) flush();
}

void StagedFile::flush() {
  std::string_view left = waiting_;
  while (!left.empty() && error_.empty()) {
    const ssize_t n = ::write(descriptor_, left.data(), left.size());
    if (n >= 0)
      left.remove_prefix(static_cast<std::size_t>(n));
    else if (errno != EINTR)
      fail(errno);
  }
  waiting_.clear();
}

std::string StagedFile::commit() {
  if (descriptor_ < 0) return error_.empty() ? target_.string() + ": is written already" : error_;
  flush();
  if (durable_ == Durable::yes && error_.empty() && ::fsync(descriptor_) != 0) fail(errno);
  close();
  if (error_.empty() && ::rename(partial_.c_str(), target_.c_str()) != 0) fail(errno);
  if (!error_.empty()) {
    ::unlink(partial_.c_str());
    return error_;
  }
  if (durable_ == Durable::yes) sync_folder(target_.parent_path());
  return {};
}

std::string write_file_atomically(const fs::path& path, std::string_view content, Durable durable) {
  StagedFile file(path, durable);
  file.write(content);
  return file.commit();
}

MayBeFault why_not_replaced(const std::string& path, const std::string& mark) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code code;
  if (!folder.empty() && !fs::is_directory(folder, code))
    return Fault{Code::cannot_write, path + ": cannot be written: there is no such folder"};
  if (::access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0)
    return Fault{Code::cannot_write,
                 failure(path, "cannot be written", std::error_code(errno, std::generic_category()))};
  const auto taken = [&](const std::string& why) { return Fault{Code::would_overwrite, path + ": " + why}; };
  const fs::file_status status = fs::symlink_status(path, code);
  if (!fs::exists(status)) return {};
  if (fs::is_symlink(status)) return taken("is a symbolic link, which a file would replace: name another");
  Diagnostics found;
  const auto content = text_of_file(path, found);
  if (!content) return taken(found.items().front().rule + ", so it will not be replaced: choose another name");
  if (content->empty() || content->find(mark) != std::string::npos) return {};
  return taken("is there already and was not written by this command: it will not be replaced; choose another name");
}

}  // namespace genu
