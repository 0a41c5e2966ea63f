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

class Parameters {
 public:
  explicit Parameters(const SceneTables& scene) : scene_(scene) {}

  std::vector<Parameter> list() {
    for (object_ = 0; object_ < static_cast<int>(scene_.ligaments.size()); ++object_)
      add_ligament(scene_.ligaments[index()]);
    for (object_ = 0; object_ < static_cast<int>(scene_.surfaces.size()); ++object_)
      add_surface(scene_.surfaces[index()]);
    for (object_ = 0; object_ < static_cast<int>(scene_.loads.size()); ++object_) add_load(scene_.loads[index()]);
    for (object_ = 0; object_ < static_cast<int>(scene_.bodies.size()); ++object_) add_weight(scene_.bodies[index()]);
    for (object_ = 0; object_ < static_cast<int>(scene_.joints.size()); ++object_) add_joint(scene_.joints[index()]);
    add_prescribed();
    tell_apart();
    return std::move(out_);
  }

 private:
  std::size_t index() const { return static_cast<std::size_t>(object_); }

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
  void add_strain(const std::string& name, Kind kind) { add(name, kind, "1", 1, kStrainChange, "0.01"); }
  void add_force(const std::string& name, Kind kind, int component = 0) {
    add(name, kind, "N", 1, 1, "1 N").component = component;
  }
  void add_moment(const std::string& name, Kind kind, int component = 0) {
    add(name, kind, "Nm", 1, kMomentChange, "0.01 Nm").component = component;
  }

  void add_law_numbers(const LigamentDef& l) {
    for (std::size_t k = 0; k < l.numbers.size(); ++k) {
      const LawNumber& number = find_law(l.law)->numbers[k];
      const std::string name = l.name + "." + number.key;
      const std::string unit = number.unit == LawNumber::Unit::number ? "1" : number.unit_name("mm");
      if (number.unit == LawNumber::Unit::strain)
        add_strain(name, Kind::law_number);
      else
        add_share(name, Kind::law_number, unit, number.si(units::kMillimetre), l.numbers[k].value);
      out_.back().component = static_cast<int>(k);
    }
  }

  void add_ligament(const LigamentDef& l) {
    add_law_numbers(l);
    switch (l.rest) {
      case LigamentDef::Rest::slack_length:
        add_share(l.name + ".slack_length", Kind::slack_length, "mm", units::kMillimetre, l.rest_value);
        break;
      case LigamentDef::Rest::reference_strain:
        add_strain(l.name + ".reference_strain", Kind::reference_strain);
        break;
      case LigamentDef::Rest::reference_force:
        add_force(l.name + ".reference_force", Kind::reference_force);
        break;
    }
    if (l.damping > 0) add_share(l.name + ".damping", Kind::damping, "N s/mm", 1e3, l.damping);
    add_point(l.name + ".from", Kind::from_point);
    add_point(l.name + ".to", Kind::to_point);
    for (int k = 0; k < 3 * static_cast<int>(l.via.size()); ++k)
      add_length(fmt::format("{}.via.{}.{}", l.name, k / 3 + 1, kAxes[k % 3]), Kind::via_point, k);
  }

  void add_surface(const SurfaceDef& s) {
    using Shape = SurfaceDef::Shape;
    if (s.shape == Shape::sphere || s.shape == Shape::cylinder) add_length(s.name + ".radius", Kind::radius);
    if (s.shape == Shape::ellipsoid) add_point(s.name + ".radii", Kind::radii);
    if (s.shape == Shape::torus) {
      add_length(s.name + ".major_radius", Kind::major_radius);
      add_length(s.name + ".minor_radius", Kind::minor_radius);
    }
    if (s.shape == Shape::polynomial || s.shape == Shape::cylindrical_polynomial) add_terms(s);
    add_point(s.name + ".origin", Kind::origin);
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
    switch (l.kind) {
      case LoadDef::Kind::wrench:
        for (int i = 0; i < 3; ++i) add_force(l.name + ".force." + kAxes[i], Kind::force, i);
        for (int i = 0; i < 3; ++i) add_moment(l.name + ".moment." + kAxes[i], Kind::moment, i);
        add_point(l.name + ".point", Kind::point);
        break;
      case LoadDef::Kind::toward:
        add_force(l.name + ".magnitude", Kind::magnitude);
        add_point(l.name + ".point", Kind::point);
        add_point(l.name + ".toward", Kind::toward_point);
        break;
      case LoadDef::Kind::coordinate:
        l.coordinate.index < 3 ? add_moment(l.name + ".value", Kind::magnitude)
                               : add_force(l.name + ".value", Kind::magnitude);
        break;
    }
    add_share(l.name + ".factor", Kind::factor, "1", 1, 1);
  }

  void add_weight(const BodyDef& b) {
    if (!(scene_.gravity || scene_.dynamics) || b.fixed || !(b.mass > 0)) return;
    add_share(b.name + ".mass", Kind::mass, "kg", 1, b.mass);
    add_point(b.name + ".centre_of_mass", Kind::centre_of_mass);
  }

  void add_joint(const JointDef& j) {
    if (j.stiffness > 0)
      add_share(j.name + ".stiffness", Kind::joint_stiffness, "Nm/deg", 1 / units::kDegree, j.stiffness);
    if (j.damping > 0) add_share(j.name + ".damping", Kind::joint_damping, "Nm s/deg", 1 / units::kDegree, j.damping);
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
      const char* kind = p.of_ligament()              ? "ligament."
                         : p.of_surface()             ? "surface."
                         : p.of_load()                ? "load."
                         : p.of_joint()               ? "joint."
                         : p.kind == Kind::prescribed ? ""
                                                      : "body.";
      p.name = kind + p.name;
    }
  }

  const SceneTables& scene_;
  int object_ = 0;
  std::vector<Parameter> out_;
};

}  // namespace

std::vector<Parameter> parameters_of(const SceneTables& scene) { return Parameters(scene).list(); }

}  // namespace genu
