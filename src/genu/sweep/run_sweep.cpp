#include "genu/sweep/run_sweep.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <mutex>
#include <optional>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "genu/assemble/solution.h"
#include "genu/core/program_hash.h"
#include "genu/core/timer.h"
#include "genu/sweep/finished_rows.h"
#include "genu/sweep/missing_shards.h"
#include "genu/sweep/sweep_record.h"
#include "genu/sweep/table_file.h"

namespace genu {
namespace {

/// Solves what is missing of `rows`, in any order.
class Runs {
 public:
  Runs(const Sweep& sweep, const SweepRecord& record, const SweepOptions& options, FinishedRows& finished,
       std::vector<std::string>& rows, KeptTables* tables)
      : sweep_(sweep),
        record_(record),
        options_(options),
        finished_(finished),
        rows_(rows),
        tables_(tables),
        first_(options.shard.first(sweep.runs())) {}

  void run() {
    std::vector<std::size_t> left;
    for (std::size_t k = 0; k < rows_.size(); ++k)
      if (rows_[k].empty()) left.push_back(k);
    asked_ = static_cast<int>(left.size());
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, left.size(), 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t k = range.begin(); k < range.end(); ++k)  // its own inner loops alone while it waits
            tbb::this_task_arena::isolate([&] { solve(left[k]); });
        },
        tbb::simple_partitioner());
  }

 private:
  void solve(std::size_t k) {
    if (asked_to_stop(options_.cancelled)) return;
    const std::uint64_t run = first_ + k;
    const auto result = solve_sample(sweep_, sweep_.case_of(run), sweep_.sample_of(run), options_.cancelled);
    if (!result) return;
    std::string row = row_line(record_, run, *result);
    if (tables_ != nullptr && result->table && wants_table(sweep_, run, row) &&
        !tables_->add(run, result->table->to_csv()))
      return;  // the disk is full: a row comes after its table
    rows_[k] = std::move(row);
    finished_.add(run, rows_[k]);
    const std::lock_guard<std::mutex> one_at_a_time(telling_);
    ++done_;
    if (options_.progress) options_.progress(done_, asked_);
  }

  const Sweep& sweep_;
  const SweepRecord& record_;
  const SweepOptions& options_;
  FinishedRows& finished_;
  std::vector<std::string>& rows_;
  KeptTables* tables_;  // null: the study keeps none
  std::uint64_t first_;
  std::mutex telling_;
  int done_ = 0, asked_ = 0;
};

void count_class(std::string_view row, SweepOutcome& outcome) { ++outcome.classes[class_of_row(row)]; }

/// Whether the shard is there, counted in `outcome`. One that is cut short or changed is none: the folder belongs to
/// this study, so it can be computed again.
bool is_there(const std::string& folder, const SweepRecord& record, ShardId id, SweepOutcome& outcome,
              Diagnostics& out) {
  std::error_code ignored;
  if (!std::filesystem::exists(shard_path(folder, id), ignored)) return false;
  Diagnostics broken;
  const auto count = [&](std::string_view row) { count_class(row, outcome), ++outcome.earlier; };
  const bool whole = shard_is_whole(folder, record, id, count, broken);
  for (const Diagnostic& d : broken.items()) out.warning(d.code, d.file, d.rule + ": it is computed again");
  return whole;
}

/// Whether the study keeps the table of a finished run, and it is not there. Where nothing was solved there is none.
bool lacks_table(const Sweep& sweep, std::uint64_t run, std::string_view row, const KeptTables& tables) {
  return class_of_row(row) != "refused" && wants_table(sweep, run, row) && !tables.has(run);
}

/// The runs of a shard that keep their tables, in order.
std::vector<std::uint64_t> runs_with_tables(const Sweep& sweep, std::uint64_t first,
                                            const std::vector<std::string>& rows, const KeptTables& tables) {
  std::vector<std::uint64_t> runs;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (tables.has(first + k) && wants_table(sweep, first + k, rows[k])) runs.push_back(first + k);
  return runs;
}

}  // namespace

int run_shard(const Sweep& sweep, const std::string& folder, const SweepOptions& options, Diagnostics& out,
              SweepOutcome& outcome) {
  const SweepRecord record = record_of(sweep, options.shard.count);
  if (!claim_folder(folder, record, out)) return kExitRefused;
  const std::uint64_t first = options.shard.first(sweep.runs());
  outcome.runs = options.shard.last(sweep.runs()) - first;
  const std::string path = shard_path(folder, options.shard);
  if (is_there(folder, record, options.shard, outcome, out)) return kExitOk;
  FinishedRows finished(path + ".part", fmt::format("{} {}/{} {}", record.hash, options.shard.number,
                                                    options.shard.count, program_hash()));
  if (finished.taken()) {
    out.error(Code::conflict, path, "another process computes this shard: wait for it, or end it");
    return kExitFailed;
  }
  std::optional<KeptTables> tables;
  if (record.tables) tables.emplace(tables_path(folder, options.shard) + ".part", finished.belongs_to());
  if (tables && !tables->problem().empty()) {
    out.error(Code::cannot_write, {}, tables->problem());
    return kExitFailed;
  }
  std::vector<std::string> rows(outcome.runs);
  for (auto& [run, row] : finished.take_earlier())
    if (run >= first && run - first < rows.size() && (!tables || !lacks_table(sweep, run, row, *tables)))
      rows[run - first] = std::move(row), ++outcome.earlier;
  const Timer timer;
  {
    std::optional<tbb::global_control> at_most;
    if (options.threads > 0)
      at_most.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
    Runs(sweep, record, options, finished, rows, tables ? &*tables : nullptr).run();
  }
  outcome.seconds = timer.seconds();
  for (const std::string& row : rows)
    if (!row.empty()) count_class(row, outcome);
  if (!finished.problem().empty())
    out.warning(Code::cannot_write, {}, finished.problem() + ": finished samples are not kept on the way");
  if (tables && !tables->problem().empty()) {
    out.error(Code::cannot_write, {}, tables->problem());
    return kExitFailed;
  }
  if (std::any_of(rows.begin(), rows.end(), [](const std::string& row) { return row.empty(); })) {
    outcome.interrupted = true;
    return kExitIncomplete;
  }
  std::string error;
  if (tables)
    error = write_tables(folder, record, options.shard, runs_with_tables(sweep, first, rows, *tables), *tables);
  if (error.empty()) error = write_shard(folder, record, options.shard, rows);
  if (!error.empty()) {
    finished.flush();
    out.error(Code::cannot_write, {}, error);
    return kExitFailed;
  }
  finished.remove();
  if (tables) tables->remove();
  return kExitOk;
}

}  // namespace genu
