// Results appear whole or not at all: what is written first stands beside its target under another name, and takes the
// target's name in one rename once it is complete. Whoever reads the target meanwhile sees the old result or the new
// one, never a half. Errors come back as text, where the empty text is success, or as a fault, where none is success.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "genu/core/diagnostics.h"

namespace genu {

/// A results folder under construction:
///   StagedFolder out("results");
///   std::string error = text_of(out.open("out/knee"));  // refuses what commit() could not or should not replace
///   ... write files into out.path() ...
///   if (error.empty()) error = out.commit();
/// A StagedFolder that is never committed removes what it made and leaves the target as it was. With the files comes
/// their list (file_list.h): by it the next one of the same kind knows which files are genu's to replace. Whatever
/// else lies in the folder by then, notes or another result, is kept.
class StagedFolder {
 public:
  /// `kind`: what the files are, "results"; empty: no list is written, so nothing will ever replace the folder.
  explicit StagedFolder(std::string kind) : kind_(std::move(kind)) {}
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Makes an empty folder beside `target` (and target's missing parents). Refuses a target that is a file, a root, the
  /// working folder or a folder above it, a folder that is read-only, or one with content that is no result of this
  /// kind. A target that is a symbolic link stands for the folder it points to.
  [[nodiscard]] std::optional<Fault> open(const std::filesystem::path& target);

  /// Where to write until commit(); empty before open() and after commit().
  const std::filesystem::path& path() const { return staging_; }

  /// Puts the folder in the target's place; an earlier result there is replaced as a whole, files of others move along.
  /// On an error the earlier result stands as it was and the new files are still in path(), until the destructor
  /// removes them.
  [[nodiscard]] std::string commit();

 private:
  std::string kind_;
  std::filesystem::path target_;
  std::filesystem::path staging_;
};

/// In words; empty where there is none.
inline std::string text_of(const std::optional<Fault>& fault) { return fault ? fault->text : std::string(); }

/// Whether a file lies in a folder, at any depth, links followed: replacing the folder would lose it.
[[nodiscard]] bool folder_holds(const std::filesystem::path& folder, const std::filesystem::path& file);

/// Whether a power cut leaves the old content or the new one too: then commit() waits for the disk.
enum class Durable { no, yes };

/// A file under construction, whole or not at all: a reader, a full disk or a crash of the program leaves the old
/// content or the new one. Refuses to replace what is not a regular file, links too. What is not committed leaves
/// nothing. Several may write the same file: the last commit() stays.
class StagedFile {
 public:
  explicit StagedFile(std::filesystem::path path, Durable durable = Durable::no);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  /// What goes wrong is the text of commit().
  void write(std::string_view content);
  [[nodiscard]] std::string commit();

 private:
  void flush();
  void close();
  void fail(int error);

  std::filesystem::path target_, partial_;
  Durable durable_;
  std::string waiting_, error_;
  int descriptor_ = -1;
};

/// The same of content that is at hand.
[[nodiscard]] std::string write_file_atomically(const std::filesystem::path& path, std::string_view content,
                                                Durable durable = Durable::no);

/// None where a file can be written at `path` and none is there, or one that holds `mark`, which whoever asks writes
/// into files of that kind. Else why not: it may be all that somebody has of a scene, a mesh or another result.
[[nodiscard]] std::optional<Fault> why_not_replaced(const std::string& path, const std::string& mark);

}  // namespace genu
