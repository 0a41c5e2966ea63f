#include "genu/results/pose_table.h"

#include <algorithm>
#include <cmath>

#include "genu/core/units.h"
#include "genu/model/grood_suntay.h"
#include "genu/model/ligament_pieces.h"
#include "genu/results/bundle_columns.h"
#include "genu/results/bushing_columns.h"
#include "genu/results/columns.h"
#include "genu/results/compartment_columns.h"
#include "genu/results/contact_columns.h"
#include "genu/results/extensor_columns.h"
#include "genu/results/moment_arm_columns.h"
#include "genu/results/wrap_columns.h"

namespace genu {
namespace {

class PoseTable {
 public:
  PoseTable(const PlacedScene& scene, const JointModel& model, const std::vector<StepPlan>& steps,
            const std::vector<PoseRecord>& records)
      : scene_(scene), model_(model), contacts_(scene, model, numbers_of(model, records)) {
    add_columns(steps);
    if (std::any_of(records.begin(), records.end(), [](const PoseRecord& r) { return r.given.has_value(); }))
      add_residual_columns();
    else
      table_.add_column("branch");
    for (const PoseRecord& record : records) add_row(record);
  }
  ResultTable take() { return std::move(table_); }

 private:
  static std::vector<int> numbers_of(const JointModel& model, const std::vector<PoseRecord>& records) {
    std::vector<int> numbers(model.pairs.size(), 0);
    for (const PoseRecord& r : records)
      for (std::size_t p = 0; p < r.point.pose.last_number.size(); ++p)
        numbers[p] = std::max(numbers[p], r.point.pose.last_number[p]);
    return numbers;
  }

  void add_columns(const std::vector<StepPlan>& steps) {
    for (const char* name : {"step", "increment", "time_s", "status"}) table_.add_column(name);
    for (int j = 0; j < static_cast<int>(scene_.joints.size()); ++j) {
      const JointDef& joint = scene_.joints[at(j)];
      for (int i = 0; i < 6; ++i)
        if (joint.leaves(i)) free_.push_back({{j, i}, table_.add_column(coordinate_column(scene_, {j, i}))});
      for (int i = 0; i < 6; ++i) add_reaction(steps, {j, i});
      for (std::size_t i = 0; joint.type != JointDef::Type::free && i < 6; ++i)
        table_.add_column(held_column(joint.name, i));
      for (std::size_t i = 0; joint.grood_suntay && i < kClinicalColumns; ++i)
        table_.add_column(clinical_column(joint, i));
    }
    for (int k = 0; k < static_cast<int>(scene_.combinations.size()); ++k) {
      const QuantityRef quantity{scene_.combinations[at(k)].terms.front().coordinate, k};
      table_.add_column(coordinate_column(scene_, quantity));
      add_reaction(steps, quantity);
    }
    contacts_.add_columns(table_);
    add_compartment_columns(scene_, table_);
    for (const auto& l : model_.ligaments) {
      ligaments_.push_back(table_.add_column(l.name + ".length_mm"));
      for (const char* quantity : {"strain", "force_N"}) table_.add_column(l.name + "." + quantity);
    }
    add_bundle_columns(scene_, table_);
    add_bushing_columns(model_, table_);
    add_wrap_columns(model_, table_);
    add_moment_arm_columns(scene_, model_, table_);
    add_extensor_columns(scene_, table_);
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
        if (p.coordinate == quantity && p.drivers.empty()) table_.add_column(reaction_column(scene_, quantity));
  }

