#include "genu/landmarks/landmark_frame.h"

#include <string_view>

namespace genu {

Mat3 turn_between(const std::string& from, const std::string& to) {
  Mat3 out = Mat3::Zero();
  for (int row = 0; row < 3; ++row)
    for (const std::string_view pair : {"RL", "AP", "SI"})
      for (int column = 0; column < 3; ++column)
        if (pair.find(to[at(row)]) != pair.npos && pair.find(from[at(column)]) != pair.npos)
          out(row, column) = to[at(row)] == from[at(column)] ? 1 : -1;
  return out;
}

}  // namespace genu
