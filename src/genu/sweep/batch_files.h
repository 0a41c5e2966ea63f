// Scripts that let a batch system compute the shards of a sweep.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/sweep/sweep_record.h"

namespace genu {

struct BatchOptions {
  std::string program;           ///< path of genu
  std::string time = "1:00:00";  ///< limit of one shard, as Slurm takes it
  int nodes = 0;                 ///< most shards at a time; 0: as many as the system gives
  int cores = 0;                 ///< of one shard; 0: a whole node; one of HTCondor, which gives cores
};

/// Files for the shards in `missing`: sweep.sbatch (Slurm), sweep.condor (HTCondor), sweep.parallel (GNU parallel).
/// `folder`: absolute.
std::vector<std::pair<std::string, std::string>> batch_files(const SweepRecord& record, const std::string& folder,
                                                             const std::vector<std::uint64_t>& missing,
                                                             const BatchOptions& options);

}  // namespace genu
