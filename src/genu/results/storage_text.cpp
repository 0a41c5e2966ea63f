#include "genu/results/storage_text.h"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace genu {

std::string storage_text(const ResultTable& table, const std::string& title, bool rotations) {
  std::string out = fmt::format(
      "{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees={}\n\n{}\n"
      "Units are S.I. units (second, meters, Newtons, ...)\n"
      "If the header above contains a line with 'inDegrees', this indicates whether rotational values are in degrees "
      "(yes) or radians (no).\n\nendheader\n",
      title, table.rows(), table.columns().size(), rotations ? "yes" : "no", kStorageMark);
  for (std::size_t c = 0; c < table.columns().size(); ++c) out += (c > 0 ? "\t" : "") + table.columns()[c];
  out += '\n';
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t c = 0; c < table.columns().size(); ++c) {
      const double value = table.number(row, table.columns()[c]);
      if (c > 0) out += '\t';
      // The fewest digits that read back as the same number.
      if (std::isfinite(value))
        fmt::format_to(std::back_inserter(out), "{}", value);
      else
        out += "nan";
    }
    out += '\n';
  }
  return out;
}

}  // namespace genu
