#include "genu/results/contact_columns.h"

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/results/columns.h"

namespace genu {

void ContactColumns::add_columns(ResultTable& table) const {
  for (std::size_t p = 0; p < model_.pairs.size(); ++p) {
    add_pair(model_.pairs[p].name, p, table);
    for (const RegionDef& region : scene_.contacts[p].regions) {
      const std::string name = model_.pairs[p].name + "." + region.name;
      table.add_column(name + ".force_N");
      table.add_column(name + ".points");
      for (const char* axis : kAxisNames) table.add_column(fmt::format("{}.{}_mm", name, axis));
    }
    for (int k = 1; numbers_[p] > 1 && k <= numbers_[p]; ++k)
      add_pair(fmt::format("{}.{}", model_.pairs[p].name, k), p, table);
  }
  for (const LayerDef& layer : scene_.layers) add_layer(layer, table);
}

void ContactColumns::set(ResultTable& table, const State& state, const std::vector<OpenContact>& open,
                         const std::vector<double>& pair_gap, const std::vector<LayerReport>& layers, bool forces,
                         const VecX* twist) {
  for (std::size_t p = 0; p < model_.pairs.size(); ++p)
    set_pair(p, contacts_of(p, state, open), pair_gap[p], forces, table);
  layer_memory_.resize(model_.layers.size());
  for (std::size_t k = 0; k < model_.layers.size(); ++k)
    set_layer(k,
              k < layers.size() ? layers[k]
                                : report_layer(model_, scene_.layers[k].pair.regions, state, static_cast<int>(k),
                                               layer_memory_[k], twist),
              table);
}

void ContactColumns::add_pair(const std::string& name, std::size_t pair, ResultTable& table) const {
  table.add_column(name + ".force_N");
  table.add_column(name + ".gap_mm");
  for (const bool b : {false, true})
    for (std::size_t i = 0; i < 3; ++i) table.add_column(name + "." + point_column(scene_, pair, b, i));
}

void ContactColumns::add_layer(const LayerDef& layer, ResultTable& table) const {
  const std::string& name = layer.pair.name;
  for (const LayerColumn& c : kLayerColumns) table.add_column(name + "." + c.name);
  for (const bool second : {false, true})
    for (std::size_t i = 0; i < 3; ++i) table.add_column(name + "." + centre_column(scene_, layer.pair, second, i));
  for (const RegionDef& region : layer.pair.regions) {
    const std::string part = name + "." + region.name + ".";
    for (const LayerColumn& c : kLayerColumns) table.add_column(part + c.name);
    for (const char* axis : kAxisNames) table.add_column(part + axis + "_mm");
  }
}

/// What takes a point on the body of a pair to the origin that the file knows.
const Vec3& ContactColumns::centre(std::size_t pair, bool second) const {
  return model_.bodies[at(second ? model_.pairs[pair].body_b : model_.pairs[pair].body_a)].centre;
}

/// Fills the six columns of a point, which follow those of force and gap (add_pair()), from `column` on.
void ContactColumns::set_point(std::size_t column, std::size_t pair, const Vec3& a, const Vec3& b,
                               ResultTable& table) const {
  for (const bool second : {false, true})
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      table.set(column++, to::kMillimetre * (second ? b : a)[axis] + to::kMillimetre * centre(pair, second)[axis]);
}

void ContactColumns::set_contact(const std::string& name, std::size_t pair, const Shown& c, ResultTable& table) const {
  const std::size_t first = table.column_index(name + ".force_N");
  table.set(first, c.force);
  table.set(first + 1, to::kMillimetre * c.gap);
  set_point(first + 2, pair, c.a, c.b, table);
}

ContactColumns::Contacts ContactColumns::contacts_of(std::size_t pair, const State& state,
                                                     const std::vector<OpenContact>& open) const {
  Contacts shown;
  const auto& p = model_.pairs[pair];
  const Pose &X_a = state.poses[at(p.body_a)], &X_b = state.poses[at(p.body_b)];
  for (const ActiveContact& c : state.contacts) {
    if (at(c.pair) != pair) continue;
    const double gap = (X_a.R * c.geometry.a.n).dot(X_b * c.geometry.b.p - X_a * c.geometry.a.p);
    shown[c.number] = {c.force, gap, c.geometry.a.p, c.geometry.b.p};
  }
  for (const OpenContact& c : open)
    if (at(c.pair) == pair) shown[c.number] = {0, c.gap, c.geometry.a.p, c.geometry.b.p};
  return shown;
}

void ContactColumns::set_pair(std::size_t pair, const Contacts& contacts, double gap, bool forces,
                              ResultTable& table) const {
  const std::string& name = model_.pairs[pair].name;
  Shown total{0, gap, Vec3::Zero(), Vec3::Zero()};
  const Shown* nearest = nullptr;
  for (const auto& [number, c] : contacts) {
    if (numbers_[pair] > 1) set_contact(fmt::format("{}.{}", name, number), pair, c, table);
    total.force += c.force;
    total.a += c.force * c.a;
    total.b += c.force * c.b;
    if (nearest == nullptr || c.gap < nearest->gap) nearest = &c;
  }
  const std::size_t first = table.column_index(name + ".force_N");
  if (forces) table.set(first, total.force);
  table.set(first + 1, to::kMillimetre * total.gap);
  if (total.force > 0)
    set_point(first + 2, pair, total.a / total.force, total.b / total.force, table);
  else if (nearest != nullptr)
    set_point(first + 2, pair, nearest->a, nearest->b, table);
  if (!forces) return;
  for (const RegionDef& region : scene_.contacts[pair].regions)
    set_region(name + "." + region.name, region, contacts, centre(pair, true), table);
}

void ContactColumns::set_region(const std::string& name, const RegionDef& region, const Contacts& contacts,
                                const Vec3& origin, ResultTable& table) const {
  double force = 0;
  long points = 0;
  Vec3 middle = Vec3::Zero();
  for (const auto& [number, c] : contacts) {
    if (!(c.force > 0) || !region.contains(c.b)) continue;
    force += c.force;
    middle += c.force * c.b;
    ++points;
  }
  table.set(name + ".force_N", force);
  table.set(name + ".points", points);
  for (Eigen::Index i = 0; points > 0 && i < 3; ++i)
    table.set(fmt::format("{}.{}_mm", name, kAxisNames[i]),
              to::kMillimetre * middle[i] / force + to::kMillimetre * origin[i]);
}

void ContactColumns::set_layer(std::size_t k, const LayerReport& report, ResultTable& table) const {
  const ContactDef& pair = scene_.layers[k].pair;
  for (const LayerColumn& c : kLayerColumns) table.set(pair.name + "." + c.name, c.value(report.total));
  for (std::size_t i = 0; report.total.touches() && i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    table.set(pair.name + "." + centre_column(scene_, pair, false, i), to::kMillimetre * report.total.centre_a[axis]);
    table.set(pair.name + "." + centre_column(scene_, pair, true, i), to::kMillimetre * report.total.centre[axis]);
  }
  for (std::size_t r = 0; r < pair.regions.size(); ++r) {
    const LayerTotals& totals = report.regions[r];
    const std::string part = pair.name + "." + pair.regions[r].name + ".";
    for (const LayerColumn& c : kLayerColumns) table.set(part + c.name, c.value(totals));
    for (Eigen::Index i = 0; totals.touches() && i < 3; ++i)
      table.set(part + kAxisNames[i] + "_mm", to::kMillimetre * totals.centre[i]);
  }
}

}  // namespace genu
