#include "genu/results/pose_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "genu/model/grood_suntay.h"
#include "genu/model/ligament_pieces.h"
#include "genu/results/columns.h"

namespace genu {
namespace {

constexpr double kMillimetre = 1e3;
constexpr double kDegree = 180 / M_PI;
constexpr const char* kAxes[] = {"x", "y", "z"};

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double shown(const QuantityRef& c, double value) { return value * (c.is_rotation() ? kDegree : kMillimetre); }

/// A contact point as shown: held or open.
struct ShownContact {
  double force = 0, gap = 0;
  Vec3 a, b;
};

class PoseTable {
 public:
  PoseTable(const Scene& scene, const JointModel& model, const std::vector<StepPlan>& steps,
            const std::vector<PoseRecord>& records)
      : scene_(scene), model_(model) {
    count_contacts(records);
    add_columns(steps);
    if (std::any_of(records.begin(), records.end(), [](const PoseRecord& r) { return r.given.has_value(); }))
      add_residual_columns();
    for (const PoseRecord& record : records) add_row(record);
  }
  ResultTable take() { return std::move(table_); }

 private:
  void count_contacts(const std::vector<PoseRecord>& records) {
    numbers_.assign(model_.pairs.size(), 0);
    for (const PoseRecord& r : records)
      for (std::size_t p = 0; p < r.point.pose.last_number.size(); ++p)
        numbers_[p] = std::max(numbers_[p], r.point.pose.last_number[p]);
  }

  void add_columns(const std::vector<StepPlan>& steps) {
    for (const char* name : {"step", "increment", "time_s", "status"}) table_.add_column(name);
    for (int j = 0; j < static_cast<int>(scene_.joints.size()); ++j) {
      const JointDef& joint = scene_.joints[at(j)];
      for (int i = 0; i < 6; ++i)
        if (joint.leaves(i)) table_.add_column(coordinate_column(scene_, {j, i}));
      for (int i = 0; i < 6; ++i) add_reaction(steps, {j, i});
      for (std::size_t i = 0; joint.type != JointDef::Type::free && i < 6; ++i)
        table_.add_column(held_column(joint.name, i));
      for (std::size_t i = 0; joint.grood_suntay && i < kClinical.size(); ++i)
        table_.add_column(clinical_column(joint.name, i));
    }
    for (int k = 0; k < static_cast<int>(scene_.combinations.size()); ++k) {
      const QuantityRef quantity{scene_.combinations[at(k)].terms.front().coordinate, k};
      table_.add_column(coordinate_column(scene_, quantity));
      add_reaction(steps, quantity);
    }
    for (std::size_t p = 0; p < model_.pairs.size(); ++p) {
      add_contact_columns(model_.pairs[p].name, p);
      for (const RegionDef& region : scene_.contacts[p].regions) {
        const std::string name = model_.pairs[p].name + "." + region.name;
        table_.add_column(name + ".force_N");
        table_.add_column(name + ".points");
        for (const char* axis : kAxes) table_.add_column(fmt::format("{}.{}_mm", name, axis));
      }
      for (int k = 1; numbers_[p] > 1 && k <= numbers_[p]; ++k)
        add_contact_columns(fmt::format("{}.{}", model_.pairs[p].name, k), p);
    }
    for (const LayerDef& layer : scene_.layers) add_layer_columns(layer);
    for (const auto& l : model_.ligaments)
      for (const char* quantity : {"length_mm", "strain", "force_N"}) table_.add_column(l.name + "." + quantity);
    for (const Load& l : model_.loads)
      if (l.scale) table_.add_column(l.name + ".scale");
    for (std::size_t i = 0; i < model_.loads.size(); ++i)
      if (varies(steps, i)) table_.add_column(model_.loads[i].name + ".factor");
    for (const char* name : {"stability.min_eigenvalue_Nmm", "stability", "newton.iterations", "residual"})
      table_.add_column(name);
  }

  void add_residual_columns() {
    for (const auto& body : model_.bodies)
      for (std::size_t i = 0; body.moving >= 0 && i < 6; ++i) table_.add_column(residual_column(body.name, i));
  }

  void add_reaction(const std::vector<StepPlan>& steps, const QuantityRef& quantity) {
    for (const StepPlan& step : steps)
      for (const auto& p : step.prescribed)
        if (p.coordinate == quantity) table_.add_column(reaction_column(scene_, quantity));
  }

