// What the module's parts share. Each part adds one topic to the module.
#pragma once

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "genu/genu.h"

namespace genu::python {

namespace py = pybind11;

void add_errors(py::module_& module);
void add_tables(py::module_& module);
void add_results(py::module_& module);
void add_meshes(py::module_& module);
void add_scenes(py::module_& module);

/// Numbers of any real type, shape and order as doubles, row by row. `dimensions`: how many the array must have.
/// TypeError for complex numbers, words and objects, ValueError for another shape; both name `what`.
py::array_t<double> numbers_from(const py::handle& object, const std::string& what, py::ssize_t dimensions);

/// Memory of `owner` as an array that keeps it and cannot be written to.
template <typename Owner>
py::array_t<double> view(const double* data, std::vector<py::ssize_t> shape, Owner owner) {
  const py::capsule keeper(new Owner(std::move(owner)), [](void* p) { delete static_cast<Owner*>(p); });
  py::array_t<double> array(std::move(shape), data, keeper);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// Two arrays (n x 3 vertices, m x 3 triangles) as a mesh.
api::Triangles triangles_from(const py::handle& vertices, const py::handle& triangles, const std::string& name);

}  // namespace genu::python
