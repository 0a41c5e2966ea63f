// genu.Table.
#include "bindings.h"

namespace genu::python {
namespace {

py::object column(const api::Table& table, const std::string& name) {
  if (table.has_words(name)) return py::cast(table.words(name));
  const auto numbers = table.numbers(name);
  return view(numbers.data(), {static_cast<py::ssize_t>(numbers.size())}, table);
}

}  // namespace

void add_tables(py::module_& module) {
  py::class_<api::Table>(module, "Table", R"(Columns of results by name, as of a file results.csv. Never changes.

`table["knee.rotation_deg"]` is a numpy array of float64, shape (rows,), that shares the table's memory and cannot be
written to; NaN where a cell is empty. A column of words, such as `status`, is a list of str. A name that is none raises
SceneError, which names the nearest one. `dict(table)` has all columns.)")
      .def("__getitem__", &column, py::arg("column"))
      .def("__contains__", [](const api::Table& t, const std::string& name) { return t.has(name); })
      .def("__contains__", [](const api::Table&, const py::object&) { return false; })
      .def("__iter__", [](const api::Table& t) { return py::iter(py::cast(t.columns())); })
      .def("__len__", [](const api::Table& t) { return t.columns().size(); })
      .def("keys", &api::Table::columns, "Names of the columns, from left to right.")
      .def_property_readonly("columns", &api::Table::columns, "Names of the columns, from left to right.")
      .def_property_readonly("rows", &api::Table::rows, "Number of rows.")
      .def("csv", &api::Table::csv, "The text of the file that the program writes: 17 significant digits.");
}

}  // namespace genu::python
