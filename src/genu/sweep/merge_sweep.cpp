#include "genu/sweep/merge_sweep.h"

#include <filesystem>
#include <vector>

#include "genu/assemble/solution.h"
#include "genu/core/atomic_output.h"
#include "genu/sweep/summary_tables.h"
#include "genu/sweep/sweep_page.h"
#include "genu/sweep/sweep_table.h"

namespace genu {

int merge_sweep(const std::string& folder, Diagnostics& out, std::string& text) {
  const std::filesystem::path in = folder;
  StagedFile samples(in / "samples.csv", Durable::yes);  // row by row: all of them may be larger than the memory
  const auto add = [&](std::string_view row) {
    samples.write(row);
    samples.write("\n");
  };
  const auto sweep = read_sweep_table(folder, add, out);
  if (!sweep) return kExitRefused;
  std::vector<std::pair<std::string, std::string>> files = {{"statistics.csv", statistics_table(*sweep).to_csv()},
                                                            {"events.csv", event_probabilities(*sweep).to_csv()},
                                                            {"ranks.csv", rank_table(*sweep).to_csv()},
                                                            {"convergence.csv", convergence_table(*sweep).to_csv()},
                                                            {"summary.json", summary_json(*sweep)},
                                                            {"report.html", sweep_page(*sweep)}};
  if (sweep->record.block > 1) files.emplace_back("indices.csv", index_table(*sweep).to_csv());
  std::string error = samples.commit();
  for (const auto& [name, content] : files)
    if (error.empty()) error = write_file_atomically(in / name, content, Durable::yes);
  if (!error.empty()) {
    out.error(Code::cannot_write, {}, error);
    return kExitFailed;
  }
  text = summary_text(*sweep);
  return kExitOk;
}

}  // namespace genu
