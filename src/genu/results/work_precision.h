// What accuracy costs in time, as a self-contained SVG: error over time, both logarithmic, a panel for each group of
// outputs, the settings that no other beats in both joined by a line, the one that was chosen in
// a ring. Knows nothing of joints.
#pragma once

#include <string>
#include <vector>

namespace genu {

struct WorkPoint {
  std::string name;    ///< of the setting
  std::string series;  ///< settings of one kind share a colour
  double seconds = 0;  ///< a pose
  double error = 0;
  bool chosen = false;  ///< gets a ring
};

struct WorkPanel {
  std::string title;  ///< with the unit in brackets
  std::vector<WorkPoint> points;
  double target = 0;  ///< drawn across; 0: none
};

/// Which points no other beats: none is as fast and as exact, and better in one. Points that are not finite or not
/// positive never are.
std::vector<bool> pareto_front(const std::vector<WorkPoint>& points);

struct WorkPicture {
  std::string title;
  std::vector<WorkPanel> panels;
  std::vector<std::string> words;   ///< lines below it
  std::vector<std::string> series;  ///< for which the first colours are kept, drawn or not
};

/// The same picture gives the same bytes.
std::string to_svg(const WorkPicture& picture);

}  // namespace genu
