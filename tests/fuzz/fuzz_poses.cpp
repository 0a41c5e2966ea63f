// A table of poses of any bytes, as CSV and as OpenSim's storage: read, its columns matched, its numbers taken.
#include "fuzz/table_scene.h"
#include "genu/assemble/given_poses.h"

namespace genu::fuzz {

void read_as(const std::string& text, const std::string& path) {
  Diagnostics out;
  const auto file = parse_pose_file(text, path, out);
  require_result_or_reason(file.has_value(), out);
  if (!file) return;
  for (const PoseFile::Row& row : file->rows)
    require(row.cells.size() == file->names.cells.size(), "rows are as long as the names");
  const auto columns = match_columns(table_scene(), *file, {}, out);
  require_result_or_reason(columns.has_value(), out);
  if (!columns) return;
  const auto given = read_given_poses(table_scene(), *file, *columns, out);
  require_result_or_reason(given.has_value(), out);
  if (!given) return;
  for (const GivenPose& pose : given->poses)
    for (const JointValues& joint : pose.coordinates)
      for (const double value : joint) require(std::isfinite(value), "a pose is made of numbers");
}

}  // namespace genu::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  genu::fuzz::read_as(text, "poses.csv");
  genu::fuzz::read_as(text, "poses.mot");
  return 0;
}
