// The texts of options: --columns in the first line, --units in the second, a region in the third; what is left is a
// pattern and the words it is held against.
#include <sstream>

#include "fuzz/table_scene.h"
#include "genu/assemble/pose_columns.h"
#include "genu/scene/region_text.h"
#include "genu/scene/words.h"

namespace genu::fuzz {

const PoseFile& table() {
  static const PoseFile file = [] {
    Diagnostics out;
    auto read = parse_pose_file(
        "time,knee_flexion_r,adduction,/joint/knee/rotation_deg/value,knee_tx_r,ty[mm],knee.tz,hinge_angle,a b\n"
        "0,0,0,0,0,0,0,0,0\n",
        "poses.csv", out);
    require(read.has_value(), "the table is a good one");
    return *read;
  }();
  return file;
}

void read_options(const std::string& text) {
  std::istringstream lines(text);
  PoseColumnOptions options;
  std::string region, pattern;
  std::getline(lines, options.columns);
  std::getline(lines, options.units);
  std::getline(lines, region);
  std::getline(lines, pattern);
  Diagnostics out;
  const auto columns = match_columns(table_scene(), table(), options, out);
  require_result_or_reason(columns.has_value(), out);
  if (const auto conditions = parse_region(region, 1e-3))
    for (const auto& c : *conditions) require(std::isfinite(c.value), "a region ends at a number");
  std::vector<std::string> words;
  for (std::string word; std::getline(lines, word);) words.push_back(word);
  for (const std::string& word : words) require(!matches("", word) || word.empty(), "nothing matches nothing alone");
  require(matches("*", pattern), "a star stands for all");
  for (const std::string& word : words) matches(pattern, word);
  did_you_mean(pattern, words);
}

}  // namespace genu::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  genu::fuzz::read_options(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
