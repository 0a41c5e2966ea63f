// genu compare out/rigid out/cartilage --out compared.html
//   1. read the report.html of each result, or the shards of each study; refuse all that are none at once
//   2. write one page: curves over each other, the bones of the others as ghosts, the largest differences; of studies
//      their bands, events and statistics
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include "commands.h"
#include "genu/store/compare.h"
#include "genu/sweep/compare_sweeps.h"

namespace genu::cli {
namespace {

struct CompareArguments {
  std::vector<std::string> results;
  std::string file;
};

int compare(const CompareArguments& arguments) {
  Diagnostics diagnostics;
  const int code = has_sweep(arguments.results) ? compare_sweeps(arguments.results, arguments.file, diagnostics)
                                                : compare_results(arguments.results, arguments.file, diagnostics);
  print(diagnostics, code == kFailed);
  if (code == kOk) fmt::print("{}: {} results compared\n", arguments.file, arguments.results.size());
  return code;
}

}  // namespace

void add_compare(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<CompareArguments>();
  constexpr int kMostResults = 8;
  command
      .add_option("RESULTS", arguments->results,
                  "folders written by genu run, or by genu sweep; the first is the reference")
      ->required()
      ->expected(2, kMostResults);
  command.add_option("-o,--out", arguments->file, "the page (HTML) to be written")->required();
  command.footer("Example: genu compare out/a out/b --out compared.html");
  command.callback([arguments, &exit_code] { exit_code = compare(*arguments); });
}

}  // namespace genu::cli
