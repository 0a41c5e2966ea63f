// genu.Scene, and where scenes come from.
#include <memory>
#include <mutex>

#include "bindings.h"
#include "calls.h"

namespace genu::python {
namespace {

/// A scene that several threads of Python may hold: their calls wait for each other. A function that tells progress may
/// use the scene itself.
class SharedScene {
 public:
  explicit SharedScene(api::Scene scene) : scene_(std::move(scene)) {}

  /// f(scene), without Python's lock: who holds that must not wait for this one.
  template <typename F>
  auto with(const F& f) {
    const py::gil_scoped_release free;
    return locked(f);
  }
  /// The same where Python's lock is not held.
  template <typename F>
  auto locked(const F& f) {
    const std::lock_guard<std::recursive_mutex> alone(mutex_);
    return f(scene_);
  }

 private:
  std::recursive_mutex mutex_;
  api::Scene scene_;
};

using Held = std::unique_ptr<SharedScene>;

Held held(api::Scene scene) { return std::make_unique<SharedScene>(std::move(scene)); }

bool is_pattern(const std::string& name) { return name.find_first_of("*?") != std::string::npos; }

py::object get(SharedScene& scene, const std::string& name) {
  const auto found = scene.with([&](const api::Scene& s) { return s.numbers(name); });
  if (found.size() == 1 && !is_pattern(name)) return py::cast(found.front().value);
  py::array_t<double> values(static_cast<py::ssize_t>(found.size()));
  for (std::size_t k = 0; k < found.size(); ++k) values.mutable_at(static_cast<py::ssize_t>(k)) = found[k].value;
  return values;
}

void set(SharedScene& scene, const std::string& name, const py::object& value) {
  const py::object array = py::module_::import("numpy").attr("asarray")(value);
  if (array.attr("ndim").cast<int>() == 0) {
    const double number = numbers_from(array.attr("reshape")(1), "the value of " + name, 1).at(0);
    return scene.with([&](api::Scene& s) { s.set(name, number); });
  }
  const py::array_t<double> numbers = numbers_from(array, "the values of " + name, 1);
  const std::vector<double> values(numbers.data(), numbers.data() + numbers.size());
  scene.with([&](api::Scene& s) { s.set(name, values); });
}

api::Results run(SharedScene& scene, const py::object& progress, bool error_bars) {
  Call call(progress);
  const api::RunOptions options{error_bars, call.progress(), call.cancelled()};
  return call.run([&] { return scene.locked([&](const api::Scene& s) { return s.run(options); }); });
}

/// Columns by name, or an array of the coordinates (rad, m) in the scene's order.
struct GivenPoses {
  std::vector<py::array_t<double>> arrays;
  api::Poses poses;

