#include "genu/sweep/kept_tables.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "genu/core/file_checksum.h"

namespace genu {
namespace {

constexpr std::string_view kMark = "# table ";

}  // namespace

KeptTables::KeptTables(std::string path, std::string belongs_to)
    : path_(std::move(path)), belongs_to_(std::move(belongs_to)) {
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    problem_ = path_ + ": cannot be written: " + std::strerror(errno);
    return;
  }
  find_earlier();
}

KeptTables::~KeptTables() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::string KeptTables::sum_of(std::uint64_t run, std::string_view table) const {
  RunningChecksum sum;
  sum.add(fmt::format("{}\n{}\n", belongs_to_, run));
  sum.add(table);
  return sum.sum().xxh128;
}

void KeptTables::find_earlier() {
  std::ifstream in(path_, std::ios::binary);
  std::string line, table;
  while (std::getline(in, line)) {
    if (!line.starts_with(kMark)) continue;  // the rest of a table that was cut off
    std::uint64_t run = 0;
    Place place;
    const char* const end = line.data() + line.size();
    const auto first = std::from_chars(line.data() + kMark.size(), end, run);
    if (first.ec != std::errc() || first.ptr == end) continue;
    const auto second = std::from_chars(first.ptr + 1, end, place.size);
    if (second.ec != std::errc() || second.ptr == end) continue;
    const auto begin = in.tellg();
    place.offset = static_cast<std::uint64_t>(begin);
    in.seekg(0, std::ios::end);
    const auto left = static_cast<std::uint64_t>(in.tellg() - begin);
    in.seekg(begin);
    if (place.size > left) continue;
    table.resize(place.size);
    in.read(table.data(), static_cast<std::streamsize>(place.size));
    if (std::string_view(second.ptr + 1, end) == sum_of(run, table))
      places_[run] = place;
    else
      in.seekg(begin);
  }
  if (places_.empty() && ::ftruncate(descriptor_, 0) == 0) return;
  write("\n");  // ends a line that was cut off
}

bool KeptTables::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      problem_ = path_ + ": cannot be written: " + std::strerror(errno);
      return false;
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool KeptTables::has(std::uint64_t run) const {
  const std::lock_guard<std::mutex> one_at_a_time(mutex_);
  return places_.count(run) > 0;
}

bool KeptTables::add(std::uint64_t run, std::string_view table) {
  const std::string text = fmt::format("{}{} {} {}\n{}", kMark, run, table.size(), sum_of(run, table), table);
  const std::lock_guard<std::mutex> one_at_a_time(mutex_);
  if (descriptor_ < 0 || !write(text)) return false;
  const off_t end = ::lseek(descriptor_, 0, SEEK_CUR);
  places_[run] = {static_cast<std::uint64_t>(end) - table.size(), table.size()};
  return true;
}

std::optional<std::string> KeptTables::read(std::uint64_t run) const {
  const std::lock_guard<std::mutex> one_at_a_time(mutex_);
  const auto place = places_.find(run);
  if (place == places_.end()) return std::nullopt;
  std::string table(place->second.size, '\0');
  std::size_t got = 0;
  while (got < table.size()) {
    const ssize_t read =
        ::pread(descriptor_, table.data() + got, table.size() - got, static_cast<off_t>(place->second.offset + got));
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) return std::nullopt;
    got += static_cast<std::size_t>(read);
  }
  return table;
}

void KeptTables::remove() {
  if (descriptor_ >= 0) ::unlink(path_.c_str());
}

}  // namespace genu
