// genu sweep study.toml --out out/study
//   1. read the study, its scenes and meshes; refuse with every error at once
//   2. solve every sample in every case, on all threads; keep what is finished, continue after whatever ends the work
//   3. write samples.csv, statistics and report.html; print a summary
// genu sweep study.toml --out out/study --shard 3/40      a part of it, in one file; then genu sweep merge out/study
// genu sweep study.toml --sample 17 --out out/sample-17   one sample as a normal run
#include <malloc.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include "advice.h"
#include "commands.h"
#include "genu/core/atomic_output.h"
#include "genu/core/file_text.h"
#include "genu/study/run_scene.h"
#include "genu/sweep/batch_files.h"
#include "genu/sweep/merge_sweep.h"
#include "genu/sweep/missing_shards.h"
#include "genu/sweep/run_sweep.h"
#include "genu/sweep/write_sample.h"
#include "progress.h"

namespace genu::cli {
namespace {

constexpr int kMostThreads = 4096, kMostShards = 1'000'000;

struct SweepArguments {
  std::vector<std::string> words;  ///< STUDY, or an action and a folder
  std::string folder, shard, in_case, time = "1:00:00";
  std::optional<long> sample;
  int threads = 0, plan = 0, nodes = 0, cores = 0;
  bool slurm = false, quiet = false;
};

std::optional<ShardId> parse_shard(const std::string& text) {
  ShardId id;
  const char *first = text.data(), *last = first + text.size();
  const auto [slash, error] = std::from_chars(first, last, id.number);
  if (error != std::errc() || slash == last || *slash != '/') return std::nullopt;
  const auto [end, second] = std::from_chars(slash + 1, last, id.count);
  if (second != std::errc() || end != last || id.number < 1 || id.number > id.count ||
      id.count > static_cast<std::uint64_t>(kMostShards))
    return std::nullopt;
  return id;
}

int merge(const std::string& folder, bool quiet) {
  Diagnostics out;
  std::string text;
  const int code = merge_sweep(folder, out, text);
  print(out, code == kFailed);
  if (code != kOk) return code;
  std::stringstream lines(quiet ? std::string() : text);
  for (std::string line; std::getline(lines, line);) fmt::print("{}\n", printable(line));
  const auto also = [&](const char* name) {
    return std::filesystem::exists(std::filesystem::path(folder) / name) ? std::string(name) + ", " : std::string();
  };
  fmt::print(
      "  {:<12}{}/samples.csv, samples.npz, {}statistics.csv, events.csv, ranks.csv, {}convergence.csv, summary.json, "
      "report.html\n",
      "written", folder, also("tables.csv"), also("indices.csv"));
  return code;
}

int missing(const std::string& folder) {
  Diagnostics out;
  const auto record = read_record(folder, out);
  if (!record) return refuse(out);
  const auto list = missing_shards(folder, *record, out);
  print(out, true);
  if (!list.empty()) fmt::print("{}\n", as_array_list(list));
  return list.empty() ? kOk : kNotAllOk;
}

/// Where this program is, for scripts that start it.
std::string own_path() {
  std::error_code ignored;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return path.empty() ? "genu" : path.string();
}

bool write_batch_files(const SweepArguments& arguments, const SweepRecord& record, const std::string& folder,
                       const std::vector<std::uint64_t>& missing, Diagnostics& out) {
  BatchOptions options;
  options.program = own_path();
  options.time = arguments.time;
  options.nodes = arguments.nodes;
  options.cores = arguments.cores;
  const std::string absolute = std::filesystem::absolute(folder).lexically_normal().string();
  for (const auto& [name, content] : batch_files(record, absolute, missing, options))
    if (const std::string error = write_file_atomically(folder + "/" + name, content, Durable::yes); !error.empty())
      out.error(Code::cannot_write, {}, error);
  return !out.has_errors();
}

int submit(const SweepArguments& arguments, const std::string& folder) {
  Diagnostics out;
  const auto record = read_record(folder, out);
  if (!record) return refuse(out);
  const auto missing = missing_shards(folder, *record, out);  // broken ones too, each with a warning
  if (!write_batch_files(arguments, *record, folder, missing, out)) return refuse(out);
  print(out, true);
  if (missing.empty()) {
    fmt::print("Nothing is missing: genu sweep merge {}\n", shell_word(folder));
    return kOk;
  }
  fmt::print("  {:<12}{}/sweep.sbatch, sweep.condor, sweep.parallel\n", "written", folder);
  std::fflush(stdout);
  if (!arguments.slurm) return kOk;
  if (std::system("command -v sbatch >/dev/null 2>&1") != 0) {
    Diagnostics lacking;
    lacking.error(Code::not_applicable, {},
                  "sbatch is not installed here: copy sweep.sbatch to a machine of the cluster");
    print(lacking);
    return kFailed;
  }
  return std::system(("sbatch " + shell_word(folder + "/sweep.sbatch")).c_str()) == 0 ? kOk : kFailed;
}

/// Prepares the folder and the scripts of a divided sweep; computes nothing.
int plan(const SweepArguments& arguments, const Sweep& sweep) {
  Diagnostics out;
  const SweepRecord record = record_of(sweep, static_cast<std::uint64_t>(arguments.plan));
  if (!claim_folder(arguments.folder, record, out) ||
      !write_batch_files(arguments, record, arguments.folder, missing_shards(arguments.folder, record, out), out))
    return refuse(out);
  fmt::print("{} runs in {} shards\n  {:<12}{}/sweep.json, sweep.sbatch, sweep.condor, sweep.parallel\n", sweep.runs(),
             arguments.plan, "written", arguments.folder);
  return kOk;
}

int run_sample(const SweepArguments& arguments, const Sweep& sweep) {
  const SweepCase* in = &sweep.cases.front();
  std::string known;
  for (const SweepCase& c : sweep.cases) {
    const std::string name = c.scene + "/" + c.what_if;
    known += (known.empty() ? "" : ", ") + name;
    if (name == arguments.in_case) in = &c;
  }
  if (!arguments.in_case.empty() && in->scene + "/" + in->what_if != arguments.in_case)
    return refuse(Code::unknown_name, "--case: the cases of this study are " + known);
  if (*arguments.sample < 0 || static_cast<std::uint64_t>(*arguments.sample) >= sweep.design.samples())
    return refuse(Code::out_of_range, fmt::format("--sample: must be from 0 to {}", sweep.design.samples() - 1));
  Diagnostics out;
  RunOptions options;
  options.report = true;
  options.cancelled = options.path.newton.cancelled = stop_on_interrupt();
  Solution found;
  const auto sample = static_cast<std::uint64_t>(*arguments.sample);
  const auto source = write_sample(sweep, *in, sample, arguments.folder, out);
  if (!source) return refuse(out);
  const int code = run_scene(*source, arguments.folder, options, out, &found);
  print(out, code != kRefused);
  if (code == kRefused) return code;
  if (code == kNotAllOk)
    advice().next("the verdict above says where the sample ends and why; its rows before are valid");
  for (const std::string& sentence : found.summary.verdict)
    fmt::print("  {:<12}{}\n", &sentence == &found.summary.verdict.front() ? "verdict" : "", printable(sentence));
  const std::string own = source->path == in->source.path ? std::string() : ", " + source->path;
  fmt::print("  {:<12}{}{}\n", "written", found.folder, own);
  return code;
}

std::string words_of(const SweepOutcome& outcome) {
  std::string words = fmt::format("{} runs", outcome.runs);
  for (const auto& [name, count] : outcome.classes) words += fmt::format(", {} {}", count, name);
  if (outcome.earlier > 0) words += fmt::format("; {} of an earlier start", outcome.earlier);
  const auto computed = static_cast<double>(outcome.runs - outcome.earlier);
  if (outcome.seconds > 0 && computed > 0 && !outcome.interrupted)
    words += fmt::format("; {:.1f} s, {:.3g} a second", outcome.seconds, computed / outcome.seconds);
  return words;
}

/// Keeps the memory that a sample gives back for the next one: returning it to the system takes a tenth of the time of
/// small scenes.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kBytesKept = 1 << 28, kLargeBlock = 1 << 25;
  mallopt(M_TRIM_THRESHOLD, kBytesKept);
  mallopt(M_MMAP_THRESHOLD, kLargeBlock);
#endif
}

int run_study(const SweepArguments& arguments, const Sweep& sweep) {
  keep_freed_memory();
  SweepOptions options;
  if (!arguments.shard.empty()) {
    const auto shard = parse_shard(arguments.shard);
    if (!shard) return refuse(Code::wrong_form, "--shard: is not K/N with 1 <= K <= N");
    options.shard = *shard;
  }
  options.threads = arguments.threads;
  options.cancelled = stop_on_interrupt();
  Progress progress;
  if (!arguments.quiet) options.progress = [&](int done, int asked) { progress(done, asked, "runs"); };
  Diagnostics out;
  SweepOutcome outcome;
  const int code = run_shard(sweep, arguments.folder, options, out, outcome);
  progress.finish();
  print(out, code != kRefused);
  if (code == kRefused || code == kFailed) return code;
  fmt::print("{}\n", words_of(outcome));
  if (outcome.interrupted) {
    fmt::print("Stopped. The finished runs are kept in {}: the same command continues.\n", arguments.folder);
    return code;
  }
  if (options.shard.count == 1) return merge(arguments.folder, arguments.quiet);
  fmt::print("  {:<12}{}\n", "written", shard_path(arguments.folder, options.shard));
  return kOk;
}

int sweep(const SweepArguments& arguments) {
  const std::string& word = arguments.words.front();
  const bool action = word == "missing" || word == "merge" || word == "submit";
  if (action != (arguments.words.size() == 2))
    return refuse(Code::usage, action ? word + " needs a folder of a sweep" : "sweep needs one study file");
  if (word == "missing") return missing(arguments.words[1]);
  if (word == "merge") return merge(arguments.words[1], arguments.quiet);
  if (word == "submit") return submit(arguments, arguments.words[1]);
  if (arguments.folder.empty()) return refuse(Code::usage, "--out names the folder for the results");
  Diagnostics out;
  const auto ready = prepare_sweep(word, out);
  print(out);
  if (!ready) return kRefused;
  if (arguments.sample) return run_sample(arguments, *ready);
  if (arguments.plan > 0) return plan(arguments, *ready);
  return run_study(arguments, *ready);
}

}  // namespace

