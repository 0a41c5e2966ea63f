// The small reference problems (JSON) as scene files, so that they take the same way as a user's.
//
// Their conventions: mm, deg, N, N mm; the body `moving` in the body `fixed`; a pose is x, y, z, then flexion about x,
// adduction about y and rotation about z, successive; `axes` are the rows e1, e2, e3 of a surface's frame.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace genu::test {

using Json = nlohmann::json;

/// A number, also where it is written as text to keep all of its digits.
inline double number(const Json& value) {
  return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

inline std::vector<double> numbers(const Json& list) {
  std::vector<double> out;
  for (const Json& value : list) out.push_back(number(value));
  return out;
}

/// The first of several names that `object` has; throws std::out_of_range where it has none.
inline const Json& first_of(const Json& object, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (object.contains(name)) return object.at(name);
  throw std::out_of_range(fmt::format("none of {} in {}", fmt::join(names, ", "), object.dump()));
}

class CaseScene {
 public:
  explicit CaseScene(const Json& scene) : scene_(scene) {}

  /// The scene file; `steps` are its [[step]] tables.
  std::string text(const std::string& steps) const {
    const std::vector<double> pose = numbers(scene_.at("pose_guess"));
    std::string out = fmt::format(
        "format = 1\nunits = {{ length = \"mm\", angle = \"deg\" }}\n[body.fixed]\nfixed = true\n[body.moving]\n"
        "[joint.j]\ntype = \"free\"\nparent = \"fixed\"\nchild = \"moving\"\n"
        "rotations = [\"flexion x\", \"adduction y\", \"rotation z\"]\ntranslations = [\"tx\", \"ty\", \"tz\"]\n"
        "reference = {{ tx = {:.17g}, ty = {:.17g}, tz = {:.17g}, flexion = {:.17g}, adduction = {:.17g}, "
        "rotation = {:.17g} }}\n",
        pose[0], pose[1], pose[2], pose[3], pose[4], pose[5]);
    const Json surfaces = scene_.value("surfaces", Json::object());
    for (const auto& [name, surface] : surfaces.items()) out += surface_text(name, surface);
    for (const auto& [pair, names] : pairs()) out += pair_text(pair);
    for (const Json& spring : list_of("springs")) out += spring_text(spring);
    int loads = 0;
    for (const Json& load : list_of("loads")) out += load_text(load, ++loads);
    return out + steps;
  }

  /// prescribe = { ... } of the case's constraints.
  std::string prescribed() const {
    std::vector<std::string> items;
    for (const Json& c : list_of("constraints"))
      items.push_back(fmt::format("\"j.{}\" = {:.17g}", c.at("coord").get<std::string>(), number(c.at("value"))));
    return fmt::format("prescribe = {{ {} }}\n", fmt::join(items, ", "));
  }

  /// load = { ... } that takes the scaled loads from one factor to another.
  std::string scaled_loads(double from, double to) const {
    std::vector<std::string> items;
    int index = 0;
    for (const Json& load : list_of("loads")) {
      ++index;
      if (load.value("scaled", false)) items.push_back(fmt::format("load_{} = [{:.17g}, {:.17g}]", index, from, to));
    }
    return fmt::format("load = {{ {} }}\n", fmt::join(items, ", "));
  }

  /// The contacts of a case by the surfaces they are between: "fixed surface/moving surface".
  std::map<std::string, std::vector<std::string>> pairs() const {
    std::map<std::string, std::vector<std::string>> out;
    for (const Json& c : list_of("contacts"))
      out[c.at("fixed").get<std::string>() + "/" + c.at("moving").get<std::string>()].push_back(c.at("name"));
    return out;
  }

  /// The name of a pair's contact in the scene file.
  static std::string pair_name(const std::string& pair) {
    std::string name = "pair_" + pair;
    name[name.find('/')] = '-';
    return name;
  }

 private:
  Json list_of(const char* key) const { return scene_.value(key, Json::array()); }
  static std::string list(const Json& values) { return fmt::format("[{:.17g}]", fmt::join(numbers(values), ", ")); }

  static std::string surface_text(const std::string& name, const Json& s) {
    const std::string type = first_of(s, {"type", "shape"}).get<std::string>();
    std::string out = fmt::format("[surface.{}]\nbody = \"{}\"\nshape = \"{}\"\n", name,
                                  s.at("body").get<std::string>(), type == "polynomial_patch" ? "polynomial" : type);
    for (const char* key : {"origin", "center", "centre", "position"})
      if (s.contains(key)) out += "origin = " + list(s.at(key)) + "\n";
    if (s.contains("axes")) out += "x_axis = " + list(s.at("axes")[0]) + "\nz_axis = " + list(s.at("axes")[2]) + "\n";
    if (s.value("inside", false) || s.value("concave", false) || s.value("outward", 1) < 0) out += "inside = true\n";
    if (type == "sphere" || type == "cylinder")
      out += fmt::format("radius = {:.17g}\n", number(first_of(s, {"radius", "r"})));
    if (type == "ellipsoid") out += "radii = " + list(first_of(s, {"radii", "semi_axes", "semiaxes"})) + "\n";
    if (type == "torus")
      out += fmt::format("major_radius = {:.17g}\nminor_radius = {:.17g}\n",
                         number(first_of(s, {"major", "major_radius", "R"})),
                         number(first_of(s, {"minor", "minor_radius", "r"})));
    if (type == "polynomial" || type == "polynomial_patch") out += polynomial_text(s);
    return out;
  }

  static std::string polynomial_text(const Json& s) {
    std::vector<std::string> terms;
    for (const Json& t : first_of(s, {"terms", "coefficients"}))
      terms.push_back(fmt::format("[{}, {}, {:.17g}]", t[0].get<int>(), t[1].get<int>(), number(t[2])));
    const std::string chart = s.value("chart", std::string("cartesian"));
    return fmt::format("terms = [{}]\nchart = \"{}\"\n", fmt::join(terms, ", "), chart);
  }

  static std::string pair_text(const std::string& pair) {
    const std::size_t slash = pair.find('/');
    return fmt::format("[contact.{}]\nsurfaces = [\"{}\", \"{}\"]\nmodel = \"rigid\"\n", pair_name(pair),
                       pair.substr(0, slash), pair.substr(slash + 1));
  }

  static std::string spring_text(const Json& s) {
    const Json& law = s.at("law");
    const std::string type = law.at("type").get<std::string>();
    std::string out = fmt::format(
        "[ligament.{}]\nfrom = {{ body = \"moving\", point = {} }}\n"
        "to = {{ body = \"fixed\", point = {} }}\n",
        s.at("name").get<std::string>(), list(s.at("moving")), list(s.at("fixed")));
    // "_abs" laws know the elongation, the others the strain.
    static const std::map<std::string, std::string> names{
        {"quadratic", "quadratic"},       {"linear", "linear"},       {"linear_strain", "linear"},
        {"linear_abs", "spring"},         {"spring", "spring"},       {"bilateral", "spring"},
        {"blankevoort", "blankevoort"},   {"wismans", "blankevoort"}, {"quadratic_linear", "blankevoort"},
        {"piecewise", "blankevoort"},     {"toe", "blankevoort"},     {"abdel-rahman", "abdel-rahman"},
        {"abdel_rahman", "abdel-rahman"}, {"table", "table"}};
    const auto known = names.find(type);
    if (known == names.end()) throw std::out_of_range("the law " + type + " is not known here");
    out += "law = \"" + known->second + "\"\n";
    if (known->second == "table") {
      std::vector<std::string> points;
      for (const Json& p : law.at("points")) points.push_back(list(p));
      out += fmt::format("points = [{}]\n", fmt::join(points, ", "));
    } else {
      out += fmt::format("stiffness = {:.17g}\n", number(first_of(law, {"k", "K", "stiffness", "K1", "k1"})));
    }
    if (known->second == "blankevoort" || known->second == "abdel-rahman")
      out += fmt::format("transition_strain = {:.17g}\n",
                         number(first_of(law, {"transition_strain", "e_t", "et", "eps_t", "eps_l", "e_l", "toe"})));
    if (known->second == "abdel-rahman")
      out += fmt::format("toe_stiffness = {:.17g}\n", number(first_of(law, {"K2", "k2", "toe_stiffness"})));
    if (law.contains("reference_strain") || law.contains("e_r"))
      return out + fmt::format("reference_strain = {:.17g}\n", number(first_of(law, {"reference_strain", "e_r"})));
    return out + fmt::format("slack_length = {:.17g}\n", number(first_of(law, {"L0", "slack_length"})));
  }

  static std::string load_text(const Json& load, int index) {
    const bool moment = load.at("type") == "moment";
    std::vector<double> vector = numbers(load.at("vector"));
    if (moment)
      for (double& v : vector) v *= 1e-3;  // N mm
    const bool follower = load.value("frame", std::string("fixed")) == "moving";
    std::string out = fmt::format("[load.load_{}]\nbody = \"moving\"\n{} = [{:.17g}]\nframe = \"{}\"\n", index,
                                  moment ? "moment" : "force", fmt::join(vector, ", "), follower ? "body" : "world");
    if (load.contains("point")) out += "point = " + list(load.at("point")) + "\n";
    return out;
  }

  const Json& scene_;
};

}  // namespace genu::test