  void add_contact_columns(const std::string& name, std::size_t pair) {
    table_.add_column(name + ".force_N");
    table_.add_column(name + ".gap_mm");
    for (const bool b : {false, true})
      for (std::size_t i = 0; i < 3; ++i) table_.add_column(name + "." + point_column(scene_, pair, b, i));
  }

  void add_layer_columns(const LayerDef& layer) {
    const std::string& name = layer.pair.name;
    for (const LayerColumn& c : kLayerColumns) table_.add_column(name + "." + c.name);
    for (const bool second : {false, true})
      for (std::size_t i = 0; i < 3; ++i) table_.add_column(name + "." + centre_column(scene_, layer.pair, second, i));
    for (const RegionDef& region : layer.pair.regions) {
      const std::string part = name + "." + region.name + ".";
      for (const LayerColumn& c : kLayerColumns) table_.add_column(part + c.name);
      for (const char* axis : kAxes) table_.add_column(part + axis + "_mm");
    }
  }

  void add_row(const PoseRecord& record) {
    const PosePoint& point = record.point;
    table_.add_row();
    table_.set("step", static_cast<long>(point.step));
    table_.set("increment", static_cast<long>(point.increment));
    table_.set("time_s", point.target.time);
    table_.set("status", std::string(to_string(point.report.status)));
    if (record.pair_gap.size() != model_.pairs.size() || point.pose.state.poses.empty()) {
      for (const auto& p : point.target.prescribed)
        table_.set(coordinate_column(scene_, p.coordinate), shown(p.coordinate, p.value));
      set_factors(point.target);
      return;
    }
    set_coordinates(record);
    set_factors(point.target);
    for (std::size_t p = 0; p < model_.pairs.size(); ++p) set_pair(p, record);
    for (int k = 0; k < static_cast<int>(model_.layers.size()); ++k) set_layer(k, point.pose.state);
    set_ligaments(point);
    for (const Load& l : model_.loads)
      if (l.scale) table_.set(l.name + ".scale", load_scale(l, point.pose.state, point.target.time).factor);
    if (record.given) return set_residual(*record.given);
    table_.set("stability.min_eigenvalue_Nmm", point.stability.smallest * kMillimetre);
    const Stability& stability = point.stability;
    table_.set("stability", std::string(stability.flutter ? "flutter" : to_string(stability.verdict)));
    table_.set("newton.iterations", static_cast<long>(point.report.iterations));
    table_.set("residual", point.report.certificate.residual);
  }

  void set_residual(const PoseRecord::Given& given) {
    for (const auto& body : model_.bodies)
      for (std::size_t i = 0; body.moving >= 0 && i < 6; ++i)
        table_.set(residual_column(body.name, i), given.missing[at(body.moving)][static_cast<Eigen::Index>(i)]);
  }

  static bool varies(const std::vector<StepPlan>& steps, std::size_t load) {
    return std::any_of(steps.begin(), steps.end(), [&](const StepPlan& s) {
      return load < s.factors.size() && s.factors[load].from != s.factors[load].to;
    });
  }

  void set_factors(const Target& target) {
    for (std::size_t i = 0; i < target.load_factors.size(); ++i)
      if (const std::string name = model_.loads[i].name + ".factor"; table_.has_column(name))
        table_.set(name, target.load_factors[i]);
  }

  void set_coordinates(const PoseRecord& record) {
    const PosePoint& point = record.point;
    const State& state = point.pose.state;
    const bool reactions = !record.given || record.given->reactions;
    for (int j = 0; j < static_cast<int>(state.coordinates.size()); ++j)
      for (int i = 0; i < 6; ++i)
        if (scene_.joints[at(j)].leaves(i))
          table_.set(coordinate_column(scene_, {j, i}), shown({j, i}, state.coordinates[at(j)][at(i)]));
    for (int k = 0; k < static_cast<int>(scene_.combinations.size()); ++k) {
      const QuantityRef quantity{scene_.combinations[at(k)].terms.front().coordinate, k};
      table_.set(coordinate_column(scene_, quantity),
                 shown(quantity, quantity_value(model_, state.coordinates, quantity)));
    }
    for (std::size_t m = 0; reactions && m < point.target.prescribed.size(); ++m)
      table_.set(reaction_column(scene_, point.target.prescribed[m].coordinate), state.multipliers[m]);
    for (std::size_t j = 0; j < model_.joints.size(); ++j) {
      if (reactions && scene_.joints[j].type != JointDef::Type::free) set_held(static_cast<int>(j), point);
      if (scene_.joints[j].grood_suntay) set_clinical(scene_.joints[j], state);
    }
  }

