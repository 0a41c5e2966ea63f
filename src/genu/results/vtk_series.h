// A solved scene as files for ParaView: surfaces and bones at every pose, ligaments with their strain, contacts with
// their forces. Everything in the axes of the scene's world; lengths in mm, forces in N, pressures in MPa.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "genu/results/report.h"
#include "genu/results/triangle_pressures.h"
#include "genu/results/vtp_writer.h"

namespace genu {

/// Which rows of the run's table are written, and when ParaView shows them.
struct VtkRow {
  std::size_t row = 0;     ///< of ReportRun::poses and body_poses, from 0
  std::size_t number = 0;  ///< of results.csv, from 1
  double time = 0;
  std::vector<TrianglePressures> pressures = {};
};

/// Hands over one file after the other, `name` from the series' folder; an empty text continues, any other stops and
/// comes back.
using WriteFile = std::function<std::string(const std::string& name, const std::string& content)>;

class VtkSeries {
 public:
  /// `run` must outlive this; its body_poses are of every row. `digits`: of the numbers in file names.
  VtkSeries(const ReportRun& run, int digits, WriteFile write);

  /// Writes the files of one row.
  std::string add(const VtkRow& row);
  /// Writes the list, poses.pvd, when all rows are there.
  std::string finish();

 private:
  struct Shape {
    std::string name, file;
    VtkCells cells;
    bool written = false;  ///< of a body that never moves, once for all
  };

  std::string add_shape(std::size_t mesh, const VtkRow& row);
  std::string add_ligaments(const VtkRow& row);
  std::string add_contacts(const VtkRow& row);
  std::string write_part(const std::string& name, const std::string& file, VtkPolyData data, const VtkRow& row);
  void list(const VtkRow& row, const std::string& name, const std::string& file);
  std::string numbered(const std::string& file, const VtkRow& row) const;
  double number_or_nan(const VtkRow& row, const std::string& column) const;
  const std::vector<ReportPath::Point>* wrapped(const VtkRow& row, std::size_t ligament) const;
  Vec3 shown(const VtkRow& row, int body, const Vec3& p) const;

  const ReportRun& run_;
  int digits_;
  WriteFile write_;
  Vec3 origin_ = Vec3::Zero();  ///< m: of the world in which poses are, in the scene's own
  std::vector<Shape> shapes_;
  VtkCells ligament_lines_;
  std::vector<std::string> parts_;
  std::vector<PvdEntry> entries_;
};

}  // namespace genu
