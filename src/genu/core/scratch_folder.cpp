#include "genu/core/scratch_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace genu {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder(const std::string& name) {
  std::error_code failed;
  const fs::path parent = fs::temp_directory_path(failed);
  if (failed) {
    const char* named = std::getenv("TMPDIR");
    problem_ = std::string(named != nullptr ? named : "/tmp") + ": is no folder for temporary files: set TMPDIR";
    return;
  }
  std::string path = (parent / (name + "-XXXXXX")).string();
  if (::mkdtemp(path.data()) != nullptr)
    path_ = path;
  else
    problem_ = parent.string() + ": no folder can be made there (" + std::strerror(errno) + "): set TMPDIR";
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace genu
