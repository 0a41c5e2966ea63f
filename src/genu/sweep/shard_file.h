// The results of a shard as one file that is whole or not there: a head with the study's hash and the program, column
// names, a row for each run, and an end with the checksum of all before it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/sweep/solve_sample.h"
#include "genu/sweep/sweep_record.h"

namespace genu {

struct ShardId {
  std::uint64_t number = 1, count = 1;  ///< number from 1

  std::uint64_t first(std::uint64_t runs) const { return part(runs, number - 1); }
  std::uint64_t last(std::uint64_t runs) const { return part(runs, number); }  ///< one behind the last

 private:
  std::uint64_t part(std::uint64_t runs, std::uint64_t k) const { return runs / count * k + runs % count * k / count; }
};

/// "DIR/shard-003-of-040.csv"
std::string shard_path(const std::string& folder, ShardId id);

/// "sample,scene,what_if,class,jumps,jump_at,...,reason"
std::string column_line(const SweepRecord& record);
/// "17,knee,as_is,": how the row of a run begins.
std::string begin_of_row(const SweepRecord& record, std::uint64_t run);
/// The row of a run, without the end of the line.
std::string row_line(const SweepRecord& record, std::uint64_t run, const SampleResult& result);

/// Writes the file of a shard. Returns what went wrong; an empty text where nothing did.
[[nodiscard]] std::string write_shard(const std::string& folder, const SweepRecord& record, ShardId id,
                                      const std::vector<std::string>& rows);

using EachRow = std::function<void(std::string_view row)>;

/// Calls `each` with the rows of a shard in order, once all of the file has been checked; holds a row at a time.
/// Returns the program (store/input_hash.h) that computed them. Empty, with an error in `out` that names the file,
/// where it is cut short, changed or of another study.
[[nodiscard]] std::optional<std::string> read_shard(const std::string& folder, const SweepRecord& record, ShardId id,
                                                    const EachRow& each, Diagnostics& out);

/// "3,17-19"
std::string as_array_list(const std::vector<std::uint64_t>& numbers);

/// The cells of a line of CSV; none where a quote is not closed.
std::vector<std::string> split_row(std::string_view line);

/// The class in a row: its fourth cell.
std::string class_of_row(std::string_view line);

}  // namespace genu
