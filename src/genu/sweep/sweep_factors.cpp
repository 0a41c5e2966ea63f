#include "genu/sweep/sweep_factors.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "genu/assemble/parameter_values.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

/// All numbers of a scene that can be varied, and the names of those that cannot.
class Numbers {
 public:
  Numbers(const Prepared& scene, const TomlNode& document) : scene_(scene.source) {
    for (const Parameter& p : parameters_of(scene_)) add(p, document);
    for (const TomlNode& group : document.children)
      if (group.key == "contact")
        for (const TomlNode& contact : group.children) add_contact(contact);
  }

  struct Entry {
    VariedNumber number;
    std::string group, why_not;  ///< why_not: empty where it can be varied
  };

  bool names(const std::string& pattern, const Entry& entry) const {
    return matches(scene_, pattern, entry.number.name) ||
           matches(scene_, pattern, entry.group + "." + entry.number.name);
  }
  const std::vector<Entry>& entries() const { return entries_; }
  std::vector<std::string> known() const {
    std::vector<std::string> words;
    for (const Entry& entry : entries_)
      if (entry.why_not.empty()) words.push_back(entry.number.name);
    return words;
  }

 private:
  void add(const Parameter& p, const TomlNode& document) {
    Entry entry{{p.name, p, 1, 0, {}}, p.group(), {}};
    const double* number = parameter_number(scene_, p);
    const bool surface = p.kind == Parameter::Kind::surface_number || p.kind == Parameter::Kind::term;
    if (number == nullptr && !surface) {
      entry.why_not = "is no number of the file's tables: change it in the steps or surfaces of the scene";
    } else {
      const ParameterPlace place = parameter_place(scene_, p, document);
      if (place.node == nullptr)
        entry.why_not = "is not given in the file (" + place.key + "): write its value there";
      else
        entry.number.where = place.node->where;
      if (surface)
        entry.number.parameter.reset();
      else
        entry.number.unit = place.file_unit, entry.number.base = *number / place.file_unit;
    }
    entries_.push_back(std::move(entry));
  }

  void add_contact(const TomlNode& contact) {
    const TomlNode* enabled = contact.member("enabled");
    if (enabled != nullptr && !enabled->boolean) return;
    for (const TomlNode& number : contact.children)
      if (number.kind == TomlNode::Kind::integer || number.kind == TomlNode::Kind::floating)
        entries_.push_back({{contact.key + "." + number.key, std::nullopt, 1, 0, number.where}, "contact", {}});
  }

  Scene scene_;  // a copy: parameter_number() gives numbers that may be written
  std::vector<Entry> entries_;
};

/// The smallest number that a factor gives to a parameter, in the file's unit.
double smallest_of(const VariedNumber& number, const VaryDef& vary) {
  return number_at(number, vary.how, vary.distribution.smallest());
}

void check_positive(const SweepDef& sweep, const VariedNumber& number, const VaryDef& vary, Diagnostics& out) {
  if (vary.distribution.kind == Distribution::Kind::given || !number.parameter || !number.parameter->positive) return;
  const double least = smallest_of(number, vary);
  if (least > 0) return;
  out.add(error_at({sweep.file, vary.where}, Code::out_of_range, "vary." + vary.name, {},
                   fmt::format("gives {} numbers down to {:.4g}, and it must be > 0: use lognormal, or truncated = "
                               "[low, high]",
                               number.name, least)));
}

std::string scene_words(const SweepDef& sweep, const Prepared& scene) {
  return sweep.scenes.size() == 1 ? "this scene" : scene.source.file;
}

/// The numbers that an entry names. Without any the reason is in `out`.
std::vector<VariedNumber> numbers_of(const SweepDef& sweep, const VaryDef& vary, const Numbers& numbers,
                                     const Prepared& scene, Diagnostics& out) {
  std::vector<VariedNumber> found;
  for (const std::string& pattern : vary.patterns) {
    const std::size_t before = found.size();
    std::string why_not;
    for (const Numbers::Entry& entry : numbers.entries()) {
      if (!numbers.names(pattern, entry)) continue;
      if (entry.why_not.empty())
        found.push_back(entry.number);
      else
        why_not = entry.number.name + " " + entry.why_not;
    }
    if (found.size() > before) continue;
    out.add(error_at({sweep.file, vary.where}, why_not.empty() ? Code::unknown_name : Code::not_applicable,
                     "vary." + vary.name, with_quotes(pattern),
                     why_not.empty()
                         ? "is no number of " + scene_words(sweep, scene) + did_you_mean(pattern, numbers.known()) +
                               " (names as of genu sensitivity and --set: AAC.stiffness, push.force.z)"
                         : why_not));
  }
  return found;
}

/// What moves the mesh of a surface; the reason in `out` where nothing is known of it.
std::optional<MeshNoise> noise_of(const SweepDef& sweep, const VaryDef& vary, const Prepared& scene,
                                  std::size_t surface, Diagnostics& out) {
  const double unit = scene.source.length_unit;
  if (!vary.mesh_error->estimated)
    return MeshNoise{unit * vary.mesh_error->sd, unit * vary.mesh_error->correlation_length};
  const auto& blend = scene.notes[surface].blend;
  if (blend && blend->facts().noise.rms > 0) return blend->facts().noise;
  out.add(
      error_at({sweep.file, vary.where}, Code::not_applicable, "vary." + vary.name + ".estimated", "true",
               blend ? "sees no error in the mesh of " + scene.notes[surface].name + ": give sd and correlation_length"
                     : "is known of smooth surfaces, and " + scene.notes[surface].name +
                           " is used as triangles: give sd and correlation_length"));
  return std::nullopt;
}

