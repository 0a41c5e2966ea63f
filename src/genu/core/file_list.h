// What genu put into a folder, by name: so that a folder written again loses nothing of anyone else's.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace genu {

/// Name of the list in its folder: "genu KIND", then one path a line, relative to the folder.
inline constexpr const char* kFileList = ".genu-files";

struct FileList {
  std::string kind;             ///< what they are: "results"
  std::set<std::string> files;  ///< relative to the folder
};

/// Empty where the folder has none, or one that genu did not write.
[[nodiscard]] std::optional<FileList> read_file_list(const std::filesystem::path& folder);

/// Lists all files in the folder, at any depth. An error as text; the empty text is success.
[[nodiscard]] std::string write_file_list(const std::filesystem::path& folder, const std::string& kind);

/// Files, links and empty folders in the folder that are not on the list: relative paths, sorted.
std::vector<std::string> not_listed(const std::filesystem::path& folder, const FileList& list);

/// Removes what is on the folder's list where that is of this kind, and the folder where nothing else is left in it.
void remove_listed(const std::filesystem::path& folder, const std::string& kind);

}  // namespace genu
