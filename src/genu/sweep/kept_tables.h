// The tables of finished runs of a shard that is being computed, on disk: all of them may be larger than the memory,
// and whatever ends the work, the next start has them.
//
// The file is beside the shard's, shard-003-of-040.tables.part: for each table a line with its run, length and
// checksum, and its text. What was cut off is left out.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace genu {

class KeptTables {
 public:
  /// `belongs_to`: a text that no other work has. Only one process may have the file (finished_rows.h).
  KeptTables(std::string path, std::string belongs_to);
  ~KeptTables();
  KeptTables(const KeptTables&) = delete;
  KeptTables& operator=(const KeptTables&) = delete;

  bool has(std::uint64_t run) const;
  /// False where it cannot be written. From any thread.
  [[nodiscard]] bool add(std::uint64_t run, std::string_view table);
  /// Empty where it is not there or cannot be read.
  std::optional<std::string> read(std::uint64_t run) const;
  /// The work is done: removes the file.
  void remove();

  const std::string& problem() const { return problem_; }

 private:
  struct Place {
    std::uint64_t offset = 0, size = 0;
  };
  std::string sum_of(std::uint64_t run, std::string_view table) const;
  void find_earlier();
  bool write(std::string_view text);

  std::string path_, belongs_to_, problem_;
  std::map<std::uint64_t, Place> places_;
  int descriptor_ = -1;
  mutable std::mutex mutex_;
};

}  // namespace genu
