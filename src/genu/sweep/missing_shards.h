// Which shards of a folder have still to be computed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/sweep/shard_file.h"
#include "genu/sweep/sweep_record.h"

namespace genu {

/// Calls `each` with the rows of a shard whose files are all there and whole, that of its tables too. Else false, with
/// the reason in `out`.
[[nodiscard]] bool shard_is_whole(const std::string& folder, const SweepRecord& record, ShardId id, const EachRow& each,
                                  Diagnostics& out);

/// Shards that are not there or not whole; of the latter a warning in `out`.
std::vector<std::uint64_t> missing_shards(const std::string& folder, const SweepRecord& record, Diagnostics& out);

}  // namespace genu