  void add(const std::string& name, const py::handle& column) {
    poses.names.push_back(name);
    arrays.push_back(numbers_from(column, "the column " + name, 1));
    poses.columns.emplace_back(arrays.back().data(), static_cast<std::size_t>(arrays.back().size()));
  }
};

bool holds_words(const py::handle& column) {
  const auto kind = py::module_::import("numpy").attr("asarray")(column).attr("dtype").attr("kind").cast<std::string>();
  return kind == "U" || kind == "S" || kind == "O";
}

GivenPoses poses_from(SharedScene& scene, const py::object& given, const std::optional<std::string>& units) {
  GivenPoses out;
  out.poses.units = units.value_or("");
  if (py::isinstance<api::Results>(given)) return poses_from(scene, given.attr("table")(), units);
  if (py::hasattr(given, "keys")) {
    const bool results = given.contains("status");  // of an earlier run, with columns of words
    for (const py::handle& key : given.attr("keys")()) {
      const auto name = py::str(key).cast<std::string>();
      if (name == "status")
        for (const py::handle& word : given[key]) out.poses.status.push_back(py::str(word).cast<std::string>());
      else if (!results || !holds_words(given[key]))
        out.add(name, given[key]);
    }
    return out;
  }
  const py::array_t<double> rows = numbers_from(given, "poses", 2);
  const auto names = scene.with([](const api::Scene& s) { return s.coordinates(); });
  if (rows.shape(1) != static_cast<py::ssize_t>(names.size()))
    throw py::value_error("poses have " + std::to_string(rows.shape(1)) + " columns, and there are " +
                          std::to_string(names.size()) + " coordinates: (rows, coordinates), rad and m");
  const py::object columns = rows.attr("T");
  for (std::size_t k = 0; k < names.size(); ++k) out.add(names[k], columns[py::cast(k)]);
  if (!units) out.poses.units = "rad,m";
  return out;
}

api::Results evaluate(SharedScene& scene, const py::object& given, const std::optional<std::string>& units) {
  const GivenPoses poses = poses_from(scene, given, units);
  Call call;
  const auto cancelled = call.cancelled();
  return call.run(
      [&] { return scene.locked([&](const api::Scene& s) { return s.evaluate(poses.poses, cancelled); }); });
}

/// One name or several.
std::vector<std::string> names_from(const py::object& names, const char* what) {
  if (py::isinstance<py::str>(names)) return {names.cast<std::string>()};
  std::vector<std::string> out;
  for (const py::handle& name : names) {
    if (!py::isinstance<py::str>(name)) throw py::type_error(std::string(what) + " must be a str or several");
    out.push_back(name.cast<std::string>());
  }
  return out;
}

std::shared_ptr<api::Sensitivity> sensitivity(SharedScene& scene, const py::object& of, const py::object& to,
                                              const py::object& progress) {
  const auto outputs = names_from(of, "of"), numbers = names_from(to, "to");
  Call call(progress);
  const api::RunOptions options{false, call.progress(), call.cancelled()};
  return std::make_shared<api::Sensitivity>(call.run(
      [&] { return scene.locked([&](const api::Scene& s) { return s.sensitivity(outputs, numbers, options); }); }));
}

api::Laxity laxity(SharedScene& scene, const py::object& at, double anterior, double varus, double internal,
                   double compression, int increments) {
  const py::array_t<double> angles = numbers_from(at, "at", 1);
  Call call;
  const api::LaxityOptions options{{angles.data(), angles.data() + angles.size()},
                                   anterior,
                                   varus,
                                   internal,
                                   compression,
                                   increments,
                                   call.cancelled()};
  return call.run([&] { return scene.locked([&](const api::Scene& s) { return s.laxity(options); }); });
}

using Factors = std::map<std::string, double>;

py::array_t<double> residual(SharedScene& scene, const py::object& q, const Factors& factors, double time) {
  const py::array_t<double> at = numbers_from(q, "q", 1);
  const std::span<const double> values(at.data(), static_cast<std::size_t>(at.size()));
  const auto found = scene.with([&](const api::Scene& s) { return s.residual(values, {factors, time}); });
  return py::array_t<double>(static_cast<py::ssize_t>(found.size()), found.data());
}

py::array_t<double> stiffness(SharedScene& scene, const py::object& q, const Factors& factors, double time) {
  const py::array_t<double> at = numbers_from(q, "q", 1);
  const std::span<const double> values(at.data(), static_cast<std::size_t>(at.size()));
  const api::Matrix found = scene.with([&](const api::Scene& s) { return s.stiffness(values, {factors, time}); });
  return py::array_t<double>({found.rows, found.columns}, found.values.data());
}

std::map<std::string, api::Triangles> meshes_from(const py::object& meshes) {
  std::map<std::string, api::Triangles> out;
  if (meshes.is_none()) return out;
  for (const auto& [name, mesh] : meshes.cast<py::dict>()) {
    const auto pair = mesh.cast<py::sequence>();
    const auto called = name.cast<std::string>();
    if (pair.size() != 2) throw py::value_error("mesh " + called + " must be a pair (vertices, triangles)");
    out.emplace(called, triangles_from(pair[0], pair[1], called));
  }
  return out;
}

std::string path_from(const py::object& path) {
  return py::module_::import("os").attr("fspath")(path).cast<std::string>();
}

Held load(const py::object& file, const py::object& meshes) {
  const std::string path = path_from(file);
  const auto given = meshes_from(meshes);
  const py::gil_scoped_release free;
  return held(api::load(path, given));
}

Held parse(const std::string& text, const py::object& file, const py::object& meshes) {
  const std::string path = path_from(file);
  const auto given = meshes_from(meshes);
  const py::gil_scoped_release free;
  return held(api::parse(text, path, given));
}

/// None, a path, or a list of them.
std::vector<std::string> paths_from(const py::object& given) {
  std::vector<std::string> paths;
  if (given.is_none()) return paths;
  if (!py::isinstance<py::list>(given) && !py::isinstance<py::tuple>(given)) return {path_from(given)};
  for (const py::handle& path : given) paths.push_back(path_from(py::reinterpret_borrow<py::object>(path)));
  return paths;
}

Held make(const py::object& folder, const std::string& kind, const py::object& femur, const py::object& tibia,
          const py::object& patella, const py::object& fibula, const std::string& unit, const std::string& proximal,
          const std::string& anterior, const std::string& side) {
  const std::string name = folder.is_none() ? std::string() : path_from(folder);
  const api::NewScene asked{
      kind,     name, paths_from(femur), paths_from(tibia), paths_from(patella), paths_from(fibula), unit, proximal,
      anterior, side};
  const py::gil_scoped_release free;
  return held(api::make(asked));
}

template <typename F>
auto read(const F& f) {
  return [f](SharedScene& scene) { return scene.with([&](const api::Scene& s) { return (s.*f)(); }); };
}

constexpr char kSceneDoc[] =
    R"(A scene that is read once, changed in memory and solved as often as wanted. Nothing touches the disk.

`scene["AAC.stiffness"]` is a number of the scene by the name that `genu sensitivity` has for it, with or without the kind
of its object before it ("ligament.AAC.stiffness"). Units are those of results, whatever the scene's are: mm, deg, N, N m,
MPa, kg; points are in the frame of their body. `scene["ACL*.stiffness"] *= 0.5` changes all that match. A number that the
scene's rules forbid raises SceneError and changes nothing.

Threads may solve different scenes side by side, with the same results to the last bit; calls of one scene wait for each
other.)";

constexpr char kRunDoc[] =
    R"(Solves the scene as `genu run` does: the same numbers, to the last bit.

progress: True shows a bar on stderr; a function is called as f(done, asked) after every pose.
error_bars: also solves the scene on other surfaces that its meshes might have given (Results.error_bars).
SceneError where the scene cannot be solved at all; poses that are not found are in the results' `verdict` and `status`.
Ctrl-C raises KeyboardInterrupt.)";

