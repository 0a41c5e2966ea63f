// The curves of a calibration of any bytes; then results to compare with, at the same times and at others.
#include "fuzz/fuzz_checks.h"
#include "genu/calibrate/calibration_target.h"
#include "support/temporary_folder.h"

namespace genu::fuzz {

ResultTable results() {
  ResultTable table;
  for (const char* name : {"time_s", "j1.angle_deg", "spring.force_N"}) table.add_column(name);
  for (int row = 0; row < 6; ++row) {
    table.add_row();
    table.set("time_s", 0.2 * row);
    table.set("j1.angle_deg", 10.0 * row * row);
    table.set("spring.force_N", 5.0);
  }
  return table;
}

void read_curves(const std::string& text) {
  static const test::TemporaryFolder folder;
  static const ResultTable found = results();
  Diagnostics out;
  const auto target = read_calibration_target(folder.write("target.csv", text), {}, found.columns(), 1.0, out);
  require_result_or_reason(target.has_value(), out);
  if (!target) return;
  require(!target->values.empty(), "a target has values");
  for (const auto& column : target->columns)
    require(std::isfinite(column.scale) && column.scale > 0, "residuals are divided by a number > 0");
  for (const auto& value : target->values)
    require(std::isfinite(value.value) && value.time >= 0 && value.time <= 1, "values are numbers within the motion");
  const auto values = values_at(*target, found);
  require(values && values->allFinite(), "results have a value at every time");
}

}  // namespace genu::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  genu::fuzz::read_curves(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
