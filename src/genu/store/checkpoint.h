// A run that may be killed saves its progress: rows, events, and the state from which the path continues.
//
// The file is beside the results, DIR.checkpoint. It begins with what it is bound to (input_hash.h); after that
// comes one part for each time something was added. Each part has its length and a hash of itself and the hash before
// it: a part that was cut off or changed, and all behind it, are left out. Parts are added between rows, a second and
// more apart, so a run of less than a second writes nothing. What a run computes does not depend on any of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "genu/core/timer.h"
#include "genu/results/pose_table.h"

namespace genu {

class Checkpoint {
 public:
  using Inputs = std::vector<std::pair<std::string, std::string>>;

  /// Of a run of `inputs` (input_hashes()) into `folder`; `every`: seconds from part to part, 0: wherever
  /// add() is called; longer where writing takes more than 5 % of the time. Writes nothing yet.
  Checkpoint(const std::string& folder, Inputs inputs, double every);
  ~Checkpoint();
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;

  /// Reads what an earlier run has left. False, with the reason in `out`, where it belongs to other inputs or another
  /// program, or another run is writing it; a warning where nothing is there, or less than was written.
  [[nodiscard]] bool resume(Diagnostics& out);

  /// Why the file cannot be written from now on: what is there is no checkpoint, or is another run's. Else empty.
  [[nodiscard]] std::string blocked();

  /// What resume() has found: rows and events, and the state from which follow_path() continues; empty if it found
  /// none.
  std::vector<PoseRecord> records;
  std::vector<PathEvent> events;
  std::string path;

  /// To be called where a walk rests (PathObserver::rest), with all rows and events until there.
  void add(const std::vector<PoseRecord>& all_records, const std::vector<PathEvent>& all_events,
           const std::function<std::string()>& save);

  const std::string& file() const { return file_; }
  /// How many rows the file holds, of this run or an earlier one.
  std::size_t rows() const { return rows_; }
  /// Whether the file is there and is still what an earlier run has left.
  bool earlier() const;
  /// Why the last part could not be written; empty where it was.
  const std::string& problem() const { return problem_; }
  /// The work is done: removes the file.
  void remove();

 private:
  bool open();
  bool append(const std::string& part);
  void write(const std::vector<PoseRecord>& all_records, const std::vector<PathEvent>& all_events,
             const std::function<std::string()>& save);
  [[nodiscard]] bool read_parts(const std::string& content, Diagnostics& out);

  std::string file_, problem_, hash_;  // hash_: of the last part
  Inputs inputs_;
  double every_, next_;  // next_: s since the run began
  Timer timer_;
  int descriptor_ = -1;
  std::size_t size_ = 0, rows_ = 0, events_ = 0;
};

/// DIR.checkpoint and DIR.partial of a results folder DIR.
std::string beside(std::string folder, const char* ending);

}  // namespace genu
