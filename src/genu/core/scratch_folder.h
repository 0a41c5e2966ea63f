// A folder for a while.
#pragma once

#include <filesystem>
#include <string>

namespace genu {

/// A new folder below the system's temporary one ($TMPDIR), its name beginning with `name`; gone with the object, with
/// all that is in it.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& name);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  /// Empty where it could not be made.
  const std::filesystem::path& path() const { return path_; }
  /// Why not: names the temporary folder. Else empty.
  const std::string& problem() const { return problem_; }

 private:
  std::filesystem::path path_;
  std::string problem_;
};

}  // namespace genu
