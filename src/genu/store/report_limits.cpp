#include "genu/store/report_limits.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "genu/mesh/display_mesh.h"

namespace genu {
namespace {

/// "4,995,224"
std::string grouped(std::size_t number) {
  std::string text = std::to_string(number);
  constexpr std::size_t kGroup = 3;
  for (std::size_t at = text.size(); at > kGroup;) text.insert(at -= kGroup, ",");
  return text;
}

/// "every 3rd"
std::string every(std::size_t n) {
  constexpr std::size_t kTen = 10, kHundred = 100;
  const std::size_t ones = n % kTen;
  const bool teen = n % kHundred / kTen == 1;
  const char* end = teen || ones == 0 || ones > 3 ? "th" : ones == 1 ? "st" : ones == 2 ? "nd" : "rd";
  return fmt::format("every {}{}", grouped(n), end);
}

/// How many triangles a mesh may have so that none with more stays and all have `most` together.
std::size_t level_of(const std::vector<ReportMesh>& meshes, std::size_t most) {
  std::vector<std::size_t> counts;
  for (const ReportMesh& mesh : meshes) counts.push_back(mesh.triangles.size());
  std::sort(counts.begin(), counts.end());
  std::size_t room = most;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const std::size_t share = room / (counts.size() - k);
    if (counts[k] > share) return share;
    room -= counts[k];
  }
  return most;
}

void thin(ReportBeside& table, std::size_t most) {
  const std::size_t rows = table.columns.empty() ? 0 : table.columns.front().numbers.size();
  const std::size_t numbers = rows * table.columns.size();
  if (numbers <= most) return;
  table.every = (numbers + most - 1) / most;
  for (ReportBeside::Column& column : table.columns) {
    std::vector<double> kept;
    for (std::size_t row = 0; row < rows; row += table.every) kept.push_back(column.numbers[row]);
    column.numbers = std::move(kept);
  }
}

/// "1,000 of 5,000 triangles of ball"; several meshes are counted together.
std::string shown_triangles(const std::vector<ReportMesh>& meshes) {
  std::size_t few = 0, shown = 0, all = 0;
  std::string name;
  for (const ReportMesh& mesh : meshes) {
    if (mesh.triangles.size() >= mesh.triangles_in_full) continue;
    ++few;
    shown += mesh.triangles.size();
    all += mesh.triangles_in_full;
    name = mesh.name;
  }
  if (few == 0) return {};
  return fmt::format("{} of {} triangles of {}", grouped(shown), grouped(all),
                     few == 1 ? name : fmt::format("{} meshes", few));
}

}  // namespace

void thin_meshes(std::vector<ReportMesh>& meshes, std::size_t most) {
  const std::size_t level = level_of(meshes, most);
  for (ReportMesh& shown : meshes) {
    if (shown.triangles.size() <= level) continue;
    Mesh mesh;
    mesh.vertices = std::move(shown.vertices);
    mesh.triangles = std::move(shown.triangles);
    Mesh few = display_mesh(std::move(mesh), level);
    shown.vertices = std::move(few.vertices);
    shown.triangles = std::move(few.triangles);
  }
}

void cut_lists(ReportRun& run, const ReportLimits& limits) {
  run.events_in_full = run.chart.events.size();
  if (run.events_in_full > limits.events) run.chart.events.resize(limits.events);
  for (ReportBeside& table : run.beside) thin(table, limits.measured);
  run.text_in_full = run.scene_text.size();
  if (run.text_in_full > limits.scene_text)
    run.scene_text.resize(std::min(run.scene_text.rfind('\n', limits.scene_text), limits.scene_text));
}

std::vector<std::string> left_out(const ReportRun& run) {
  std::vector<std::string> words;
  if (run.every > 1)
    words.push_back(fmt::format("{} of {} rows (results.csv has all)", every(run.every), grouped(run.rows_in_full)));
  if (std::string triangles = shown_triangles(run.meshes); !triangles.empty()) words.push_back(std::move(triangles));
  const auto thinned = [](const ReportPressure& map) { return map.every > 1; };
  if (const auto map = std::find_if(run.pressures.begin(), run.pressures.end(), thinned); map != run.pressures.end())
    words.push_back(fmt::format("pressures of {} of its rows", every(map->every)));
  if (run.events_in_full > run.chart.events.size())
    words.push_back(fmt::format("{} of {} events (events.csv has all)", grouped(run.chart.events.size()),
                                grouped(run.events_in_full)));
  for (const ReportBeside& table : run.beside)
    if (table.every > 1) words.push_back(fmt::format("{} row of {}", every(table.every), table.name));
  if (run.text_in_full > run.scene_text.size())
    words.push_back(
        fmt::format("{} of {} bytes of the scene", grouped(run.scene_text.size()), grouped(run.text_in_full)));
  return words;
}

}  // namespace genu
