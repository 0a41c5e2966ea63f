#include "genu/model/parameters.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/law/laws.h"
#include "genu/model/tolerances.h"

namespace genu {
namespace {

using Kind = Parameter::Kind;

constexpr const char* kAxes[] = {"x", "y", "z"};
constexpr double kPerCent = 0.01;

class Parameters {
 public:
  explicit Parameters(const SceneTables& scene) : scene_(scene) {}

  std::vector<Parameter> list() {
    for_each(scene_.ligaments, [&](const LigamentDef& l) { add_ligament(l); });
    for_each(scene_.surfaces, [&](const SurfaceDef& s) { add_surface(s); });
    for_each(scene_.loads, [&](const LoadDef& l) { add_load(l); });
    for_each(scene_.bodies, [&](const BodyDef& b) { add_numbers(b, Kind::body_number); });
    for_each(scene_.joints, [&](const JointDef& j) { add_numbers(j, Kind::joint_number); });
    for_each(scene_.bushings, [&](const BushingDef& b) { add_numbers(b, Kind::bushing_number); });
    add_prescribed();
    tell_apart();
    return std::move(out_);
  }

 private:
  template <class Defs, class Add>
  void for_each(const Defs& defs, const Add& add) {
    object_ = 0;
    for (const auto& def : defs) {
      add(def);
      ++object_;
    }
  }

  Parameter& add(const std::string& name, Kind kind, const std::string& unit, double si, double change,
                 const std::string& change_text) {
    Parameter p;
    p.name = name;
    p.kind = kind;
    p.object = object_;
    p.unit = unit;
    p.si = si;
    p.change = change;
    p.change_text = change_text;
    out_.push_back(p);
    return out_.back();
  }

  void add_length(const std::string& name, Kind kind, int component = 0) {
    add(name, kind, "mm", units::kMillimetre, units::kMillimetre, "1 mm").component = component;
  }
  void add_point(const std::string& name, Kind kind) {
    for (int i = 0; i < 3; ++i) add_length(name + "." + kAxes[i], kind, i);
  }
  void add_share(const std::string& name, Kind kind, const std::string& unit, double si, double value) {
    add(name, kind, unit, si, kRelativeChange * value, "1 %").positive = true;
  }

  /// One number of a row, by the row's own standard change.
  Parameter& add_number(const std::string& name, Kind kind, const NumberRow& row, double value) {
    if (row.change == NumberRow::Change::share)
      add_share(name, kind, unit_in_results(row.unit), si(row.unit), value);
    else
      add(name, kind, unit_in_results(row.unit), si(row.unit), standard_change(row.unit),
          standard_change_text(row.unit));
    return out_.back();
  }

  /// The numbers of an object's table, but for those whose change has no effect and shares of 0.
  template <class Def>
  void add_numbers(const Def& def, Kind kind) {
    int k = -1;
    for (const NumberOf<Def>& number : kind_of(def).numbers) {
      ++k;
      const NumberRow& row = number.row;
      const double* values = number.values_of(def);
      if (values == nullptr || (number.has_effect != nullptr && !number.has_effect(def))) continue;
      for (int i = 0; i < row.size; ++i) {
        if (!std::isfinite(values[i]) || (row.change == NumberRow::Change::share && !(values[i] > 0))) continue;
        Parameter& p = add_number(def.name + "." + row.parameter() + (row.size > 1 ? std::string(".") + kAxes[i] : ""),
                                  kind, row, values[i]);
        p.number = k;
        p.component = i;
      }
    }
  }

  void add_law_numbers(const LigamentDef& l) {
    for (std::size_t k = 0; k < l.numbers.size(); ++k) {
      const NumberRow& row = find_law(l.law)->numbers[k];
      add_number(l.name + "." + row.key, Kind::law_number, row, l.numbers[k].value).number = static_cast<int>(k);
    }
  }

  void add_ligament(const LigamentDef& l) {
    add_law_numbers(l);
    switch (l.rest) {
      case LigamentDef::Rest::slack_length:
        add_share(l.name + ".slack_length", Kind::slack_length, "mm", units::kMillimetre, l.rest_value);
        break;
      case LigamentDef::Rest::reference_strain:
        add(l.name + ".reference_strain", Kind::reference_strain, "1", 1, standard_change(Unit::number),
            standard_change_text(Unit::number));
        break;
      case LigamentDef::Rest::reference_force:
        add(l.name + ".reference_force", Kind::reference_force, "N", 1, 1, "1 N");
        break;
    }
    if (l.damping > 0) add_number(l.name + ".damping", Kind::damping, kLigamentDamping, l.damping);
    add_point(l.name + ".from", Kind::from_point);
    add_point(l.name + ".to", Kind::to_point);
    for (int k = 0; k < 3 * static_cast<int>(l.via.size()); ++k)
      add_length(fmt::format("{}.via.{}.{}", l.name, k / 3 + 1, kAxes[k % 3]), Kind::via_point, k);
  }