/// The meshes that an entry names. Without any the reason is in `out`.
std::vector<VariedNumber> meshes_of(const SweepDef& sweep, const VaryDef& vary, const Prepared& scene,
                                    Diagnostics& out) {
  std::vector<VariedNumber> found;
  for (const std::string& pattern : vary.patterns) {
    bool any = false;
    std::vector<std::string> known;
    for (std::size_t k = 0; k < scene.source.surfaces.size(); ++k) {
      const SurfaceDef& def = scene.source.surfaces[k];
      if (def.shape != SurfaceDef::Shape::mesh) continue;
      known.push_back(def.name + kMeshError);
      if (!matches(pattern, known.back())) continue;
      any = true;
      if (const auto noise = noise_of(sweep, vary, scene, k, out))
        found.push_back({known.back(), std::nullopt, 1, 0, {}, static_cast<int>(k), *noise});
    }
    if (any) continue;
    out.add(error_at({sweep.file, vary.where}, Code::unknown_name, "vary." + vary.name, with_quotes(pattern),
                     known.empty() ? "names a mesh, and " + scene_words(sweep, scene) + " has none"
                                   : "is no mesh of " + scene_words(sweep, scene) + did_you_mean(pattern, known) +
                                         " (the name of a surface and .mesh_error)"));
  }
  return found;
}

template <class F>
bool any_number(const SceneFactors& scene, const F& f) {
  return std::any_of(scene.numbers.begin(), scene.numbers.end(),
                     [&](const auto& list) { return std::any_of(list.begin(), list.end(), f); });
}

}  // namespace

bool SceneFactors::prepares_anew() const {
  return any_number(*this, [](const VariedNumber& n) { return !n.parameter; });
}

bool SceneFactors::moves_start() const {
  return any_number(*this, [](const VariedNumber& n) { return n.parameter && n.parameter->of_joint(); });
}

SceneFactors find_factors(const SweepDef& sweep, const Prepared& scene, const TomlNode& document, Diagnostics& out) {
  SceneFactors result;
  const Numbers numbers(scene, document);
  std::map<std::string, std::string> taken;  // number -> entry
  for (std::size_t v = 0; v < sweep.vary.size(); ++v) {
    const VaryDef& vary = sweep.vary[v];
    std::vector<VariedNumber> found =
        vary.mesh_error ? meshes_of(sweep, vary, scene, out) : numbers_of(sweep, vary, numbers, scene, out);
    for (const VariedNumber& number : found) {
      check_positive(sweep, number, vary, out);
      const auto [other, added] = taken.emplace(number.name, vary.name);
      if (!added)
        out.add(error_at({sweep.file, vary.where}, Code::duplicate, "vary." + vary.name, {},
                         "moves " + number.name + ", which " + with_quotes(other->second) + " moves already"));
    }
    if (vary.together) {
      result.factors.push_back({vary.name, v, vary.mesh_error.has_value()});
      result.numbers.push_back(std::move(found));
      continue;
    }
    for (VariedNumber& number : found) {
      result.factors.push_back({number.name, v, vary.mesh_error.has_value()});
      result.numbers.push_back({std::move(number)});
    }
  }
  return result;
}

SceneFactors factors_of_what_if(const SceneFactors& as_it_is, const Prepared& scene, const TomlNode& document) {
  SceneFactors result;
  result.factors = as_it_is.factors;
  const Numbers numbers(scene, document);
  for (std::size_t f = 0; f < as_it_is.factors.size(); ++f) {
    result.numbers.emplace_back();
    for (const VariedNumber& wanted : as_it_is.numbers[f]) {
      for (std::size_t k = 0; wanted.surface >= 0 && k < scene.source.surfaces.size(); ++k)
        if (scene.source.surfaces[k].name + kMeshError == wanted.name) {
          result.numbers.back().push_back(wanted);
          result.numbers.back().back().surface = static_cast<int>(k);  // a body that is left out had others
        }
      for (const Numbers::Entry& entry : numbers.entries())
        if (wanted.surface < 0 && entry.number.name == wanted.name && entry.why_not.empty())
          result.numbers.back().push_back(entry.number);
    }
  }
  return result;
}

double number_at(const VariedNumber& number, VaryDef::How how, double draw) {
  return how == VaryDef::How::relative ? number.base * draw : how == VaryDef::How::added ? number.base + draw : draw;
}

std::string set_option(const VariedNumber& number, VaryDef::How how, double draw) {
  if (number.parameter) return fmt::format("{}={}", number.name, number_at(number, how, draw));
  const char* sign = how == VaryDef::How::relative ? "x" : how == VaryDef::How::added ? "+" : "";
  return fmt::format("{}={}{}", number.name, sign, draw);
}

}  // namespace genu
