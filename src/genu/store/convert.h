// Results as files that other tools open: ParaView's series of .vtp, OpenSim's .mot and .sto.
#pragma once

#include <string>

#include "genu/store/opensim_columns.h"
#include "genu/store/read_results.h"

namespace genu {

/// folders: `vtk` (poses.pvd, vtp/...) and `opensim` (motion.mot, forces.sto); else one of these two as a file
enum class ConvertTo { vtk, opensim, motion, forces };

struct ConvertOptions {
  ConvertTo to = ConvertTo::vtk;
  std::string out = {};           ///< folder or file
  std::string time = {};          ///< column of results.csv used as time; empty: time_s, or the row's number
  int every = 1;                  ///< every so many rows, beginning with the first
  OpenSimNameOptions names = {};  ///< for OpenSim
};

struct ConvertFound {
  std::size_t rows = 0;      ///< written
  std::size_t left_out = 0;  ///< without a pose
  std::size_t files = 0;
  std::size_t bytes = 0;
  std::string time;  ///< which column it is; "row" for the row's number
};

/// Writes whole or not at all. Returns the exit code; `out` holds what was refused or failed.
[[nodiscard]] int convert_results(const ResultsRead& read, const ConvertOptions& options, Diagnostics& out,
                                  ConvertFound& found);

}  // namespace genu
