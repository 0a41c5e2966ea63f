#include "genu/sweep/merge_sweep.h"

#include <filesystem>
#include <vector>

#include "genu/assemble/solution.h"
#include "genu/sweep/summary_tables.h"
#include "genu/sweep/sweep_page.h"
#include "genu/sweep/sweep_table.h"

namespace genu {

int merge_sweep(const std::string& folder, Diagnostics& out, std::string& text) {
  std::string samples;
  const auto sweep = read_sweep_table(
      folder, [&](std::string_view row) { samples.append(row).append("\n"); }, out);
  if (!sweep) return kExitRefused;
  std::vector<std::pair<std::string, std::string>> files = {{"samples.csv", std::move(samples)},
                                                            {"statistics.csv", statistics_table(*sweep).to_csv()},
                                                            {"events.csv", event_probabilities(*sweep).to_csv()},
                                                            {"ranks.csv", rank_table(*sweep).to_csv()},
                                                            {"convergence.csv", convergence_table(*sweep).to_csv()},
                                                            {"summary.json", summary_json(*sweep)},
                                                            {"report.html", sweep_page(*sweep)}};
  if (sweep->record.block > 1) files.emplace_back("indices.csv", index_table(*sweep).to_csv());
  for (const auto& [name, content] : files) {
    const std::string error = write_durably((std::filesystem::path(folder) / name).string(), content);
    if (error.empty()) continue;
    out.error(Code::cannot_write, {}, error);
    return kExitFailed;
  }
  text = summary_text(*sweep);
  return kExitOk;
}

}  // namespace genu