  void add_row(const PoseRecord& record) {
    const PosePoint& point = record.point;
    table_.add_row();
    table_.set("step", static_cast<long>(point.step));
    table_.set("increment", static_cast<long>(point.increment));
    table_.set("time_s", point.target.time);
    table_.set("status", std::string(to_string(point.report.status)));
    if (!record.given) table_.set("branch", static_cast<long>(point.branch));
    if (record.pair_gap.size() != model_.pairs.size() || point.pose.state.poses.empty()) {
      for (const auto& p : point.target.prescribed)
        table_.set(coordinate_column(scene_, p.coordinate), shown_value(p.coordinate, p.value));
      set_factors(point.target, point.pose.state);
      return;
    }
    set_coordinates(record);
    set_factors(point.target, point.pose.state);
    contacts_.set(table_, point.pose.state, point.pose.open, record.pair_gap, record.layers, !record.given);
    set_compartment_columns(scene_, table_);
    set_ligaments(point);
    set_bundle_columns(scene_, table_);
    set_bushing_columns(model_, point.pose.state, table_);
    set_wrap_columns(model_, point.pose.state, table_);
    set_moment_arm_columns(scene_, model_, point.pose.state, table_);
    set_extensor_columns(scene_, model_, point.target, point.pose.state, table_);
    for (const Load& l : model_.loads)
      if (l.scale) table_.set(l.name + ".scale", load_scale(l, point.pose.state, point.target.time).factor);
    if (record.given) return set_residual(*record.given);
    table_.set("stability.min_eigenvalue_Nmm", point.stability.smallest * to::kMillijoule);
    table_.set("stability", std::string(to_string(point.stability)));
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
      return drives(s.prescribed, load) || (load < s.factors.size() && s.factors[load].from != s.factors[load].to);
    });
  }

  void set_factors(const Target& target, const State& state) {
    for (std::size_t i = 0; i < target.load_factors.size(); ++i)
      if (const std::string name = model_.loads[i].name + ".factor"; table_.has_column(name))
        table_.set(name, load_factor(target, state, i));
  }

  void set_coordinates(const PoseRecord& record) {
    const PosePoint& point = record.point;
    const State& state = point.pose.state;
    const bool reactions = !record.given || record.given->reactions;
    for (const auto& [c, column] : free_)
      table_.set(column, shown_value(c, state.coordinates[at(c.joint)][at(c.index)]));
    for (int k = 0; k < static_cast<int>(scene_.combinations.size()); ++k) {
      const QuantityRef quantity{scene_.combinations[at(k)].terms.front().coordinate, k};
      table_.set(coordinate_column(scene_, quantity),
                 shown_value(quantity, quantity_value(model_, state.coordinates, quantity)));
    }
    for (std::size_t m = 0; reactions && m < point.target.prescribed.size(); ++m)
      if (point.target.prescribed[m].drivers.empty())
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
    const auto numbers = clinical_numbers(joint, *motion);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      table_.set(clinical_column(joint, i), clinical_unit(i) * numbers[i]);
  }

  void set_held(int joint, const PosePoint& point) {
    const Vec6 wrench = joint_reaction(model_, point.pose.state, joint);
    for (std::size_t i = 0; i < 6; ++i)
      table_.set(held_column(model_.joints[at(joint)].name, i), wrench[static_cast<Eigen::Index>(i)]);
  }

  void set_ligaments(const PosePoint& point) {
    for (std::size_t i = 0; i < model_.ligaments.size(); ++i) {
      const LigamentShown shown_ligament = show_ligament(model_, point.pose.state, static_cast<int>(i));
      table_.set(ligaments_[i], to::kMillimetre * shown_ligament.length);
      table_.set(ligaments_[i] + 1, shown_ligament.strain);
      table_.set(ligaments_[i] + 2, shown_ligament.force);
    }
  }

  const PlacedScene& scene_;
  const JointModel& model_;
  ContactColumns contacts_;
  ResultTable table_;
  std::vector<std::pair<CoordinateRef, std::size_t>> free_;  // coordinates that no joint holds, and their columns
  std::vector<std::size_t> ligaments_;                       // the first of three columns of each
};

}  // namespace

ResultTable pose_table(const PlacedScene& scene, const JointModel& model, const std::vector<StepPlan>& steps,
                       const std::vector<PoseRecord>& records) {
  return PoseTable(scene, model, steps, records).take();
}

ResultTable event_table(const PlacedScene& scene, const std::vector<StepPlan>& steps,
                        const std::vector<PathEvent>& events) {
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
          table.set(coordinate_column(scene, {j, i}), shown_value({j, i}, event.coordinates[at(j)][at(i)]));
    for (const auto& p : event.target.prescribed)
      table.set(coordinate_column(scene, p.coordinate), shown_value(p.coordinate, p.value));
    for (std::size_t i = 0; i < event.target.load_factors.size(); ++i)
      if (!drives(event.target.prescribed, i)) table.set(scene.loads[i].name + ".factor", event.target.load_factors[i]);
  }
  return table;
}

}  // namespace genu
