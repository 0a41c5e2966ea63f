#include "genu/appraise/implausible.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "genu/appraise/place.h"
#include "genu/appraise/tolerances.h"
#include "genu/core/units.h"
#include "genu/results/columns.h"

namespace genu {
namespace {

/// The largest of numbers that have a name each.
struct Worst {
  double value = 0;
  std::size_t row = 0;
  std::string name;

  void see(double x, std::size_t at_row, const std::string& of) {
    if (x > value) value = x, row = at_row, name = of;
  }
};

class Implausible {
 public:
  /// `where`: of a row.
  Implausible(const Prepared& prepared, const ResultTable& table, std::function<std::string(std::size_t)> where)
      : prepared_(prepared), limits_(prepared.scene.plausible), table_(table), where_(std::move(where)) {}

  void ligaments() {
    Worst strain, force;
    for (const LigamentDef& ligament : prepared_.scene.ligaments) {
      const bool tears = ligament.law != "spring";  // a spring stretches as it likes
      const Column pulls = column(ligament.name + ".force_N"), strains = column(ligament.name + ".strain");
      for (std::size_t row = 0; row < table_.rows(); ++row) {
        const double pull = number(row, pulls);
        if (pull > 0 && tears) strain.see(number(row, strains), row, ligament.name);
        force.see(pull, row, ligament.name);
      }
    }
    if (strain.value > limits_.strain)
      say("the strain of {} reaches {:.0f} %", strain, 100, "limit {:g} %", limits_.strain);
    if (force.value > limits_.ligament_force)
      say("the force of {} reaches {:.0f} N", force, 1, "limit {:g} N", limits_.ligament_force);
  }

  /// `records`: of the rows; none of a motion.
  void contacts(const std::vector<PoseRecord>& records) {
    Worst force, pressure;
    const auto see = [&](const std::string& contact) {
      const Column forces = column(contact + ".force_N");
      for (std::size_t row = 0; row < table_.rows(); ++row) force.see(number(row, forces), row, contact);
    };
    for (const ContactDef& contact : prepared_.scene.contacts) see(contact.name);
    for (const LayerDef& layer : prepared_.scene.layers) {
      see(layer.pair.name);
      for (std::size_t row = 0; row < table_.rows(); ++row)
        pressure.see(units::kMegapascal * number(row, layer.pair.name + ".max_pressure_MPa"), row, layer.pair.name);
    }
    const double loads = largest_load(records);
    if (loads > 0 && force.value > limits_.contact_force * loads)
      say("the force of contact {} reaches {:.3g} times all loads", force, 1 / loads, "limit {:g} times",
          limits_.contact_force, 1);
    if (pressure.value > limits_.pressure)
      say("the pressure of {} reaches {:.3g} MPa", pressure, 1 / units::kMegapascal, "limit {:g} MPa",
          limits_.pressure);
  }

  void rotations(const std::vector<PoseRecord>& records) {
    Worst worst;
    const auto first = first_solved(records);
    for (std::size_t row = 0; first && row < records.size(); ++row) {
      const PosePoint &from = records[*first].point, &point = records[row].point;
      if (!point.solved()) continue;
      for (int j = 0; j < static_cast<int>(prepared_.scene.joints.size()); ++j)
        for (int i = 0; i < 3; ++i)
          if (is_held_beside(point.target, j, i))
            worst.see(std::abs(point.pose.state.coordinates[at(j)][at(i)] - from.pose.state.coordinates[at(j)][at(i)]),
                      row, coordinate_name(prepared_.scene, {j, i}));
    }
    if (worst.value > limits_.rotation)
      say("the angle {} is {:.0f} deg from where it began", worst, to::kDegree, "limit {:g} deg", limits_.rotation);
  }

