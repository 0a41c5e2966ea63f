// genu.mesh_check.
#include "bindings.h"

namespace genu::python {
namespace {

/// A path, or a pair of arrays.
api::MeshCheck check(const py::object& mesh, const std::optional<std::string>& unit) {
  const std::string said = unit.value_or("");
  if (py::isinstance<py::tuple>(mesh) || py::isinstance<py::list>(mesh)) {
    const auto pair = mesh.cast<py::sequence>();
    if (pair.size() != 2) throw py::value_error("a mesh in memory is a pair (vertices, triangles)");
    const api::Triangles triangles = triangles_from(pair[0], pair[1], "the mesh");
    const py::gil_scoped_release free;
    return api::check_mesh(triangles, said);
  }
  const auto file = py::module_::import("os").attr("fspath")(mesh).cast<std::string>();
  const py::gil_scoped_release free;
  return api::check_mesh(file, said);
}

}  // namespace

void add_meshes(py::module_& module) {
  using Finding = api::MeshCheck::Finding;
  py::class_<Finding>(module, "MeshFinding", "One question about a mesh, with a number and a verdict.")
      .def_readonly("question", &Finding::question, "\"non-manifold edges\"")
      .def_readonly("number", &Finding::number, "\"3\", with its unit.")
      .def_readonly("verdict", &Finding::verdict,
                    "\"ok\"; \"note\": worth knowing; \"BAD\": contact near it cannot be trusted.")
      .def_readonly("why", &Finding::why, "Or where, or what to do; may be empty.")
      .def("__repr__", [](const Finding& f) { return "<" + f.question + ": " + f.number + ", " + f.verdict + ">"; });
  py::class_<api::MeshCheck>(module, "MeshCheck", "What `genu mesh-check` reports.")
      .def_readonly("unit", &api::MeshCheck::unit, "\"mm\" or \"m\"")
      .def_readonly("guessed", &api::MeshCheck::guessed, "Whether the unit was guessed from the size.")
      .def_readonly("vertices", &api::MeshCheck::vertices, "Number of vertices after welding.")
      .def_readonly("triangles", &api::MeshCheck::triangles, "Number of triangles.")
      .def_readonly("bad", &api::MeshCheck::bad, "Whether contact near some place cannot be trusted.")
      .def_readonly("findings", &api::MeshCheck::findings, "List of MeshFinding.")
      .def_readonly("warnings", &api::MeshCheck::warnings, "List of Problem.");
  module.def("mesh_check", &check, py::arg("mesh"), py::arg("unit") = py::none(),
             R"(Everything there is to say about a mesh before contact is computed on it.

mesh: path of an STL, PLY, OBJ, OFF or VTP file, or a pair (vertices, triangles) of arrays with shapes (n, 3) and (m, 3):
coordinates, and indices from 0, counter-clockwise seen from outside.
unit: "mm", "m", "cm", "inch" or "um"; guessed (mm or m) from the size where it is None.
SceneError for a mesh that cannot be read; TypeError and ValueError for arrays of another type or shape.)");
}

}  // namespace genu::python
