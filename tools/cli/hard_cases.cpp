// genu hard-cases
//   1. find the cases, their meshes' shapes and what is expected of each
//   2. run them side by side
//   3. print case, verdict, iterations, worst residual, time, and what was missed
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "advice.h"
#include "commands.h"
#include "genu/core/atomic_output.h"
#include "genu/study/run_scene.h"
#include "hard_cases/hard_cases.h"
#include "print_error.h"
#include "progress.h"

namespace genu::cli {
namespace {

struct HardCaseArguments {
  std::string cases, family, name, safeguard, folder, table;
  bool takes_long = false, quiet = false;
};

/// Where the cases are: in the sources that this program was built from, or where it was installed with them.
std::string cases_folder(const HardCaseArguments& arguments) {
  if (!arguments.cases.empty()) return arguments.cases;
  std::error_code failed;
  const std::string built = GENU_HARD_CASES;
  if (std::filesystem::is_directory(built, failed)) return built;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
  return (program.parent_path().parent_path() / "share" / "genu" / "hard_cases").string();
}

bool chosen(const HardCase& c, const HardCaseArguments& arguments) {
  if (!arguments.family.empty() && c.family != arguments.family) return false;
  if (!arguments.safeguard.empty() && c.expected.safeguard != arguments.safeguard) return false;
  if (!arguments.name.empty()) return c.name == arguments.name || c.family + "/" + c.name == arguments.name;
  return arguments.takes_long || !c.expected.takes_long;
}

int write_table(const std::string& path, const std::vector<HardCase>& cases) {
  const std::string head = fmt::format(
      "# Hard cases\n\nMade by `genu hard-cases --table docs/hard-cases.md`. Each case is a scene and, beside it, what "
      "must "
      "come out of it and\nwhere that is known from; `genu hard-cases` runs them all. {} cases.\n",
      cases.size());
  const std::string error = write_file_atomically(path, head + to_markdown(cases));
  if (!error.empty()) print_error("{}\n", error);
  return error.empty() ? kOk : kFailed;
}

int run_catalogue(const HardCaseArguments& arguments) {
  const std::string folder = cases_folder(arguments);
  Diagnostics problems;
  std::vector<HardCase> cases = find_hard_cases(folder, problems);
  HardCaseOptions options;
  if (!arguments.folder.empty()) options.folder = arguments.folder;
  if (problems.has_errors()) return refuse(problems);
  if (!arguments.table.empty()) return write_table(arguments.table, cases);
  std::erase_if(cases, [&](const HardCase& c) { return !chosen(c, arguments); });
  if (cases.empty())
    problems.error(Code::unknown_name, folder, "has no such case; --table lists all, --cases names another folder");
  if (problems.has_errors()) return refuse(problems);
  auto progress = std::make_shared<Progress>();
  if (!arguments.quiet) options.progress = [progress](int done, int all) { (*progress)(done, all, "cases"); };
  const std::vector<HardCaseOutcome> outcomes = run_hard_cases(cases, folder, options);
  progress->finish();
  fmt::print("{}", to_text(outcomes));
  const bool good = std::all_of(outcomes.begin(), outcomes.end(), [](const HardCaseOutcome& o) { return o.met(); });
  return good ? kOk : kExitIncomplete;
}

}  // namespace

void add_hard_cases(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<HardCaseArguments>();
  command
      .add_option("--cases", arguments->cases,
                  "folder of the catalogue; else tests/hard_cases of the sources this program was built from, or "
                  "share/genu/hard_cases where it was installed")
      ->check(not_empty());
  command.add_option("--family", arguments->family, "only this family")->check(not_empty());
  command.add_option("--case", arguments->name, "only this case: NAME or FAMILY/NAME")->check(not_empty());
  command.add_flag("--long", arguments->takes_long, "those too that take long");
  command.add_option("-o,--out", arguments->folder, "keep scene, meshes and results of each in DIR/FAMILY/NAME")
      ->check(not_empty());
  command.add_option("--safeguard", arguments->safeguard, "only the cases that fail without this safeguard")
      ->check(not_empty());
  command.add_option("--table", arguments->table, "write what cases there are as Markdown, and run none")
      ->check(not_empty());
  command.add_flag("--quiet", arguments->quiet, "no progress");
  command.footer("Exit code 0: all as expected, 3: some are missed, 2: the catalogue is wrong.");
  advice().hint("hard-cases",
                "run one that was missed alone, `genu hard-cases --case NAME --out DIR`, and look at its results");
  command.callback([arguments, &exit_code] { exit_code = run_catalogue(*arguments); });
}

}  // namespace genu::cli
