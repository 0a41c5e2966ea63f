// Units in the names of columns: knee_flex_r_deg, "knee_flex_r (deg)", "knee_tx_r [mm]".
#pragma once

#include <string>

namespace genu {

struct ColumnUnit {
  const char* name;  ///< in messages and results
  double si;         ///< SI per unit
  bool angle;
};

/// deg, rad, m, mm, cm, or one of their longer names in any case; null for another word.
const ColumnUnit* column_unit(const std::string& word);

/// "deg" of " [deg] ", "(deg)" or "deg".
std::string bare_unit(const std::string& text);

/// The name of a column in parts.
struct ColumnLabel {
  std::string path;                  ///< without the unit
  std::string word;                  ///< the last part of the path; empty for the path of a speed
  const ColumnUnit* unit = nullptr;  ///< null: the name says none
  std::string unknown;               ///< in brackets at the end of `path`, and no unit known
};

/// `angle`: whether the column is to hold an angle or a length. A unit of the other kind counts only in brackets.
ColumnLabel column_label(const std::string& name, bool angle);

}  // namespace genu
