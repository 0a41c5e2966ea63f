// The finished rows of a shard that is being computed: whatever ends the work, the next start continues with them.
//
// The file is beside the shard's, shard-003-of-040.csv.part: a line for each finished run, in the order in which they
// ended, each with a checksum of itself and of what the rows belong to. Lines that were cut off are left out.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "genu/core/timer.h"

namespace genu {

class FinishedRows {
 public:
  /// `belongs_to`: a text that no other work has. Keeps nothing where another process has the file (taken()) or it
  /// cannot be written: problem() says why. A file system without locks keeps rows all the same: lines of two processes
  /// have checksums each.
  FinishedRows(std::string path, std::string belongs_to);
  ~FinishedRows();
  FinishedRows(const FinishedRows&) = delete;
  FinishedRows& operator=(const FinishedRows&) = delete;

  /// What an earlier start has left: rows by their runs. Once: they are not kept here.
  std::map<std::uint64_t, std::string> take_earlier() { return std::exchange(earlier_, {}); }

  /// Adds a row; written down about once a second. From any thread.
  void add(std::uint64_t run, const std::string& row);
  /// Writes down what was added since.
  void flush();
  /// The work is done: removes the file.
  void remove();

  const std::string& belongs_to() const { return belongs_to_; }
  const std::string& problem() const { return problem_; }
  /// Another process computes this shard at this moment.
  bool taken() const { return taken_; }

 private:
  void read();
  std::string line_of(std::uint64_t run, const std::string& row) const;
  void write_waiting();

  std::string path_, belongs_to_, problem_, waiting_;
  std::map<std::uint64_t, std::string> earlier_;
  int descriptor_ = -1;
  bool taken_ = false;
  double written_ = 0;
  Timer timer_;
  std::mutex mutex_;
};

}  // namespace genu
