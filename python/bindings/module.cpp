// The compiled part of the Python package genu.
#include "bindings.h"

PYBIND11_MODULE(_genu, module) {
  module.doc() = "The compiled part of genu: import genu instead.";
  module.attr("__version__") = GENU_VERSION;
  genu::python::add_errors(module);
  genu::python::add_tables(module);
  genu::python::add_results(module);
  genu::python::add_meshes(module);
  genu::python::add_scenes(module);
}
