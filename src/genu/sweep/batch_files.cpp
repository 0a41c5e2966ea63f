#include "genu/sweep/batch_files.h"

#include <fmt/format.h>

#include "genu/core/file_text.h"
#include "genu/sweep/shard_file.h"

namespace genu {
namespace {

/// "genu sweep STUDY --out DIR --shard K/N" with `shard` for K.
std::string command(const SweepRecord& record, const std::string& folder, const BatchOptions& options,
                    const std::string& shard) {
  const std::string cores = options.cores > 0 ? fmt::format(" --threads {}", options.cores) : std::string();
  return fmt::format("{} sweep {} --out {} --shard {}/{}{}", shell_word(options.program), shell_word(record.study),
                     shell_word(folder), shard, record.shards, cores);
}

std::string slurm_script(const SweepRecord& record, const std::string& folder,
                         const std::vector<std::uint64_t>& missing, const BatchOptions& options) {
  const std::string at_most = options.nodes > 0 ? fmt::format("%{}", options.nodes) : std::string();
  const std::string share = options.cores > 0 ? fmt::format("#SBATCH --cpus-per-task={}\n", options.cores)
                                              : std::string("#SBATCH --exclusive\n");
  return fmt::format(
      "#!/bin/sh\n"
      "# An array of shards; a task whose node fails is queued again and continues with its finished samples.\n"
      "#SBATCH --job-name=genu-sweep\n"
      "#SBATCH --array={}{}\n"
      "#SBATCH --ntasks=1\n{}"
      "#SBATCH --time={}\n"
      "#SBATCH --requeue\n"
      "#SBATCH --signal=B:TERM@30\n"
      "#SBATCH --output={}\n"
      "exec {}\n",
      as_array_list(missing), at_most, share, options.time, shell_word(folder + "/slurm-%A_%a.log"),
      command(record, folder, options, "\"$SLURM_ARRAY_TASK_ID\""));
}

/// A text that HTCondor replaces no macro in.
std::string condor_text(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '$' ? std::string("$(DOLLAR)") : std::string(1, c);
  return out;
}

/// A word of HTCondor's `arguments`, whose whole value is in double quotes: single quotes around it, quotes twice.
std::string condor_word(const std::string& word) {
  std::string out = "'";
  for (const char c : condor_text(word)) out += std::string(c == '\'' || c == '"' ? 2 : 1, c);
  return out + "'";
}

std::string condor_file(const SweepRecord& record, const std::string& folder, const std::vector<std::uint64_t>& missing,
                        const BatchOptions& options) {
  std::string list;
  for (const std::uint64_t k : missing) list += fmt::format("  {}\n", k);
  const int cores = options.cores > 0 ? options.cores : 1;
  return fmt::format(
      "# condor_submit sweep.condor\n"
      "executable = {}\n"
      "arguments = \"sweep {} --out {} --shard $(shard)/{} --threads {}\"\n"
      "request_cpus = {}\n"
      "log = {}/condor.log\n"
      "error = {}/condor-$(shard).log\n"
      "max_retries = 3\n"
      "queue shard from (\n{})\n",
      condor_text(options.program), condor_word(record.study), condor_word(folder), record.shards, cores, cores,
      condor_text(folder), condor_text(folder), list);
}

std::string parallel_script(const SweepRecord& record, const std::string& folder,
                            const std::vector<std::uint64_t>& missing, const BatchOptions& options) {
  std::string list;
  for (const std::uint64_t k : missing) list += fmt::format(" {}", k);
  return fmt::format(
      "#!/bin/sh\n"
      "# GNU parallel: one shard at a time on each machine of --sshlogin, or here.\n"
      "exec parallel -q --jobs {} --retries 3 \"$@\" {} :::{}\n",
      options.nodes > 0 ? options.nodes : 1, command(record, folder, options, "{}"), list);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> batch_files(const SweepRecord& record, const std::string& folder,
                                                             const std::vector<std::uint64_t>& missing,
                                                             const BatchOptions& options) {
  return {{"sweep.sbatch", slurm_script(record, folder, missing, options)},
          {"sweep.condor", condor_file(record, folder, missing, options)},
          {"sweep.parallel", parallel_script(record, folder, missing, options)}};
}

}  // namespace genu
