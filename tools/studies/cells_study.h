// Cartilage as discrete cells (Guess et al. 2013): what forces and areas owe to the cells' size, on
// meshes/lenhart_polynomial.
#pragma once

#include <string>
#include <vector>

#include "studies/solved_scene.h"

namespace genu::studies {

/// The plateaus cut into cells of about one size.
struct CellSize {
  double edge = 0;    ///< mm, of the triangles asked for
  int cells = 0;      ///< triangles of both plateaus
  double area = 0;    ///< mm^2, the mean of a cell
  double spring = 0;  ///< N/mm, of that cell
  bool all_stable = false;
  std::vector<double> flexion, medial, lateral;             ///< deg; N
  std::vector<double> medial_area, lateral_area, pressure;  ///< mm^2; MPa, the larger maximum
};

/// From scene-cells.toml in `folder`, with the plateaus of scene.toml cut anew. The finest first.
std::vector<CellSize> solve_cells(const std::string& folder, Diagnostics& out);

/// CELLS.md.
Files cells_files(const std::vector<CellSize>& sizes);

}  // namespace genu::studies
