// genu.Problem and genu.SceneError.
#include "bindings.h"

namespace genu::python {
namespace {

PyObject* scene_error = nullptr;  // the class; the module keeps it

py::object place(int number) { return number > 0 ? py::cast(number) : py::none(); }

/// The exception with the first error's place as attributes.
void raise(const api::SceneError& error) {
  const py::handle type(scene_error);
  py::object raised = type(error.what());
  const api::Problem& first = error.first();
  raised.attr("file") = first.file;
  raised.attr("line") = place(first.line);
  raised.attr("column") = place(first.column);
  raised.attr("key") = first.key;
  raised.attr("found") = first.found;
  raised.attr("rule") = first.rule;
  raised.attr("code") = first.code;
  raised.attr("problems") = error.problems();
  PyErr_SetObject(scene_error, raised.ptr());
}

constexpr char kSceneErrorDoc[] =
    R"(Whatever is wrong with a scene, a mesh or a request: all of it at once.

The text has every error, a line each. Attributes of the first one: `file`, `line` and `column` (from 1, None where
there is none), `key` ("ligament.AAC.stiffness"), `found` ("-2"), `rule` ("must be > 0 N"), `code` ("out-of-range").
`problems`: list of all, errors and warnings, as `Problem`.)";

}  // namespace

void add_errors(py::module_& module) {
  py::class_<api::Problem>(module, "Problem", "One error or warning, with its place in the scene's file.")
      .def_readonly("warning", &api::Problem::warning, "True for a warning, False for an error.")
      .def_readonly("code", &api::Problem::code, "What kind of mistake, one of a fixed list: \"no-such-file\".")
      .def_readonly("file", &api::Problem::file, "May be empty.")
      .def_property_readonly(
          "line", [](const api::Problem& p) { return place(p.line); }, "From 1; None where there is none.")
      .def_property_readonly(
          "column", [](const api::Problem& p) { return place(p.column); }, "From 1; None where there is none.")
      .def_readonly("key", &api::Problem::key, "\"ligament.AAC.stiffness\"; may be empty.")
      .def_readonly("found", &api::Problem::found, "The value as found; may be empty.")
      .def_readonly("rule", &api::Problem::rule, "What is allowed, or what is wrong.")
      .def("__str__", [](const api::Problem& p) { return p.text; })
      .def("__repr__", [](const api::Problem& p) { return "<genu.Problem " + p.text + ">"; });
  scene_error = PyErr_NewExceptionWithDoc("genu.SceneError", kSceneErrorDoc, PyExc_ValueError, nullptr);
  module.add_object("SceneError", py::reinterpret_borrow<py::object>(scene_error));
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const api::SceneError& error) {
      raise(error);
    }
  });
}

}  // namespace genu::python