  void travels(const std::vector<PoseRecord>& records) {
    Worst worst;
    const auto first = first_solved(records);
    const auto see = [&](const ContactDef& contact,
                         const std::function<std::optional<Vec3>(std::size_t, bool)>& place) {
      for (std::size_t row = 0; first && row < records.size(); ++row) {
        double least = std::numeric_limits<double>::infinity();
        for (const bool second : {false, true}) {
          const auto began = place(*first, second), now = place(row, second);
          least = began && now ? std::min(least, (*now - *began).norm()) : 0;
        }
        worst.see(least, row, contact.name);
      }
    };
    for (std::size_t pair = 0; pair < prepared_.scene.contacts.size(); ++pair)
      see(prepared_.scene.contacts[pair],
          [&](std::size_t row, bool second) { return middle_of(records[row].point, static_cast<int>(pair), second); });
    for (const LayerDef& layer : prepared_.scene.layers)
      see(layer.pair, [&](std::size_t row, bool second) { return centre_of(row, layer.pair, second); });
    if (worst.value > limits_.travel)
      say("contact {} is {:.0f} mm from where it began, on both surfaces", worst, to::kMillimetre, "limit {:g} mm",
          limits_.travel);
  }

  /// Of a knee by Grood and Suntay's translations, where none of the joint is prescribed: a contact that has slid off
  /// its surface says nothing of how far the bones are. An origin off the axis of flexion moves although the knee only
  /// flexes, so the point counts that moves least of those up to kAboveOrigin proximal of the femur's. Origins far from
  /// the joint say nothing.
  void displacements(const std::vector<PoseRecord>& records) {
    Worst worst;
    const auto first = first_solved(records);
    for (int j = 0; first && j < static_cast<int>(prepared_.scene.joints.size()); ++j) {
      const JointDef& joint = prepared_.scene.joints[at(j)];
      const auto& axes = joint.grood_suntay;
      if (!axes || axes->patella) continue;
      if (std::max(axes->femur.origin.norm(), axes->tibia.origin.norm()) > prepared_.model.scales.size) continue;
      const ClinicalColumns columns = clinical_columns(joint);
      Worst least{std::numeric_limits<double>::infinity(), 0, joint.name};
      for (int above = 0; above <= kAboveOriginSteps; ++above) {
        const double height = kAboveOrigin * above / kAboveOriginSteps;
        const Vec3 began = translations(*first, columns, height);
        Worst farthest;
        for (std::size_t row = 0; row < records.size(); ++row)
          if (records[row].point.solved() && !translates(records[row].point.target, j))
            farthest.see((translations(row, columns, height) - began).norm(), row, "");
        if (farthest.value < least.value) least.value = farthest.value, least.row = farthest.row;
      }
      worst.see(least.value, least.row, least.name);
    }
    if (worst.value > limits_.travel)
      say("joint {} is {:.0f} mm from where it began, by Grood and Suntay's translations,", worst, to::kMillimetre,
          "limit {:g} mm", limits_.travel);
  }

  /// Cables and forces toward a point can only pull; one that holds a coordinate may be asked to push, or the path may
  /// end where it goes slack.
  void drivers(const std::vector<PoseRecord>& records) {
    Worst push, pull;
    const PosePoint* last = nullptr;
    for (std::size_t row = 0; row < records.size(); ++row) {
      const PosePoint& point = records[row].point;
      if (!point.solved()) continue;
      last = &point;
      for_pulls(point, [&](const std::string& load, const QuantityRef&, double factor) {
        push.see(-factor, row, load);
        pull.see(factor, row, load);
      });
    }
    if (push.value > 0) {
      out_.push_back(fmt::format("{} would have to push at {} (factor {:.3g}): it cannot hold the coordinate there",
                                 push.name, where_(push.row), -push.value));
      return;
    }
    if (last == nullptr || records.back().point.solved()) return;
    bool said = false;
    for_pulls(*last, [&](const std::string& load, const QuantityRef& coordinate, double factor) {
      if (said || factor > kSlackDriver * pull.value) return;
      said = true;
      out_.push_back(
          fmt::format("{} is nearly slack where the path ends (factor {:.2g} in the last pose, at most {:.2g}): it can "
                      "only pull, and "
                      "beyond it would not hold {}",
                      load, factor, pull.value, quantity_name(prepared_.scene, coordinate)));
    });
  }

  /// Past half a turn the rotation vector of a bushing jumps, and the moment with it.
  void bushings() {
    Worst turn;
    for (const BushingDef& b : prepared_.scene.bushings)
      for (std::size_t row = 0; row < table_.rows(); ++row) {
        const Vec3 angles(number(row, b.name + ".turn_x_deg"), number(row, b.name + ".turn_y_deg"),
                          number(row, b.name + ".turn_z_deg"));
        turn.see(units::kDegree * angles.norm(), row, b.name);
      }
    if (turn.value > kMostBushingTurn)
      say("bushing {} turns by {:.0f} deg, and its moment jumps at 180 deg", turn, to::kDegree, "limit {:g} deg",
          kMostBushingTurn);
  }

