#include "genu/sweep/finished_rows.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "genu/core/file_checksum.h"
#include "genu/sweep/tolerances.h"

namespace genu {

FinishedRows::FinishedRows(std::string path, std::string belongs_to)
    : path_(std::move(path)), belongs_to_(std::move(belongs_to)) {
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    problem_ = path_ + ": cannot be written: " + std::strerror(errno);
    return;
  }
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    problem_ = path_ + ": another process computes this shard";
    taken_ = true;
    ::close(descriptor_);
    descriptor_ = -1;
    return;
  }
  read();
}

FinishedRows::~FinishedRows() {
  if (descriptor_ < 0) return;
  flush();
  ::close(descriptor_);
}

std::string FinishedRows::line_of(std::uint64_t run, const std::string& row) const {
  const std::string line = fmt::format("{},{}", run, row);
  return checksum(belongs_to_ + line).xxh128 + " " + line + "\n";
}

void FinishedRows::read() {
  std::ifstream in(path_, std::ios::binary);
  bool empty = true;
  for (std::string line; std::getline(in, line);) {
    empty = false;
    const std::size_t blank = line.find(' '), comma = line.find(',');
    std::uint64_t run = 0;
    const bool form = blank != std::string::npos && comma != std::string::npos && comma > blank &&
                      std::from_chars(line.data() + blank + 1, line.data() + comma, run).ptr == line.data() + comma;
    const std::string row = form ? line.substr(comma + 1) : std::string();
    if (form && line + "\n" == line_of(run, row)) earlier_.emplace(run, row);
  }
  if (!empty && ::write(descriptor_, "\n", 1) != 1) problem_ = path_ + ": cannot be written";
}

void FinishedRows::add(std::uint64_t run, const std::string& row) {
  if (descriptor_ < 0) return;
  const std::string line = line_of(run, row);
  const std::lock_guard<std::mutex> one_at_a_time(mutex_);
  waiting_ += line;
  if (timer_.seconds() - written_ >= kKeepSeconds) write_waiting();
}

void FinishedRows::flush() {
  const std::lock_guard<std::mutex> one_at_a_time(mutex_);
  if (descriptor_ >= 0) write_waiting();
}

void FinishedRows::write_waiting() {
  written_ = timer_.seconds();
  const auto size = static_cast<ssize_t>(waiting_.size());
  if (size > 0 && ::write(descriptor_, waiting_.data(), waiting_.size()) != size)
    problem_ = path_ + ": cannot be written: " + std::strerror(errno);
  waiting_.clear();
}

void FinishedRows::remove() {
  if (descriptor_ < 0) return;
  waiting_.clear();
  ::unlink(path_.c_str());
}

}  // namespace genu
