// genu.Results and genu.Sensitivity.
#include "bindings.h"

namespace genu::python {
namespace {

py::object pose_column(const api::Results& results, const std::string& name) {
  return py::cast(results.poses()).attr("__getitem__")(name);
}

py::array_t<double> matrix_of(std::vector<double> values, py::ssize_t rows) {
  const py::ssize_t columns = rows == 0 ? 0 : static_cast<py::ssize_t>(values.size()) / rows;
  auto kept = std::make_shared<const std::vector<double>>(std::move(values));
  return view(kept->data(), {rows, columns}, kept);
}

py::array_t<double> cube_of(const std::shared_ptr<api::Sensitivity>& s, const std::vector<double>& values) {
  const auto size = [](const auto& names) { return static_cast<py::ssize_t>(names.size()); };
  const py::ssize_t one = size(s->of) * size(s->to);
  return view(values.data(), {one == 0 ? 0 : size(values) / one, size(s->of), size(s->to)}, s);
}

}  // namespace

void add_results(py::module_& module) {
  py::class_<api::Results>(module, "Results", R"(What a run, or an evaluation of given poses, has found.

`r["knee.rotation_deg"]` is a column of `r.table()`. Lengths are in mm, angles in deg, forces in N, moments in N m, points
in the frame of the body that a column names. Results stay valid when their scene is changed or freed.)")
      .def("__getitem__", &pose_column, py::arg("column"),
           "A column of table(): numpy array of float64, shape (rows,), no copy, read-only; list of str for words.")
      .def("__contains__", [](const api::Results& r, const std::string& name) { return r.poses().has(name); })
      .def("__len__", &api::Results::rows)
      .def("table", &api::Results::poses, "The columns of results.csv, one row a pose.")
      .def_property_readonly("events", &api::Results::events,
                             "Table, one row an event between two poses: contacts gained and lost, ligaments taut and "
                             "slack, limit points.")
      .def_property_readonly("error_bars", &api::Results::error_bars,
                             "With run(error_bars=True): Table of each number's uncertainty, else None.")
      .def_property_readonly("verdict", &api::Results::verdict,
                             "\"solved\"; \"doubtful\": solved, with jumps or doubts; \"not_solved\": not every pose; "
                             "\"evaluated\": poses were given.")
      .def_property_readonly("sentences", &api::Results::sentences, "Why, as list of str.")
      .def_property_readonly("asked", &api::Results::asked, "Number of poses asked for.")
      .def_property_readonly("solved", &api::Results::solved, "Number of poses found.")
      .def_property_readonly("title", &api::Results::title, "Of the scene.")
      .def_property_readonly("changes", &api::Results::changes,
                             "What was changed in the scene since it was read, as list of str.")
      .def_property_readonly(
          "q", [](const api::Results& r) { return matrix_of(r.coordinates(), static_cast<py::ssize_t>(r.rows())); },
          "The free coordinates, shape (rows, len(scene.coordinates)), rad and m: what scene.residual() takes. NaN "
          "where "
          "a pose was not found.")
      .def("summary", &api::Results::summary_json, "The text of summary.json.")
      .def(
          "report",
          [](const api::Results& r, const py::object& file) {
            const auto path = py::module_::import("os").attr("fspath")(file).cast<std::string>();
            const py::gil_scoped_release free;
            r.report(path);
          },
          py::arg("file"),
          "Writes the page that shows the joint in a browser, all in one file. SceneError where it cannot be written, "
          "or "
          "for given poses.");
  py::class_<api::Sensitivity, std::shared_ptr<api::Sensitivity>>(
      module, "Sensitivity", R"(Derivatives of columns of results to numbers of a scene, exact, at every pose.

`derivatives` and `effects` have shape (rows, len(of), len(to)).)")
      .def_readonly("results", &api::Sensitivity::results, "Results of the run.")
      .def_readonly("of", &api::Sensitivity::of, "Names of the columns.")
      .def_readonly("of_units", &api::Sensitivity::of_units, "Their units.")
      .def_readonly("to", &api::Sensitivity::to, "Names of the numbers.")
      .def_readonly("to_units", &api::Sensitivity::to_units, "Their units.")
      .def_readonly("changes", &api::Sensitivity::changes, "A standard change of each number: \"1 %\", \"1 mm\".")
      .def_property_readonly(
          "derivatives", [](std::shared_ptr<api::Sensitivity> s) { return cube_of(s, s->derivatives); },
          "In the unit of the column per unit of the number. NaN where a pose has none. No copy, read-only.")
      .def_property_readonly(
          "effects", [](std::shared_ptr<api::Sensitivity> s) { return cube_of(s, s->effects); },
          "In the unit of the column, of the standard change of each number. No copy, read-only.");
  py::class_<api::Laxity>(module, "Laxity", "What a laxity test has found.")
      .def_readonly("poses", &api::Laxity::poses, "Table, one row a pose: the columns of laxity.csv.")
      .def_readonly("summary", &api::Laxity::summary, "Table, one row a curve: the columns of laxity_summary.csv.")
      .def_readonly("complete", &api::Laxity::complete, "Whether every curve reaches its full load both ways.")
      .def_readonly("sentences", &api::Laxity::sentences, "What is missing, and why, as list of str.")
      .def("__repr__", [](const api::Laxity& l) { return l.text; });
}

}  // namespace genu::python