  std::vector<std::string> take() { return std::move(out_); }

 private:
  void say(const char* what, const Worst& worst, double unit, const char* limit, double bound) {
    say(what, worst, unit, limit, bound, unit);
  }
  void say(const char* what, const Worst& worst, double unit, const char* limit, double bound, double bound_unit) {
    out_.push_back(fmt::format("{} at {} ({})", fmt::format(fmt::runtime(what), worst.name, unit * worst.value),
                               where_(worst.row), fmt::format(fmt::runtime(limit), bound_unit * bound)));
  }

  /// f(load, the coordinate it holds, its factor) for loads that can only pull.
  template <typename F>
  void for_pulls(const PosePoint& point, const F& f) const {
    for (std::size_t m = 0; m < point.target.prescribed.size(); ++m)
      for (const int driver : point.target.prescribed[m].drivers) {
        const Load& load = prepared_.model.loads[at(driver)];
        if (load.kind == Load::Kind::cable || load.kind == Load::Kind::toward)
          f(load.name, point.target.prescribed[m].coordinate, point.pose.state.multipliers[m]);
      }
  }

  /// Where it is in the table; none where it is not.
  using Column = std::optional<std::size_t>;
  Column column(const std::string& name) const {
    return table_.has_column(name) ? Column(table_.column_index(name)) : std::nullopt;
  }
  /// NaN also where the table lacks the column.
  double number(std::size_t row, const Column& column) const {
    const double* const value = column ? std::get_if<double>(&table_.at(row, *column)) : nullptr;
    return value != nullptr ? *value : std::numeric_limits<double>::quiet_NaN();
  }
  double number(std::size_t row, const std::string& name) const { return number(row, column(name)); }

  static std::optional<std::size_t> first_solved(const std::vector<PoseRecord>& records) {
    for (std::size_t row = 0; row < records.size(); ++row)
      if (records[row].point.solved()) return row;
    return std::nullopt;
  }

  /// Whether coordinate i of joint j is free while another of the same joint is prescribed. A joint of which nothing is
  /// prescribed goes where its loads take it.
  bool is_held_beside(const Target& target, int j, int i) const {
    if (!prepared_.scene.joints[at(j)].leaves(i)) return false;
    bool beside = false;
    const auto names = [&](const CoordinateRef& c) {
      if (c.joint != j) return false;
      beside = true;
      return c.index == i;
    };
    for (const auto& p : target.prescribed) {
      if (p.coordinate.combination < 0) {
        if (names(p.coordinate.first)) return false;
        continue;
      }
      for (const auto& term : prepared_.scene.combinations[at(p.coordinate.combination)].terms)
        if (names(term.coordinate)) return false;
    }
    return beside;
  }

  struct ClinicalColumns {
    Column flexion;
    std::array<Column, 3> translations;
  };
  ClinicalColumns clinical_columns(const JointDef& joint) const {
    return {column(clinical_column(joint, 0)),
            {column(clinical_column(joint, 3)), column(clinical_column(joint, 4)), column(clinical_column(joint, 5))}};
  }

  /// m, by Grood and Suntay, with the femur's origin `height` (m) farther proximal: flexion takes that point back,
  /// which counts as the tibia's way forward, and lowers it.
  Vec3 translations(std::size_t row, const ClinicalColumns& columns, double height) const {
    const auto& [x, y, z] = columns.translations;
    const double flexion = units::kDegree * number(row, columns.flexion);
    return units::kMillimetre * Vec3(number(row, x), number(row, y), number(row, z)) +
           height * Vec3(0, std::sin(flexion), std::cos(flexion));
  }

  /// Whether a translation of joint j is prescribed.
  bool translates(const Target& target, int j) const {
    const auto names = [&](const CoordinateRef& c) { return c.joint == j && c.index >= 3; };
    return std::any_of(target.prescribed.begin(), target.prescribed.end(), [&](const auto& p) {
      if (p.coordinate.combination < 0) return names(p.coordinate.first);
      const auto& terms = prepared_.scene.combinations[at(p.coordinate.combination)].terms;
      return std::any_of(terms.begin(), terms.end(), [&](const auto& term) { return names(term.coordinate); });
    });
  }

