// The same yardstick for every program's poses.
#pragma once

#include <string>
#include <vector>

#include "peers/problem.h"

namespace genu::peers {

/// Above this (N) a pose has failed.
inline constexpr double kMostUnbalanced = 0.1;

struct Judged {
  /// N: what springs and the program's own contact forces leave on the femur, moments over the knee's length; that
  /// about what flexion is held by is left out.
  double unbalanced = 0;
  double distance = 0;  ///< m, of the femur's origin from the reference
  double angle = 0;     ///< rad, of its turn from there
  bool failed = true;
};

/// Each pose of a path beside that of `reference`; poses that are missing have failed. Springs are genu's.
std::vector<Judged> judge(const Prepared& prepared, const FoundPath& found, const FoundPath& reference);

/// A row of the table: one program on one mesh.
struct Row {
  std::string software, contact;
  int triangles = 0;  ///< of a condyle; 0: a closed form
  std::vector<double> seconds;
  std::vector<Judged> poses;
};

/// Aligned lines with a heading.
std::string to_text(const std::vector<Row>& rows);

}  // namespace genu::peers
