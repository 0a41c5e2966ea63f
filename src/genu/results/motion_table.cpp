#include "genu/results/motion_table.h"

#include <algorithm>
#include <cmath>

#include "genu/core/units.h"
#include "genu/model/grood_suntay.h"
#include "genu/model/ligament_pieces.h"
#include "genu/motion/motion_rates.h"
#include "genu/results/bundle_columns.h"
#include "genu/results/bushing_columns.h"
#include "genu/results/columns.h"
#include "genu/results/compartment_columns.h"
#include "genu/results/contact_columns.h"
#include "genu/results/wrap_columns.h"

namespace genu {
namespace {

/// "j1.angle_velocity_deg_s", "knee.x_velocity_mm_s"
std::string rate_column(const PlacedScene& scene, const CoordinateRef& c) {
  return coordinate_name(scene, c) + (c.index < 3 ? "_velocity_deg_s" : "_velocity_mm_s");
}

class MotionTable {
 public:
  MotionTable(const PlacedScene& scene, const JointModel& model, const std::vector<MotionPoint>& points)
      : scene_(scene), model_(model), contacts_(scene, model, numbers_of(model, points)) {
    add_columns();
    for (const MotionPoint& point : points) add_row(point, points.front());
  }
  ResultTable take() { return std::move(table_); }

 private:
  static std::vector<int> numbers_of(const JointModel& model, const std::vector<MotionPoint>& points) {
    std::vector<int> numbers(model.pairs.size(), 0);
    for (const MotionPoint& point : points)
      for (const ActiveContact& c : point.state.contacts) numbers[at(c.pair)] = std::max(numbers[at(c.pair)], c.number);
    return numbers;
  }

  void add_columns() {
    for (const char* name : {"step", "increment", "time_s", "status"}) table_.add_column(name);
    for (int j = 0; j < static_cast<int>(scene_.joints.size()); ++j) {
      const JointDef& joint = scene_.joints[at(j)];
      for (int i = 0; i < 6; ++i)
        if (joint.leaves(i)) table_.add_column(coordinate_column(scene_, QuantityRef(j, i)));
      for (int i = 0; i < 6; ++i)
        if (joint.leaves(i)) table_.add_column(rate_column(scene_, {j, i}));
      for (const auto& drive : model_.drives)
        if (drive.quantity.combination < 0 && drive.quantity.first.joint == j)
          table_.add_column(reaction_column(scene_, drive.quantity));
      if (joint.stiffness > 0 || joint.limits) table_.add_column(joint.name + ".spring_Nm");
      if (joint.damping > 0) table_.add_column(joint.name + ".damper_Nm");
      for (std::size_t i = 0; joint.type != JointDef::Type::free && i < 6; ++i)
        table_.add_column(held_column(joint.name, i));
      for (std::size_t i = 0; joint.grood_suntay && i < kClinicalColumns; ++i)
        table_.add_column(clinical_column(joint, i));
    }
    for (int k = 0; k < static_cast<int>(scene_.combinations.size()); ++k)
      table_.add_column(coordinate_column(scene_, combination(k)));
    for (const auto& drive : model_.drives)
      if (drive.quantity.combination >= 0) table_.add_column(reaction_column(scene_, drive.quantity));
    contacts_.add_columns(table_);
    add_compartment_columns(scene_, table_);
    for (const auto& l : model_.ligaments)
      for (const char* quantity : {"length_mm", "strain", "velocity_mm_s", "force_N"})
        table_.add_column(l.name + "." + quantity);
    add_bundle_columns(scene_, table_);
    add_bushing_columns(model_, table_);
    add_wrap_columns(model_, table_);
    for (const Load& l : model_.loads)
      if (l.scale) table_.add_column(l.name + ".scale");
    for (const char* name :
         {"energy.kinetic_J", "energy.stored_J", "energy.gravity_J", "energy.load_work_J", "energy.dissipated_J"})
      table_.add_column(name);
    if (!model_.layers.empty()) table_.add_column("energy.layer_work_J");
    for (const char* name : {"energy.balance_J", "residual"}) table_.add_column(name);
  }

  QuantityRef combination(int k) const { return {scene_.combinations[at(k)].terms.front().coordinate, k}; }

