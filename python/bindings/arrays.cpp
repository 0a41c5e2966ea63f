// Arrays from Python, of whatever type, shape and order.
#include "bindings.h"

namespace genu::python {
namespace {

std::string text_of(const py::handle& object) { return py::str(object).cast<std::string>(); }

py::array array_from(const py::handle& object, const std::string& what, const std::string& kinds,
                     py::ssize_t dimensions) {
  py::array array = py::module_::import("numpy").attr("asarray")(object);
  if (kinds.find(array.dtype().kind()) == std::string::npos)
    throw py::type_error(what + " must be " + (kinds == "iu" ? "whole numbers" : "numbers") + ", not " +
                         text_of(array.dtype()));
  if (array.ndim() != dimensions)
    throw py::value_error(what + " has shape " + text_of(array.attr("shape")) + ": it must have " +
                          std::to_string(dimensions) + (dimensions == 1 ? " dimension" : " dimensions"));
  return array;
}

}  // namespace

py::array_t<double> numbers_from(const py::handle& object, const std::string& what, py::ssize_t dimensions) {
  return py::array_t<double, py::array::c_style | py::array::forcecast>(array_from(object, what, "fiu", dimensions));
}

api::Triangles triangles_from(const py::handle& vertices, const py::handle& triangles, const std::string& name) {
  const py::array_t<double> v = numbers_from(vertices, "the vertices of " + name, 2);
  const py::array_t<long long, py::array::c_style | py::array::forcecast> t(
      array_from(triangles, "the triangles of " + name, "iu", 2));
  const auto check = [&](const py::array& a, const char* what) {
    if (a.shape(1) != 3)
      throw py::value_error(std::string("the ") + what + " of " + name + " have shape " + text_of(a.attr("shape")) +
                            ": it must be (n, 3)");
  };
  check(v, "vertices");
  check(t, "triangles");
  api::Triangles mesh;
  for (py::ssize_t i = 0; i < v.shape(0); ++i) mesh.vertices.push_back({v.at(i, 0), v.at(i, 1), v.at(i, 2)});
  const auto corner = [&](py::ssize_t i, py::ssize_t k) {
    const long long index = t.at(i, k);
    return index < 0 || index >= v.shape(0) ? -1 : static_cast<int>(index);  // refused with the mesh
  };
  for (py::ssize_t i = 0; i < t.shape(0); ++i) mesh.triangles.push_back({corner(i, 0), corner(i, 1), corner(i, 2)});
  return mesh;
}

}  // namespace genu::python