  void add_surface(const SurfaceDef& s) {
    add_terms(s);
    add_numbers(s, Kind::surface_number);
    add_length(s.name + ".offset", Kind::offset);
  }

  void add_terms(const SurfaceDef& s) {
    for (std::size_t k = 0; k < s.terms.size(); ++k) {
      const SurfaceDef::Term& term = s.terms[k];
      const int lengths = term.j + (s.shape == SurfaceDef::Shape::polynomial ? term.i : 0), power = 1 - lengths;
      const std::string unit = power == 0 ? "1" : power == 1 ? "mm" : fmt::format("mm^{}", power);
      const double change = units::kMillimetre / std::pow(kTermReach, lengths);
      const double si = std::pow(units::kMillimetre, power);
      add(fmt::format("{}.terms.{}.{}", s.name, term.i, term.j), Kind::term, unit, si, change,
          fmt::format("{:g}{}", change / si, power == 0 ? "" : " " + unit))
          .component = static_cast<int>(k);
    }
  }

  void add_load(const LoadDef& l) {
    add_numbers(l, Kind::load_number);
    add_share(l.name + ".factor", Kind::factor, "1", 1, 1);
  }

  void add_prescribed() {
    object_ = -1;
    std::vector<QuantityRef> seen;
    for (const StepDef& step : scene_.steps) {
      for (const auto& p : step.prescribe) {
        if (std::find(seen.begin(), seen.end(), p.coordinate) != seen.end()) continue;
        seen.push_back(p.coordinate);
        const std::string name = quantity_name(scene_, p.coordinate);
        if (p.coordinate.is_rotation())
          add(name, Kind::prescribed, "deg", units::kDegree, units::kDegree, "1 deg");
        else
          add_length(name, Kind::prescribed);
        out_.back().quantity = p.coordinate;
      }
    }
  }

  /// A ligament and a surface may have the same name: a prefix with the kind of object then distinguishes their
  /// parameters.
  void tell_apart() {
    std::map<std::string, int> count;
    for (const Parameter& p : out_) ++count[p.name];
    for (Parameter& p : out_) {
      if (count[p.name] == 1) continue;
      if (*p.group() != 0) p.name = std::string(p.group()) + "." + p.name;
    }
  }

  const SceneTables& scene_;
  int object_ = 0;
  std::vector<Parameter> out_;
};

/// f(object) for the object whose table the parameter names a row of; `none` where there is no table.
template <class SceneType, class F, class None>
auto with_table(SceneType& scene, const Parameter& p, const F& f, None none) {
  switch (p.kind) {
    case Kind::surface_number:
      return f(scene.surfaces[at(p.object)]);
    case Kind::load_number:
      return f(scene.loads[at(p.object)]);
    case Kind::body_number:
      return f(scene.bodies[at(p.object)]);
    case Kind::joint_number:
      return f(scene.joints[at(p.object)]);
    case Kind::bushing_number:
      return f(scene.bushings[at(p.object)]);
    default:
      return none;
  }
}

double* ligament_number(LigamentDef& l, const Parameter& p) {
  switch (p.kind) {
    case Kind::law_number:
      return &l.numbers[at(p.number)].value;
    case Kind::slack_length:
    case Kind::reference_strain:
    case Kind::reference_force:
      return &l.rest_value;
    case Kind::damping:
      return &l.damping;
    case Kind::from_point:
      return &l.from.point[p.component];
    case Kind::to_point:
      return &l.to.point[p.component];
    case Kind::via_point:
      return &l.via[at(p.component / 3)].point[p.component % 3];
    default:
      return nullptr;
  }
}

}  // namespace

const char* Parameter::group() const {
  return of_ligament()  ? "ligament"
         : of_surface() ? "surface"
         : of_load()    ? "load"
         : of_body()    ? "body"
         : of_joint()   ? "joint"
         : of_bushing() ? "bushing"
                        : "";
}

std::vector<Parameter> parameters_of(const SceneTables& scene) { return Parameters(scene).list(); }

double* parameter_number(SceneTables& scene, const Parameter& p) {
  if (p.of_ligament()) return ligament_number(scene.ligaments[at(p.object)], p);
  if (p.kind == Kind::term) return &scene.surfaces[at(p.object)].terms[at(p.component)].c;
  double* none = nullptr;
  return with_table(
      scene, p, [&](auto& def) { return kind_of(def).numbers[at(p.number)].values(def) + p.component; }, none);
}

const NumberRow* parameter_row(const SceneTables& scene, const Parameter& p) {
  if (p.kind == Kind::law_number) return &find_law(scene.ligaments[at(p.object)].law)->numbers[at(p.number)];
  const NumberRow* none = nullptr;
  return with_table(
      scene, p, [&](const auto& def) { return &kind_of(def).numbers[at(p.number)].row; }, none);
}

}  // namespace genu
