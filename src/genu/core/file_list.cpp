#include "genu/core/file_list.h"

#include <algorithm>
#include <fstream>
#include <system_error>

namespace genu {
namespace {

namespace fs = std::filesystem;

constexpr const char* kGenu = "genu ";

bool leads_out(const fs::path& relative) {
  return relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end();
}

/// Every entry of a folder that is a file, a link or an empty folder, relative to it. No link is followed.
std::vector<std::string> leaves(const fs::path& folder) {
  std::vector<std::string> found;
  std::error_code code;
  for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    std::error_code ignored;
    const bool inner = it->symlink_status(ignored).type() == fs::file_type::directory && !fs::is_empty(*it, ignored);
    if (!inner) found.push_back(it->path().lexically_relative(folder).string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::optional<FileList> read_file_list(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_regular_file(fs::symlink_status(folder / kFileList, ignored))) return std::nullopt;
  std::ifstream in(folder / kFileList, std::ios::binary);
  std::string line;
  if (!std::getline(in, line) || line.rfind(kGenu, 0) != 0) return std::nullopt;
  FileList list{line.substr(std::string(kGenu).size()), {}};
  while (std::getline(in, line))
    if (!line.empty() && !leads_out(line)) list.files.insert(line);
  return list;
}

std::string write_file_list(const fs::path& folder, const std::string& kind) {
  std::ofstream out(folder / kFileList, std::ios::binary);
  out << kGenu << kind << '\n';
  for (const std::string& file : leaves(folder))
    if (file != kFileList) out << file << '\n';
  out.close();
  return out ? std::string() : (folder / kFileList).string() + ": cannot be written";
}

std::vector<std::string> not_listed(const fs::path& folder, const FileList& list) {
  std::vector<std::string> found = leaves(folder);
  std::erase_if(found, [&](const std::string& file) { return file == kFileList || list.files.count(file) > 0; });
  return found;
}

void remove_listed(const fs::path& folder, const std::string& kind) {
  const auto list = read_file_list(folder);
  if (!list || list->kind != kind) return;
  std::error_code ignored;
  std::set<fs::path> folders;
  for (const std::string& file : list->files) {
    fs::remove(folder / file, ignored);
    for (fs::path above = fs::path(file).parent_path(); !above.empty(); above = above.parent_path())
      folders.insert(folder / above);
  }
  fs::remove(folder / kFileList, ignored);
  // Deeper ones sort behind those that hold them; one that is not empty stays.
  for (auto it = folders.rbegin(); it != folders.rend(); ++it) fs::remove(*it, ignored);
  fs::remove(folder, ignored);
}

}  // namespace genu
