#include "genu/store/report_rows.h"

#include <algorithm>
#include <utility>

namespace genu {
namespace {

template <typename T>
void keep(std::vector<T>& values, const std::vector<std::size_t>& rows) {
  if (values.empty()) return;
  std::vector<T> kept;
  kept.reserve(rows.size());
  for (const std::size_t row : rows) kept.push_back(std::move(values[row]));
  values = std::move(kept);
}

std::shared_ptr<const ResultTable> keep(const ResultTable& table, const std::vector<std::size_t>& rows) {
  auto kept = std::make_shared<ResultTable>();
  for (const std::string& column : table.columns()) kept->add_column(column);
  for (const std::size_t row : rows) {
    kept->add_row();
    for (std::size_t c = 0; c < table.columns().size(); ++c) kept->set(c, table.at(row, c));
  }
  return kept;
}

/// The first row that is kept of each branch.
std::vector<std::size_t> breaks_among(const std::vector<std::size_t>& breaks, const std::vector<std::size_t>& rows) {
  std::vector<std::size_t> out;
  for (const std::size_t row : breaks) {
    const auto at = static_cast<std::size_t>(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin());
    if (at < rows.size() && (out.empty() || out.back() != at)) out.push_back(at);
  }
  return out;
}

/// Of all rows together.
std::size_t numbers_of(const ReportRun& run) {
  constexpr std::size_t kPose = 7, kContact = 6, kPoint = 12;  // a point of a course is text, as long as twelve numbers
  std::size_t each =
      run.poses->columns().size() + kPose * run.model->bodies.size() + 1 + kContact * run.contacts.size();
  for (const ChartPanel& panel : run.chart.panels)
    for (const ChartSeries& series : panel.series) each += series.bar.empty() ? 1 : 2;
  std::size_t points = 0;
  for (const ReportPath& path : run.wrapped)
    for (const auto& row : path.rows) points += row.size();
  return each * run.poses->rows() + kPoint * points;
}

}  // namespace

std::vector<std::size_t> thin_rows(ReportRun& run, std::size_t most) {
  const std::size_t count = run.poses->rows(), numbers = numbers_of(run);
  if (numbers <= most || count < 3) return {};
  run.rows_in_full = count;
  run.every = std::min(count - 1, (numbers + most - 1) / most);
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row + 1 < count; row += run.every) rows.push_back(row);
  rows.push_back(count - 1);
  run.thinned = keep(*run.poses, rows);
  run.poses = run.thinned.get();
  run.chart.breaks = breaks_among(run.chart.breaks, rows);
  keep(run.chart.x, rows);
  for (ChartPanel& panel : run.chart.panels)
    for (ChartSeries& series : panel.series) {
      keep(series.y, rows);
      keep(series.bar, rows);
    }
  keep(run.body_poses, rows);
  for (ReportContact& contact : run.contacts) {
    keep(contact.point, rows);
    keep(contact.force, rows);
  }
  for (ReportPath& path : run.wrapped) keep(path.rows, rows);
  return rows;
}

}  // namespace genu
