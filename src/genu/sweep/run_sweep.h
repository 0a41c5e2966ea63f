// Runs a study, or one shard of it, on all threads.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "genu/core/cancelled.h"
#include "genu/core/diagnostics.h"
#include "genu/sweep/shard_file.h"

namespace genu {

struct SweepOptions {
  ShardId shard;
  int threads = 0;  ///< at most; 0: as many as there are
  Cancelled cancelled;
  std::function<void(int done, int asked)> progress;  ///< one call at a time, from any thread; may be empty
};

struct SweepOutcome {
  std::uint64_t runs = 0, earlier = 0;           ///< of the shard; of an earlier start
  std::map<std::string, std::uint64_t> classes;  ///< how many runs of each class
  double seconds = 0;                            ///< of solving
  bool interrupted = false;
};

/// Computes the runs of the shard that are not finished and writes its file into `folder`; a file that is not whole is
/// replaced, with a warning. The same bytes on any number of threads, in one go or in several. Returns the exit code
/// (assemble/solution.h): incomplete where it was stopped, failed where another process computes this shard; samples
/// that fail are rows with a reason and no failure of the sweep.
[[nodiscard]] int run_shard(const Sweep& sweep, const std::string& folder, const SweepOptions& options,
                            Diagnostics& out, SweepOutcome& outcome);

}  // namespace genu