void add_sweep(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<SweepArguments>();
  command
      .add_option("STUDY", arguments->words,
                  "study file (TOML; genu explain sweep); or missing, merge or submit, and the folder of a sweep")
      ->required()
      ->expected(1, 2);
  command.add_option("-o,--out", arguments->folder, "folder for the results; a sweep that was stopped there continues");
  command.add_option("--shard", arguments->shard, "K/N: the K-th of N parts alone, into one file; K counts from 1")
      ->check(not_empty());
  command.add_option("--threads", arguments->threads, "at most so many; 0: as many as the machine has")
      ->check(CLI::Range(0, kMostThreads))
      ->capture_default_str();
  command.add_option("--sample", arguments->sample, "one sample as a normal run, which genu judge can check");
  command.add_option("--case", arguments->in_case, "SCENE/WHAT_IF of --sample; the first one where it is not given")
      ->check(not_empty());
  command
      .add_option("--plan", arguments->plan,
                  "compute nothing: prepare the folder and scripts for so many shards; a Slurm array takes 1000 where "
                  "its MaxArraySize is not set higher")
      ->check(CLI::Range(1, kMostShards));
  command.add_flag("--slurm", arguments->slurm, "submit: give sweep.sbatch to Slurm");
  command.add_option("--time", arguments->time, "limit of one shard in the scripts, as Slurm takes it")
      ->check(not_empty())
      ->capture_default_str();
  command.add_option("--nodes", arguments->nodes, "at most so many shards at a time in the scripts; 0: no limit")
      ->check(CLI::Range(0, kMostShards))
      ->capture_default_str();
  command
      .add_option("--cores", arguments->cores,
                  "cores of one shard in the scripts; 0: a whole node, with HTCondor one core")
      ->check(CLI::Range(0, kMostThreads))
      ->capture_default_str();
  command.add_flag("--quiet", arguments->quiet, "no progress and no table");
  command.footer(
      "A sample that fails is a row with its reason and no failure of the sweep."
      "\nExit code 0: all runs done; 3: stopped, the same command continues (missing: shards are missing); 2: refused."
      "\nExample: genu sweep study.toml --out out/study");
  advice().hint("sweep",
                "the same command continues with the runs that are not done; genu sweep missing DIR lists shards");
  command.callback([arguments, &exit_code] { exit_code = sweep(*arguments); });
}

}  // namespace genu::cli