  /// The mean place of a rigid pair's contacts on its first or second surface, weighted by force.
  static std::optional<Vec3> middle_of(const PosePoint& point, int pair, bool second) {
    Vec3 sum = Vec3::Zero();
    double force = 0;
    for (const ActiveContact& c : point.pose.state.contacts)
      if (point.solved() && c.pair == pair && c.force > 0) {
        sum += c.force * (second ? c.geometry.b.p : c.geometry.a.p);
        force += c.force;
      }
    if (!(force > 0)) return std::nullopt;
    return Vec3(sum / force);
  }

  std::optional<Vec3> centre_of(std::size_t row, const ContactDef& contact, bool second) const {
    Vec3 out;
    for (std::size_t axis = 0; axis < 3; ++axis)
      out[static_cast<Eigen::Index>(axis)] =
          units::kMillimetre * number(row, contact.name + "." + centre_column(prepared_.scene, contact, second, axis));
    if (!out.allFinite()) return std::nullopt;
    return out;
  }

  /// N: the sum of all loads and weights in the row where it is largest, moments over the length scale. What holds the
  /// prescribed coordinates counts as well.
  double largest_load(const std::vector<PoseRecord>& records) const {
    const JointModel& model = prepared_.model;
    double weights = 0, largest = 0;
    for (const Load& weight : model.weights) weights += weight.force.norm();
    for (std::size_t row = 0; row < table_.rows(); ++row) {
      double sum = weights;
      for (std::size_t k = 0; k < model.loads.size(); ++k) {
        const bool known = row < records.size() && k < records[row].point.target.load_factors.size();
        const double factor = known ? std::abs(records[row].point.target.load_factors[k]) : 1;
        sum += load_size(model.loads[k]) * share_of(model.loads[k].name, row, factor);
      }
      if (sum > 0) largest = std::max(largest, sum + reactions(row));
    }
    return largest;
  }

  double load_size(const Load& load) const {
    const bool moment = load.kind == Load::Kind::coordinate && load.coordinate.index < 3;
    const double length = prepared_.model.scales.length;
    return load.force.norm() + load.moment.norm() / length + std::abs(load.value) / (moment ? length : 1);
  }

  /// `factor`: where the table has no column of it, because no step changes it.
  double share_of(const std::string& load, std::size_t row, double factor) const {
    if (const double x = number(row, load + ".factor"); std::isfinite(x)) factor = std::abs(x);
    if (const double x = number(row, load + ".scale"); std::isfinite(x)) factor *= std::abs(x);
    return factor;
  }

  double reactions(std::size_t row) const {
    double sum = 0;
    std::set<std::string> seen;
    for (const StepPlan& step : prepared_.steps)
      for (const auto& p : step.prescribed) {
        const std::string column = reaction_column(prepared_.scene, p.coordinate);
        if (!seen.insert(column).second) continue;
        if (const double x = std::abs(number(row, column)); std::isfinite(x))
          sum += x / (p.coordinate.is_rotation() ? prepared_.model.scales.length : 1);
      }
    return sum;
  }

  const Prepared& prepared_;
  const PlausibleDef& limits_;
  const ResultTable& table_;
  const std::function<std::string(std::size_t)> where_;
  std::vector<std::string> out_;
};

}  // namespace

std::vector<std::string> implausible(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                     const ResultTable& poses) {
  return implausible(prepared, records, poses, [&](std::size_t row) {
    return place(prepared, records[row].point.step, records[row].point.target);
  });
}

std::vector<std::string> implausible(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                     const ResultTable& poses, const std::function<std::string(std::size_t)>& where) {
  Implausible found(prepared, poses, where);
  found.ligaments();
  found.bushings();
  found.contacts(records);
  found.drivers(records);
  found.rotations(records);
  found.travels(records);
  found.displacements(records);
  return found.take();
}

std::vector<std::string> implausible(const Prepared& prepared, const ResultTable& motion) {
  Implausible found(prepared, motion,
                    [&](std::size_t row) { return fmt::format("{:.4g} s", motion.number(row, "time_s")); });
  found.ligaments();
  found.bushings();
  found.contacts({});
  return found.take();
}

}  // namespace genu