constexpr char kEvaluateDoc[] =
    R"(Forces and contacts at given poses, as `genu evaluate` does: nothing is solved.

poses: Results of a run; a dict or DataFrame of columns of one length, named as in results.csv ("knee.flexion_deg"), as the scene or as
OpenSim names the coordinates, also `time` (s) and LOAD.factor; or an array of shape (rows, len(scene.coordinates)).
units: of columns whose names do not say theirs, "deg,mm"; else rad and m.
The residual columns (BODY.residual_force_x_N, ...) hold what each moving body lacks to balance.
SceneError for columns that are missing or hold no numbers.)";

constexpr char kSensitivityDoc[] =
    R"(Solves the scene and differentiates columns of its results to numbers of the scene, exactly.

of: column or columns, with or without their unit ("knee.adduction"); to: number or numbers. * and ? stand for letters,
"all" for everything; names joined by + with ":together" at the end move as one. Returns Sensitivity. SceneError for names
that are none, columns without a derivative and scenes with motion.)";

constexpr char kLaxityDoc[] =
    R"(How lax a knee is, as `genu laxity` tests it: at each flexion angle the neutral pose, then each load up, down and back.

at: flexion angles in deg, shape (n,). anterior (N), varus and internal (N m): loads both ways, 0 for no such test.
compression: N along the tibia's long axis, in all poses. increments: steps from 0 to the full load. Returns Laxity.
SceneError where the scene's joint has no grood_suntay, and for numbers that are out of range.)";

constexpr char kResidualDoc[] =
    R"(For a solver of your own: what drives each coordinate, shape (n,), N m of rotations and N of translations.

q: the values of scene.coordinates, shape (n,), rad and m. factors: of loads by name, 1 where none is given. time: s, for
loads that change with it. The sum of ligaments, cartilage, loads, weights and joint springs; 0 at an equilibrium, for a
prescribed coordinate minus its reaction. SceneError for a scene with rigid contacts (their forces are unknowns), at a gimbal
pose, and where the factor of a load that drives is not given; ValueError for another shape.)";

constexpr char kStiffnessDoc[] =
    R"(-d residual / dq, exact, shape (n, n): N m/rad, N m/m, N/rad and N/m. Symmetric where all forces have a potential,
positive definite at a stable equilibrium. Arguments and errors as of residual().)";

}  // namespace

