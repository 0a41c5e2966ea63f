// A mesh file of any bytes: read as `genu mesh-check` reads it, and examined where it can be read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz/fuzz_checks.h"
#include "genu/mesh_care/mesh_examination.h"
#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/mesh_files/tolerances.h"
#include "support/temporary_folder.h"

namespace genu::fuzz {

inline void require_sound(const Mesh& mesh, double metres_per_unit) {
  require(!mesh.triangles.empty(), "a mesh has triangles");
  for (const Vec3& v : mesh.vertices)
    require(v.cwiseAbs().maxCoeff() <= kMaxCoordinate * metres_per_unit, "vertices are finite and near");
  const auto count = static_cast<int>(mesh.vertices.size());
  for (const auto& t : mesh.triangles) {
    for (const int v : t) require(v >= 0 && v < count, "triangles name vertices that are there");
    require(t[0] != t[1] && t[1] != t[2] && t[2] != t[0], "triangles have three corners");
  }
}

inline int mesh_file(const std::uint8_t* data, std::size_t size, const std::string& extension) {
  static const test::TemporaryFolder folder;
  const std::string path = folder.write("mesh" + extension, std::string(reinterpret_cast<const char*>(data), size));
  Diagnostics out;
  MeshFileFacts facts;
  double metres_per_unit = 0;
  const auto mesh = read_mesh_of_some_unit(path, metres_per_unit, out, &facts);
  require_result_or_reason(mesh.has_value(), out);
  if (!mesh) return 0;
  require_sound(*mesh, metres_per_unit);
  const MeshExamination examination = examine_mesh(*mesh, facts, metres_per_unit);
  require(!examination.findings.empty(), "an examination finds something to say");
  for (const Flaw& flaw : examination.flaws)
    require(flaw.centre.allFinite() && flaw.radius >= 0, "a flaw has a place: " + describe(flaw, metres_per_unit));
  return 0;
}

}  // namespace genu::fuzz