  void add_row(const MotionPoint& point, const MotionPoint& first) {
    table_.add_row();
    table_.set("step", 1L);
    table_.set("increment", static_cast<long>(table_.rows()) - 1);
    table_.set("time_s", point.time);
    table_.set("status", std::string("ok"));
    set_joints(point);
    contacts_.set(table_, point.state, {}, point.pair_gap, {}, true, &point.twist);
    set_compartment_columns(scene_, table_);
    set_ligaments(point);
    set_bundle_columns(scene_, table_);
    set_bushing_columns(model_, point.state, table_);
    set_wrap_columns(model_, point.state, table_);
    for (const Load& l : model_.loads)
      if (l.scale) table_.set(l.name + ".scale", load_scale_in_motion(model_, l, point.state, point.time, point.twist));
    const MechanicalEnergy energy = mechanical_energy(model_, point.state, point.twist);
    table_.set("energy.kinetic_J", energy.kinetic);
    table_.set("energy.stored_J", energy.stored);
    table_.set("energy.gravity_J", energy.gravity);
    table_.set("energy.load_work_J", point.load_work);
    table_.set("energy.dissipated_J", point.dissipated);
    if (!model_.layers.empty()) table_.set("energy.layer_work_J", point.layer_work);
    table_.set("energy.balance_J", energy_error(model_, first, point));
    table_.set("residual", point.residual);
  }

  void set_joints(const MotionPoint& point) {
    const auto rates = coordinate_rates(model_, point.state, point.twist);
    for (int j = 0; j < static_cast<int>(scene_.joints.size()); ++j) {
      const JointDef& joint = scene_.joints[at(j)];
      const JointValues& values = point.state.coordinates[at(j)];
      for (int i = 0; i < 6; ++i) {
        if (!joint.leaves(i)) continue;
        table_.set(coordinate_column(scene_, QuantityRef(j, i)), shown_value({j, i}, values[at(i)]));
        table_.set(rate_column(scene_, {j, i}), shown_value({j, i}, rates[at(j)][at(i)]));
      }
      for (const JointSpring& spring : model_.joint_springs)
        if (spring.joint == j) table_.set(joint.name + ".spring_Nm", spring.moment(values[0]));
      if (joint.damping > 0) table_.set(joint.name + ".damper_Nm", -joint.damping * rates[at(j)][0]);
      if (joint.type != JointDef::Type::free) set_held(j, point.state);
      if (joint.grood_suntay) set_clinical(joint, point.state);
    }
    for (std::size_t i = 0; i < model_.drives.size(); ++i)
      table_.set(reaction_column(scene_, model_.drives[i].quantity), point.state.multipliers[i]);
    for (int k = 0; k < static_cast<int>(scene_.combinations.size()); ++k) {
      const QuantityRef quantity = combination(k);
      table_.set(coordinate_column(scene_, quantity),
                 shown_value(quantity, quantity_value(model_, point.state.coordinates, quantity)));
    }
  }

  void set_held(int joint, const State& state) {
    const Vec6 wrench = joint_reaction(model_, state, joint);
    for (std::size_t i = 0; i < 6; ++i)
      table_.set(held_column(model_.joints[at(joint)].name, i), wrench[static_cast<Eigen::Index>(i)]);
  }

  void set_clinical(const JointDef& joint, const State& state) {
    const GroodSuntayDef& def = *joint.grood_suntay;
    const auto m = grood_suntay(def, state.poses[at(def.femur.body)], state.poses[at(def.tibia.body)]);
    if (!m) return;
    const auto numbers = clinical_numbers(joint, *m);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      table_.set(clinical_column(joint, i), clinical_unit(i) * numbers[i]);
  }

  void set_ligaments(const MotionPoint& point) {
    for (std::size_t i = 0; i < model_.ligaments.size(); ++i) {
      const auto& l = model_.ligaments[i];
      const LigamentShown law = show_ligament(model_, point.state, static_cast<int>(i));
      const double rate = l.path.length_rate(point.state.poses, point.twist, point.state.wraps);
      const double damper = damper_tension(l, point.modes[i], law.force, rate);
      table_.set(l.name + ".length_mm", to::kMillimetre * law.length);
      table_.set(l.name + ".strain", law.strain);
      table_.set(l.name + ".velocity_mm_s", to::kMillimetre * rate);
      table_.set(l.name + ".force_N", law.force + damper);
    }
  }

  const PlacedScene& scene_;
  const JointModel& model_;
  ContactColumns contacts_;
  ResultTable table_;
};

}  // namespace

ResultTable motion_table(const PlacedScene& scene, const JointModel& model, const std::vector<MotionPoint>& points) {
  return MotionTable(scene, model, points).take();
}

double energy_error(const JointModel& model, const MotionPoint& first, const MotionPoint& point) {
  const auto balance = [&](const MotionPoint& p) {
    return mechanical_energy(model, p.state, p.twist).sum() + p.dissipated - p.load_work - p.layer_work;
  };
  return balance(point) - balance(first);
}

}  // namespace genu
