// Whole tables of results that a study keeps (`tables`): one file a shard, whole or not there, and all of them as
// tables.csv.
//
// shard-003-of-040.tables has for each kept run a line "# table RUN ROWS" and then results.csv as a normal run of it
// writes it. Tables of different runs may have different columns (one contact more): tables.csv has all of them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "genu/core/atomic_output.h"
#include "genu/core/diagnostics.h"
#include "genu/sweep/kept_tables.h"
#include "genu/sweep/shard_file.h"
#include "genu/sweep/sweep.h"

namespace genu {

/// Whether the study keeps the table of a run with this row of samples.csv.
bool wants_table(const Sweep& sweep, std::uint64_t run, std::string_view row);

/// "DIR/shard-003-of-040.tables"
std::string tables_path(const std::string& folder, ShardId id);

/// Writes the tables of a shard in the order of their runs. Returns what went wrong; an empty text where nothing did.
[[nodiscard]] std::string write_tables(const std::string& folder, const SweepRecord& record, ShardId id,
                                       const std::vector<std::uint64_t>& runs, const KeptTables& tables);

/// Whether the file of a shard's tables is whole, with the reason in `out` where it is not. `each` gets the line of
/// column names of every table.
[[nodiscard]] bool check_tables(const std::string& folder, const SweepRecord& record, ShardId id,
                                const std::function<void(std::string_view columns)>& each, Diagnostics& out);

/// Writes the tables of all shards into `file` as one CSV table: sample, scene and what-if in front, then every column
/// of any table. False, with the reasons in `out`, where a shard's file is not whole.
[[nodiscard]] bool merge_tables(const std::string& folder, const SweepRecord& record, StagedFile& file,
                                Diagnostics& out);

}  // namespace genu
