#include "genu/api/scene_inside.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/api/own_law.h"
#include "genu/assemble/with_numbers.h"
#include "genu/model/generalised_forces.h"
#include "genu/scene/centre_bodies.h"
#include "genu/scene/words.h"

namespace genu::api {

Scene::Inside::Inside(genu::Scene read, std::shared_ptr<MeshLibrary> library)
    : source(std::move(read)), meshes(std::move(library)) {
  Diagnostics out;
  ready = prepared(out);
  warnings = problems_of(out);
  numbers = std::make_shared<const SceneNumbers>(source);
}

/// Prepares the scene from its definition, as what is shared from now on.
std::shared_ptr<Ready> Scene::Inside::prepared(Diagnostics& out) {
  auto made = prepare(source, meshes, out);
  check(out);
  base = std::make_shared<Ready>();
  base->prepared = std::move(*made);
  share_search(base->prepared);
  other_surfaces = moved_points = false;
  return base;
}

bool Scene::Inside::shares_base() const {
  if (other_surfaces) return false;
  if (!moved_points) return true;
  const auto all_zero = [](const std::vector<Vec3>& origins) {
    return std::all_of(origins.begin(), origins.end(), [](const Vec3& o) { return o.isZero(0); });
  };
  return all_zero(base->prepared.scene.origins) && all_zero(choose_origins(source));
}

void Scene::Inside::put_laws(JointModel& model) const {
  for (JointModel::Ligament& ligament : model.ligaments)
    if (const auto own = laws.find(ligament.name); own != laws.end()) ligament.law = own->second;
}

std::shared_ptr<Ready> Scene::Inside::assembled() {
  if (ready) return ready;
  Diagnostics out;
  std::optional<Prepared> made;
  if (!shares_base()) {
    made = prepared(out)->prepared;
    warnings = problems_of(out);
    made->model.meter = std::make_shared<EffectMeter>();
  } else {
    made = with_scene(base->prepared, source, out);
    check(out);
  }
  auto built = std::make_shared<Ready>();
  built->prepared = std::move(*made);
  put_laws(built->prepared.model);
  return ready = std::move(built);
}

Scene::Scene(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
Scene::Scene(const Scene& other) : inside_(std::make_unique<Inside>(*other.inside_)) {}
Scene::Scene(Scene&& other) noexcept = default;
Scene::~Scene() = default;
Scene& Scene::operator=(Scene other) noexcept {
  inside_.swap(other.inside_);
  return *this;
}

namespace {

template <class Defs>
std::vector<std::string> names_in(const Defs& defs) {
  std::vector<std::string> names;
  for (const auto& def : defs) names.push_back(def.name);
  return names;
}

}  // namespace

const std::string& Scene::title() const { return inside_->source.title; }
const std::string& Scene::file() const { return inside_->source.file; }
std::vector<std::string> Scene::bodies() const { return names_in(inside_->source.bodies); }
std::vector<std::string> Scene::joints() const { return names_in(inside_->source.joints); }
std::vector<std::string> Scene::surfaces() const { return names_in(inside_->source.surfaces); }
std::vector<std::string> Scene::ligaments() const { return names_in(inside_->source.ligaments); }
std::vector<std::string> Scene::loads() const { return names_in(inside_->source.loads); }
std::vector<std::string> Scene::contacts() const {
  std::vector<std::string> names = names_in(inside_->source.contacts);
  for (const LayerDef& layer : inside_->source.layers) names.push_back(layer.pair.name);
  return names;
}
std::vector<std::string> Scene::coordinates() const {
  std::vector<std::string> names;
  for (const CoordinateRef& c : free_coordinates(inside_->base->prepared.model))
    names.push_back(coordinate_name(inside_->source, c));
  return names;
}
const std::vector<Problem>& Scene::warnings() const { return inside_->warnings; }

std::vector<std::string> Scene::changes() const {
  std::vector<std::string> out = inside_->other_changes;
  for (const auto& [name, change] : inside_->changed)
    if (change.now != change.before)
      out.push_back(fmt::format("{} = {:.6g}{} ({:.6g})", name, change.now, change.unit == "1" ? "" : " " + change.unit,
                                change.before));
  return out;
}

std::vector<Number> Scene::numbers(const std::string& pattern) const {
  std::vector<Number> out;
  for (const SceneNumber* n : inside_->numbers->matching(pattern))
    out.push_back({n->name, n->unit, *n->place(inside_->source) / n->si});
  return out;
}

double Scene::value(const std::string& name) const {
  const auto found = inside_->numbers->matching(name);
  if (found.size() != 1)
    refuse(Code::wrong_form, "number", with_quotes(name), fmt::format("means {} numbers, not one", found.size()));
  return *found.front()->place(inside_->source) / found.front()->si;
}

void Scene::set(const std::string& pattern, double value) {
  const std::size_t count = inside_->numbers->matching(pattern).size();
  set(pattern, std::vector<double>(count, value));
}

void Scene::set(const std::string& pattern, std::span<const double> values) {
  const auto found = inside_->numbers->matching(pattern);
  if (values.size() != found.size())
    refuse(Code::wrong_form, "number", with_quotes(pattern),
           fmt::format("means {} numbers, and {} values are given", found.size(), values.size()));
  std::vector<double> before;
  for (std::size_t k = 0; k < found.size(); ++k) {
    double& place = *found[k]->place(inside_->source);
    before.push_back(place);
    place = values[k] * found[k]->si;
  }
  for (std::size_t k = 0; k < found.size(); ++k) {
    const std::string why = found[k]->fault(inside_->source);
    if (why.empty()) continue;
    for (std::size_t i = 0; i < found.size(); ++i) *found[i]->place(inside_->source) = before[i];
    refuse(Code::out_of_range, found[k]->name, fmt::format("{:.6g}", values[k]), why);
  }
  for (std::size_t k = 0; k < found.size(); ++k) {
    auto [change, fresh] = inside_->changed.try_emplace(found[k]->name);
    if (fresh) change->second = {before[k] / found[k]->si, 0, found[k]->unit};
    change->second.now = values[k];
    inside_->other_surfaces |= found[k]->moves_surfaces;
    inside_->moved_points |= found[k]->moves_points;
  }
  inside_->forget();
}

void Scene::set_law(const std::string& ligament, const Law& law) {
  const std::vector<std::string> known = ligaments();
  if (std::find(known.begin(), known.end(), ligament) == known.end())
    refuse(Code::unknown_name, "ligament", with_quotes(ligament),
           "is no ligament of this scene" + did_you_mean(ligament, known));
  inside_->laws.insert_or_assign(ligament, law_of(ligament, law));
  inside_->other_changes.push_back("a law of its own for " + ligament);
  inside_->forget();
}

Scene Scene::without(const std::string& pattern) const {
  Scene other = *this;
  Inside& in = *other.inside_;
  std::string what;
  bool contacts = false;
  leave_out(pattern, in.source, what, contacts);
  in.other_changes.push_back("without " + pattern + ": " + what);
  in.other_surfaces |= contacts;
  in.moved_points = true;
  in.numbers = std::make_shared<const SceneNumbers>(in.source);
  in.forget();
  return other;
}

}  // namespace genu::api