  void set_clinical(const JointDef& joint, const State& state) {
    const GroodSuntayDef& def = *joint.grood_suntay;
    const auto motion = grood_suntay(def, state.poses[at(def.femur.body)], state.poses[at(def.tibia.body)]);
    if (!motion) return;
    const double values[] = {kDegree * motion->flexion,           kDegree * motion->adduction,
                             kDegree * motion->external_rotation, kMillimetre * motion->lateral,
                             kMillimetre * motion->anterior,      kMillimetre * motion->distraction};
    for (std::size_t i = 0; i < kClinical.size(); ++i) table_.set(clinical_column(joint.name, i), values[i]);
  }

  void set_held(int joint, const PosePoint& point) {
    const Vec6 wrench = joint_reaction(model_, point.pose.state, joint);
    for (std::size_t i = 0; i < 6; ++i)
      table_.set(held_column(model_.joints[at(joint)].name, i), wrench[static_cast<Eigen::Index>(i)]);
  }

  /// What takes a point on the body of a pair to the origin that the file knows.
  const Vec3& centre(std::size_t pair, bool second) const {
    return model_.bodies[at(second ? model_.pairs[pair].body_b : model_.pairs[pair].body_a)].centre;
  }

  void set_point(const std::string& name, std::size_t pair, const Vec3& a, const Vec3& b) {
    for (const bool second : {false, true})
      for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = static_cast<Eigen::Index>(i);
        table_.set(name + "." + point_column(scene_, pair, second, i),
                   kMillimetre * (second ? b : a)[axis] + kMillimetre * centre(pair, second)[axis]);
      }
  }

  void set_contact(const std::string& name, std::size_t pair, const ShownContact& c) {
    table_.set(name + ".force_N", c.force);
    table_.set(name + ".gap_mm", kMillimetre * c.gap);
    set_point(name, pair, c.a, c.b);
  }

  std::map<int, ShownContact> contacts_of(std::size_t pair, const PosePoint& point) const {
    std::map<int, ShownContact> shown_contacts;
    const auto& p = model_.pairs[pair];
    const Pose &X_a = point.pose.state.poses[at(p.body_a)], &X_b = point.pose.state.poses[at(p.body_b)];
    for (const ActiveContact& c : point.pose.state.contacts) {
      if (at(c.pair) != pair) continue;
      const double gap = (X_a.R * c.geometry.a.n).dot(X_b * c.geometry.b.p - X_a * c.geometry.a.p);
      shown_contacts[c.number] = {c.force, gap, c.geometry.a.p, c.geometry.b.p};
    }
    for (const OpenContact& c : point.pose.open)
      if (at(c.pair) == pair) shown_contacts[c.number] = {0, c.gap, c.geometry.a.p, c.geometry.b.p};
    return shown_contacts;
  }

  void set_pair(std::size_t pair, const PoseRecord& record) {
    const std::string& name = model_.pairs[pair].name;
    const auto contacts = contacts_of(pair, record.point);
    ShownContact total{0, record.pair_gap[pair], Vec3::Zero(), Vec3::Zero()};
    const ShownContact* nearest = nullptr;
    for (const auto& [number, c] : contacts) {
      if (numbers_[pair] > 1) set_contact(fmt::format("{}.{}", name, number), pair, c);
      total.force += c.force;
      total.a += c.force * c.a;
      total.b += c.force * c.b;
      if (nearest == nullptr || c.gap < nearest->gap) nearest = &c;
    }
    if (!record.given) table_.set(name + ".force_N", total.force);
    table_.set(name + ".gap_mm", kMillimetre * total.gap);
    if (total.force > 0)
      set_point(name, pair, total.a / total.force, total.b / total.force);
    else if (nearest != nullptr)
      set_point(name, pair, nearest->a, nearest->b);
    if (record.given) return;
    for (const RegionDef& region : scene_.contacts[pair].regions)
      set_region(name + "." + region.name, region, contacts, centre(pair, true));
  }

