// genu reproduce failure.json
//   1. unpack the scene and what of its meshes was kept
//   2. run it, from where the path rested last before it failed
//   3. say whether it fails in the same way
#include <sys/resource.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "advice.h"
#include "commands.h"
#include "genu/core/file_text.h"
#include "genu/core/program_hash.h"
#include "genu/core/scratch_folder.h"
#include "genu/path/path.h"
#include "genu/study/failure.h"
#include "print_error.h"

namespace genu::cli {
namespace {

namespace fs = std::filesystem;

/// As little memory as the run that failed had.
void limit_memory(std::uint64_t bytes) {
  rlimit limit{};
  if (bytes == 0 || getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur <= bytes) return;
  limit.rlim_cur = bytes;
  setrlimit(RLIMIT_AS, &limit);
}

/// A new folder, or an empty one; false with the reason in `out`.
bool make_empty(const std::string& folder, Diagnostics& out) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (!code && fs::is_empty(folder, code) && !code) return true;
  out.error(Code::no_output_folder, folder, "is no new or empty folder");
  return false;
}

int reproduce_file(const std::string& file, const std::string& asked) {
  Diagnostics out;
  const auto text = text_of_file(file, out);
  const auto failure = text ? read_failure(*text, file, out) : std::nullopt;
  std::optional<ScratchFolder> scratch;
  if (failure && asked.empty()) scratch.emplace("genu-reproduce");
  if (scratch && !scratch->problem().empty()) out.error(Code::cannot_write, "", scratch->problem());
  const bool ready = failure && !out.has_errors() && (scratch || make_empty(asked, out));
  print(out);
  if (!ready) return kRefused;
  const std::string folder = scratch ? scratch->path().string() : asked;
  if (failure->program != program_hash())
    print_error("saved by another build of genu ({}), or on another machine: it may do otherwise\n",
                printable(failure->version));
  std::error_code ignored;
  if (const std::string error = unpack(*failure, folder); !error.empty()) {
    for (const auto& entry : fs::directory_iterator(folder, ignored)) fs::remove(entry.path(), ignored);
    print_error("genu: {}\n", printable(error));
    return kFailed;
  }
  limit_memory(failure->memory_limit);
  RunOptions options;
  options.cancelled = stop_on_interrupt();
  std::vector<std::string> found;
  try {
    found = reproduce(*failure, folder, options);
  } catch (const SavedElsewhere&) {
    out.error(Code::broken_file, file, "holds a state that its scene cannot be in");
    print(out);
    return kRefused;
  }
  fmt::print("meshes: {}\nfailed then:\n", printable(failure->meshes_are));
  for (const std::string& line : failure->verdict) fmt::print("  {}\n", printable(line));
  const bool same = alike(failure->verdict, found);
  fmt::print("{}\n", same ? "fails in the same way" : "fails otherwise:");
  for (const std::string& line : found)
    if (!same) fmt::print("  {}\n", printable(line));
  return same ? kOk : kNotAllOk;
}

}  // namespace

void add_reproduce(CLI::App& command, int& exit_code) {
  auto file = std::make_shared<std::string>(), folder = std::make_shared<std::string>();
  command.add_option("FILE", *file, "what --save-failure has written")->required();
  command.add_option("-o,--out", *folder, "new folder to unpack the scene into, and leave it there");
  command.footer("Examples: genu run SCENE --out DIR --save-failure FILE\n          genu reproduce FILE");
  advice().hint("reproduce", "compare the two verdicts above: another build, machine or mesh may be why");
  command.callback([file, folder, &exit_code] { exit_code = reproduce_file(*file, *folder); });
}

}  // namespace genu::cli
