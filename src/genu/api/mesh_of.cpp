#include "genu/api/mesh_of.h"

#include <fmt/format.h>

#include "genu/api/inside.h"
#include "genu/core/length_units.h"
#include "genu/mesh_care/mesh_examination.h"
#include "genu/scene/words.h"

namespace genu::api {
namespace {

MeshCheck check_named(const std::string& name, const std::string& unit, MeshLibrary& library) {
  const std::optional<double> given = metres_in(unit);
  if (!unit.empty() && !given)
    refuse(Code::unknown_name, "unit", with_quotes(unit), "must be one of " + quoted_list(length_unit_names()));
  Diagnostics out;
  MeshFileFacts facts;
  double metres = given.value_or(1e-3);
  const auto mesh =
      unit.empty() ? library.read_of_some_unit(name, metres, out, &facts) : library.read(name, metres, out, &facts);
  check(out);
  const MeshExamination examination = examine_mesh(*mesh, facts, metres);
  MeshCheck found;
  found.unit = length_unit_name(metres);
  found.guessed = unit.empty();
  found.vertices = mesh->vertices.size();
  found.triangles = mesh->triangles.size();
  found.bad = examination.bad();
  for (const MeshFinding& f : examination.findings)
    found.findings.push_back({f.question, f.number, to_string(f.verdict), f.why});
  found.warnings = problems_of(out);
  return found;
}

}  // namespace

Mesh mesh_of(const std::string& name, const Triangles& given) {
  Mesh mesh;
  for (const auto& v : given.vertices) mesh.vertices.emplace_back(v[0], v[1], v[2]);
  const int count = static_cast<int>(given.vertices.size());
  for (const auto& t : given.triangles)
    for (const int corner : t)
      if (corner < 0 || corner >= count)
        refuse(Code::mesh_unreadable, "mesh", with_quotes(name),
               fmt::format("has a triangle with vertex {}, and its vertices are 0 to {}", corner, count - 1));
  if (given.triangles.empty()) refuse(Code::mesh_unreadable, "mesh", with_quotes(name), "has no triangles");
  mesh.triangles = given.triangles;
  return mesh;
}

MeshCheck check_mesh(const std::string& file, const std::string& unit) {
  MeshLibrary library;
  return check_named(file, unit, library);
}

MeshCheck check_mesh(const Triangles& mesh, const std::string& unit) {
  MeshLibrary library;
  library.put("mesh", mesh_of("mesh", mesh));
  return check_named("mesh", unit, library);
}

}  // namespace genu::api
