#include "genu/core/input_files.h"

#include <filesystem>
#include <fstream>
#include <utility>

namespace genu {
namespace {

std::shared_ptr<const std::string> read_whole(const std::string& path) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) return nullptr;  // a pipe or a device might have no end
  std::ifstream in(path, std::ios::binary);
  if (!in) return nullptr;
  auto bytes = std::make_shared<std::string>();
  const auto size = std::filesystem::file_size(path, failed);
  if (!failed) bytes->reserve(static_cast<std::size_t>(size));
  char block[1 << 16];
  while (in.read(block, sizeof block) || in.gcount() > 0) bytes->append(block, static_cast<std::size_t>(in.gcount()));
  return in.bad() ? nullptr : bytes;
}

}  // namespace

const InputFiles::File& InputFiles::read(const std::string& path) {
  const auto [place, is_new] = files_.try_emplace(path);
  File& file = place->second;
  if (!is_new) return file;
  file.bytes = read_whole(path);
  if (file.bytes) file.checksum = genu::checksum(*file.bytes);
  return file;
}

std::shared_ptr<const std::string> InputFiles::bytes(const std::string& path) {
  const std::lock_guard lock(mutex_);
  read(path);
  File& file = files_[path];
  if (std::exchange(file.aside, false)) {
    file.bytes = read_whole(path);
    if (file.bytes && genu::checksum(*file.bytes).xxh128 != file.checksum->xxh128) file.bytes.reset();
  }
  return file.bytes;
}

void InputFiles::set_aside(const std::string& path) {
  const std::lock_guard lock(mutex_);
  const auto place = files_.find(path);
  if (place == files_.end() || !place->second.bytes || place->second.given) return;
  place->second.bytes.reset();
  place->second.aside = true;
}

void InputFiles::put(const std::string& path, std::string bytes) {
  const std::lock_guard lock(mutex_);
  File& file = files_[path];
  file.bytes = std::make_shared<const std::string>(std::move(bytes));
  file.checksum = genu::checksum(*file.bytes);
  file.given = true;
}

std::optional<FileChecksum> InputFiles::checksum(const std::string& path) {
  const std::lock_guard lock(mutex_);
  return read(path).checksum;
}

void InputFiles::release(const std::string& path) {
  const std::lock_guard lock(mutex_);
  const auto place = files_.find(path);
  if (place != files_.end()) place->second.bytes.reset();
}

}  // namespace genu
