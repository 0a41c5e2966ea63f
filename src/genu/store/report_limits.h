// How much of a result report.html shows: it stays below 20 MB, opens on a phone, and says what it leaves out.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "genu/results/report_run.h"

namespace genu {

/// The most that a page holds of each.
struct ReportLimits {
  std::size_t numbers = 2'000'000;         ///< of rows (table, curves, poses, contacts, courses): 5.3 bytes each
  std::size_t triangles = 100'000;         ///< of a mesh: 10 to 21 bytes each
  std::size_t triangles_in_all = 300'000;  ///< of all meshes
  std::size_t events = 2'000;              ///< some 150 bytes each
  std::size_t measured = 200'000;          ///< numbers of each measured table: 5.3 bytes each
  std::size_t scene_text = 1'000'000;      ///< bytes

  static ReportLimits none() {
    constexpr std::size_t kAll = std::numeric_limits<int>::max();
    return {kAll, kAll, kAll, kAll, kAll, kAll};
  }
};

/// Thins out the meshes with most triangles until all have at most `most` together (1000 are left of each).
void thin_meshes(std::vector<ReportMesh>& meshes, std::size_t most);

/// The first events, every n-th row of measured tables, the beginning of the scene's text.
void cut_lists(ReportRun& run, const ReportLimits& limits);

/// What the page shows less of, in words that follow "shows": "every 3rd of 30,000 rows (results.csv has all)",
/// "100,000 of 4,995,224 triangles of ball". Empty where it shows all.
std::vector<std::string> left_out(const ReportRun& run);

}  // namespace genu
