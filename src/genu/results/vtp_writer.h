// VTK's XML PolyData (.vtp) as text: what ParaView reads. Written here and not by VTK, which is 200 MB of packages to
// build and run with for one format of some dozen lines; a test reads the files back with VTK's own reader.
//
// Arrays stand after the XML as raw bytes (appended, little-endian, sizes as UInt64), in blocks compressed by zlib.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "genu/core/types.h"

namespace genu {

/// Numbers of points, cells or the file as a whole: `components` of them for each, one after the other.
struct VtkArray {
  std::string name;
  std::vector<double> values;
  int components = 1;
};

/// The same of words.
struct VtkWords {
  std::string name;
  std::vector<std::string> values;
};

struct VtkData {
  std::vector<VtkArray> numbers;
  std::vector<VtkWords> words;
};

/// Cells as the file holds them: made once for a shape that is written at many poses.
struct VtkCells {
  std::size_t count = 0;
  std::string connectivity, offsets;  ///< compressed
};

VtkCells vtk_cells(const std::vector<std::array<int, 3>>& triangles);
/// Of lines over many points, or of vertices where each has one point.
VtkCells vtk_cells(const std::vector<std::vector<int>>& paths);

/// Cell data is in VTK's order: vertices, then lines, then triangles.
struct VtkPolyData {
  std::vector<Vec3> points;
  VtkCells vertices, lines, triangles;
  VtkData point_data, cell_data, field_data;
};

/// The file. Double precision; a value that is not finite is written as NaN.
std::string vtp_text(const VtkPolyData& data);

/// One file of a series.
struct PvdEntry {
  double time = 0;
  int part = 0;            ///< ParaView shows parts as blocks
  std::string name, file;  ///< of the block; path from the .pvd
};

/// ParaView's list (.pvd) of the files of a series.
std::string pvd_text(const std::vector<PvdEntry>& entries);

}  // namespace genu