  void set_region(const std::string& name, const RegionDef& region, const std::map<int, ShownContact>& contacts,
                  const Vec3& origin) {
    double force = 0;
    long points = 0;
    Vec3 centre = Vec3::Zero();
    for (const auto& [number, c] : contacts) {
      if (!(c.force > 0) || !region.contains(c.b)) continue;
      force += c.force;
      centre += c.force * c.b;
      ++points;
    }
    table_.set(name + ".force_N", force);
    table_.set(name + ".points", points);
    for (Eigen::Index i = 0; points > 0 && i < 3; ++i)
      table_.set(fmt::format("{}.{}_mm", name, kAxes[i]), kMillimetre * centre[i] / force + kMillimetre * origin[i]);
  }

  void set_layer(int k, const State& state) {
    const ContactDef& pair = scene_.layers[at(k)].pair;
    layer_memory_.resize(model_.layers.size());
    const LayerReport report = report_layer(model_, pair.regions, state, k, layer_memory_[at(k)]);
    for (const LayerColumn& c : kLayerColumns) table_.set(pair.name + "." + c.name, c.value(report.total));
    for (std::size_t i = 0; report.total.touches() && i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      table_.set(pair.name + "." + centre_column(scene_, pair, false, i), kMillimetre * report.total.centre_a[axis]);
      table_.set(pair.name + "." + centre_column(scene_, pair, true, i), kMillimetre * report.total.centre[axis]);
    }
    for (std::size_t r = 0; r < pair.regions.size(); ++r) {
      const LayerTotals& totals = report.regions[r];
      const std::string part = pair.name + "." + pair.regions[r].name + ".";
      for (const LayerColumn& c : kLayerColumns) table_.set(part + c.name, c.value(totals));
      for (Eigen::Index i = 0; totals.touches() && i < 3; ++i)
        table_.set(part + kAxes[i] + "_mm", kMillimetre * totals.centre[i]);
    }
  }

  void set_ligaments(const PosePoint& point) {
    for (std::size_t i = 0; i < model_.ligaments.size(); ++i) {
      const std::string& name = model_.ligaments[i].name;
      const LigamentShown shown_ligament = show_ligament(model_, point.pose.state, static_cast<int>(i));
      table_.set(name + ".length_mm", kMillimetre * shown_ligament.length);
      table_.set(name + ".strain", shown_ligament.strain);
      table_.set(name + ".force_N", shown_ligament.force);
    }
  }

  const Scene& scene_;
  const JointModel& model_;
  std::vector<int> numbers_;
  std::vector<ElasticLayer::Memory> layer_memory_;
  ResultTable table_;
};

}  // namespace

ResultTable pose_table(const Scene& scene, const JointModel& model, const std::vector<StepPlan>& steps,
                       const std::vector<PoseRecord>& records) {
  return PoseTable(scene, model, steps, records).take();
}

ResultTable event_table(const Scene& scene, const std::vector<StepPlan>& steps, const std::vector<PathEvent>& events) {
  ResultTable table;
  for (const char* name : {"step", "t", "time_s", "event", "what"}) table.add_column(name);
  for (int j = 0; j < static_cast<int>(scene.joints.size()); ++j)
    for (int i = 0; i < 6; ++i)
      if (scene.joints[at(j)].leaves(i)) table.add_column(coordinate_column(scene, {j, i}));
  for (const StepPlan& step : steps)
    for (const auto& p : step.prescribed) table.add_column(coordinate_column(scene, p.coordinate));
  for (const LoadDef& load : scene.loads) table.add_column(load.name + ".factor");
  for (const PathEvent& event : events) {
    table.add_row();
    table.set("step", static_cast<long>(event.step));
    table.set("t", event.t);
    table.set("time_s", event.target.time);
    table.set("event", std::string(to_string(event.kind)));
    table.set("what", event.what);
    for (int j = 0; j < static_cast<int>(event.coordinates.size()); ++j)
      for (int i = 0; i < 6; ++i)
        if (scene.joints[at(j)].leaves(i))
          table.set(coordinate_column(scene, {j, i}), shown({j, i}, event.coordinates[at(j)][at(i)]));
    for (const auto& p : event.target.prescribed)
      table.set(coordinate_column(scene, p.coordinate), shown(p.coordinate, p.value));
    for (std::size_t i = 0; i < event.target.load_factors.size(); ++i)
      table.set(scene.loads[i].name + ".factor", event.target.load_factors[i]);
  }
  return table;
}

}  // namespace genu