void add_scenes(py::module_& module) {
  py::class_<api::Number>(module, "Number", "A number of a scene.")
      .def_readonly("name", &api::Number::name)
      .def_readonly("unit", &api::Number::unit, "mm, deg, N, Nm, ...; 1 where there is none")
      .def_readonly("value", &api::Number::value)
      .def("__repr__", [](const api::Number& n) {
        return "<" + n.name + " = " + py::repr(py::float_(n.value)).cast<std::string>() +
               (n.unit == "1" ? "" : " " + n.unit) + ">";
      });
  py::class_<SharedScene>(module, "Scene", kSceneDoc)
      .def("__getitem__", &get, py::arg("name"), "A float; of a pattern a numpy array, shape (matches,), a copy.")
      .def("__setitem__", &set, py::arg("name"), py::arg("value"), "One value for all that match, or as many as match.")
      .def(
          "numbers",
          [](SharedScene& s, const std::string& pattern) {
            return s.with([&](const api::Scene& scene) { return scene.numbers(pattern); });
          },
          py::arg("pattern") = "*", "List of Number: those whose names match, in the scene's order.")
      .def(
          "without",
          [](SharedScene& s, const std::string& pattern) {
            return s.with([&](const api::Scene& scene) { return held(scene.without(pattern)); });
          },
          py::arg("pattern"),
          "Another scene: this one without the ligaments, contacts and loads whose names match (\"ACL*\"). This one "
          "stays "
          "as it is. SceneError where none does.")
      .def(
          "copy", [](SharedScene& s) { return s.with([](const api::Scene& scene) { return held(scene); }); },
          "Another scene, the same for now. Meshes and what was prepared of them are shared.")
      .def("run", &run, py::arg("progress") = py::none(), py::kw_only(), py::arg("error_bars") = false, kRunDoc)
      .def("evaluate", &evaluate, py::arg("poses"), py::arg("units") = py::none(), kEvaluateDoc)
      .def("sensitivity", &sensitivity, py::arg("of"), py::arg("to"), py::arg("progress") = py::none(), kSensitivityDoc)
      .def("laxity", &laxity, py::arg("at") = std::vector<double>{0, 30, 60, 90}, py::kw_only(),
           py::arg("anterior") = 134.0, py::arg("varus") = 10.0, py::arg("internal") = 5.0,
           py::arg("compression") = 0.0, py::arg("increments") = 10, kLaxityDoc)
      .def("residual", &residual, py::arg("q"), py::arg("factors") = Factors(), py::arg("time") = 0.0, kResidualDoc)
      .def("stiffness", &stiffness, py::arg("q"), py::arg("factors") = Factors(), py::arg("time") = 0.0, kStiffnessDoc)
      .def_property_readonly(
          "start",
          [](SharedScene& s) {
            const auto q = s.with([](const api::Scene& scene) { return scene.start(); });
            return py::array_t<double>(static_cast<py::ssize_t>(q.size()), q.data());
          },
          "Where the search for equilibrium starts: the values of `coordinates`, shape (n,), rad and m.")
      .def_property_readonly("title", read(&api::Scene::title))
      .def_property_readonly("file", read(&api::Scene::file), "The scene file, as it was named.")
      .def_property_readonly("coordinates", read(&api::Scene::coordinates), "The free ones: [\"knee.flexion\", ...].")
      .def_property_readonly("bodies", read(&api::Scene::bodies))
      .def_property_readonly("joints", read(&api::Scene::joints))
      .def_property_readonly("surfaces", read(&api::Scene::surfaces))
      .def_property_readonly("contacts", read(&api::Scene::contacts))
      .def_property_readonly("ligaments", read(&api::Scene::ligaments))
      .def_property_readonly("loads", read(&api::Scene::loads))
      .def_property_readonly("warnings", read(&api::Scene::warnings), "Of reading it, as list of Problem.")
      .def_property_readonly("changes", read(&api::Scene::changes), "Since it was read, as list of str.");
  module.def("load", &load, py::arg("file"), py::arg("meshes") = py::none(),
             R"(Reads a scene file and its meshes. Returns Scene.

meshes: a dict of (vertices, triangles) by the names that the scene has for files: arrays of shapes (n, 3), in the unit
that the scene gives for the file, and (m, 3), indices from 0. They are used in the place of the files.
SceneError with everything that is wrong.)");
  module.def("parse", &parse, py::arg("text"), py::arg("file") = "scene.toml", py::arg("meshes") = py::none(),
             "The same of the text of a scene file. file: names it in messages; meshes are looked for in its folder.");
  module.def("new", &make, py::arg("folder") = py::none(), py::kw_only(), py::arg("kind") = "analytic",
             py::arg("femur") = py::none(), py::arg("tibia") = py::none(), py::arg("patella") = py::none(),
             py::arg("fibula") = py::none(), py::arg("unit") = "", py::arg("proximal") = "", py::arg("anterior") = "",
             py::arg("side") = "",
             R"(A scene to start from, as `genu new` makes it. Returns Scene.

folder: made new, with the commented scene in it; None: in memory alone, of kind "analytic" or "motion".
kind: "analytic": a knee of formulas; "stl": from meshes in one frame: `femur` and `tibia`, and `patella` where there is
one, each the path of a bone or its cartilage or a list of paths, of both or in pieces, and `fibula`, of bone; "motion": a shank that swings. unit: of the meshes, "mm", "m", "cm", "inch" or "um". proximal, anterior: axes of the meshes, "x" ... "-z". side: "left" or
"right". What is left out is found from the meshes. SceneError for what is refused.)");
}

}  // namespace genu::python
