#include "genu/store/convert.h"

#include <cmath>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "genu/assemble/refuse_option.h"
#include "genu/core/atomic_output.h"
#include "genu/results/storage_text.h"
#include "genu/results/vtk_series.h"
#include "genu/store/report.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

struct ChosenRows {
  std::vector<std::size_t> rows;  ///< of the table that was read
  std::vector<double> times;
};

bool grows(const std::vector<double>& times) {
  for (std::size_t k = 0; k < times.size(); ++k)
    if (!std::isfinite(times[k]) || (k > 0 && times[k] <= times[k - 1])) return false;
  return true;
}

std::vector<double> column_of(const ResultTable& table, const std::string& column,
                              const std::vector<std::size_t>& rows) {
  std::vector<double> values;
  for (const std::size_t row : rows) values.push_back(table.number(row, column));
  return values;
}

/// The rows, and for each the time at which it is shown, which has to grow; empty where the user's column does not.
std::optional<ChosenRows> choose_rows(const ResultsRead& read, const ConvertOptions& options, Diagnostics& out,
                                      ConvertFound& found) {
  const ResultTable& table = read.solution.poses;
  ChosenRows chosen;
  for (std::size_t row = 0; row < table.rows(); row += static_cast<std::size_t>(options.every))
    chosen.rows.push_back(row);
  if (!options.time.empty() && options.time != "row") {
    if (!table.has_column(options.time)) {
      refuse_option(out, Code::unknown_column, "--time", options.time,
                    "is no column of the results" + did_you_mean(options.time, table.columns()));
      return std::nullopt;
    }
    chosen.times = column_of(table, options.time, chosen.rows);
    found.time = options.time;
    if (grows(chosen.times)) return chosen;
    refuse_option(out, Code::out_of_range, "--time", options.time, "must grow from row to row");
    return std::nullopt;
  }
  found.time = "time_s";
  if (options.time.empty() && table.has_column("time_s")) chosen.times = column_of(table, "time_s", chosen.rows);
  if (!chosen.times.empty() && grows(chosen.times)) return chosen;
  found.time = "row";
  chosen.times.clear();
  for (const std::size_t row : chosen.rows) chosen.times.push_back(static_cast<double>(read.numbers[row]));
  return chosen;
}

/// The mark that lets genu replace the folder, with its contents.
std::string mark_text(const ResultsRead& read, const ConvertFound& found, const char* format) {
  const nlohmann::ordered_json j = {{"genu", "convert"},  {"format", format},   {"scene", read.prepared.scene.file},
                                    {"time", found.time}, {"rows", found.rows}, {"rows_left_out", found.left_out}};
  return j.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// Files of a folder under construction, counted.
class FolderWriter {
 public:
  FolderWriter(StagedFolder& folder, ConvertFound& found) : folder_(folder), found_(found) {}

  std::string operator()(const std::string& name, const std::string& content) {
    const fs::path path = folder_.path() / name;
    std::error_code code;
    fs::create_directories(path.parent_path(), code);
    if (code) return path.parent_path().string() + ": cannot be made: " + code.message();
    ++found_.files;
    found_.bytes += content.size();
    return write_file_atomically(path, content);
  }

 private:
  StagedFolder& folder_;
  ConvertFound& found_;
};

std::string write_vtk(const ResultsRead& read, const ReportRun& run, const ChosenRows& chosen, FolderWriter write) {
  const int digits = static_cast<int>(fmt::format("{}", read.numbers.empty() ? 0 : read.numbers.back()).size());
  VtkSeries series(run, digits, write);
  PressureFinder pressures(read.prepared.scene, read.prepared.model);
  std::string error;
  for (std::size_t k = 0; k < chosen.rows.size() && error.empty(); ++k) {
    const std::size_t row = chosen.rows[k];
    const PosePoint& point = read.solution.records[row].point;
    error = series.add({row, read.numbers[row], chosen.times[k], pressures.at(point.pose.state, point.target)});
  }
  return error.empty() ? series.finish() : error;
}

std::string motion_text(const ReportRun& run, const OpenSimNames& names, const ChosenRows& chosen) {
  return storage_text(opensim_motion(run, names, chosen.rows, chosen.times), "Coordinates", true);
}

std::string forces_text(const ReportRun& run, const OpenSimNames& names, const ChosenRows& chosen) {
  return storage_text(opensim_forces(run, names, chosen.rows, chosen.times), "genu_forces", false);
}

std::string write_converted_folder(const ResultsRead& read, const ReportRun& run, const ChosenRows& chosen,
                                   const OpenSimNames& names, const ConvertOptions& options, ConvertFound& found) {
  StagedFolder folder("converted results");
  std::string error = text_of(folder.open(options.out));
  FolderWriter write(folder, found);
  const bool vtk = options.to == ConvertTo::vtk;
  if (error.empty() && vtk) error = write_vtk(read, run, chosen, write);
  if (error.empty() && !vtk) error = write("motion.mot", motion_text(run, names, chosen));
  if (error.empty() && !vtk) error = write("forces.sto", forces_text(run, names, chosen));
  if (error.empty()) error = write("summary.json", mark_text(read, found, vtk ? "vtk" : "opensim"));
  return error.empty() ? folder.commit() : error;
}

}  // namespace

int convert_results(const ResultsRead& read, const ConvertOptions& options, Diagnostics& out, ConvertFound& found) {
  const auto chosen = choose_rows(read, options, out, found);
  const auto names = opensim_column_names(read.prepared.scene, options.names, out);
  if (!chosen || !names) return kExitRefused;
  found.rows = chosen->rows.size();
  found.left_out = read.left_out;
  ReportLimits limits = ReportLimits::none();              // of a page, and here nothing has to fit into a browser
  if (options.to != ConvertTo::vtk) limits.triangles = 0;  // nobody looks at them
  const ReportRun run = report_run(read.prepared, read.solution, {}, limits);
  std::string error;
  if (options.to == ConvertTo::vtk || options.to == ConvertTo::opensim) {
    error = write_converted_folder(read, run, *chosen, *names, options, found);
  } else {
    const std::string text =
        options.to == ConvertTo::motion ? motion_text(run, *names, *chosen) : forces_text(run, *names, *chosen);
    found.files = 1;
    found.bytes = text.size();
    error = write_file_atomically(options.out, text);
  }
  if (error.empty()) return kExitOk;
  out.error(Code::cannot_write, {}, error);
  return kExitFailed;
}

}  // namespace genu
