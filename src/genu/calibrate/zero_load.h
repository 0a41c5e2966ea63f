// Zero-load lengths from poses alone, nothing solved: the longest length of a fibre over the poses that the joint
// reaches passively, times a correction factor (Bloemker et al. 2012).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/calibrate/calibration_unknowns.h"
#include "genu/results/result_table.h"

namespace genu {

struct ZeroLoadChoice {
  std::vector<std::string> poses;       ///< tables of poses, as of `genu evaluate`
  std::vector<std::string> correction;  ///< "0.95", or "ACL*=0.95" for some ligaments; a later one holds; none: 1
};

/// Gives slack lengths and reference strains among the members of `unknowns` other starts: those by the rule. The table
/// has one row for each such fibre: ligament, longest_mm, correction, zero_load_mm, before_mm. Empty, with the reasons
/// in `out`, where poses or corrections are refused, or no member is a slack length.
std::optional<ResultTable> start_at_zero_load(const Prepared& prepared, const ZeroLoadChoice& choice,
                                              std::vector<CalibrationUnknown>& unknowns, Diagnostics& out);

}  // namespace genu
