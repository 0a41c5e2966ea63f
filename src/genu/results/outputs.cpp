#include "genu/results/outputs.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/model/ligament_pieces.h"
#include "genu/results/columns.h"
#include "genu/results/extensor_columns.h"

namespace genu {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A contact of a pair at a pose: closed or open, with its motion.
struct MovingContact {
  int number = 0;
  bool closed = false;
  double force = 0, gap = 0;
  Vec3 a, b;  ///< its points, m, in the frames of their bodies
  ContactMotion motion;
};

/// `never_closed`: with the nearest points of a pair that never touched, which have a gap and nothing else.
std::vector<MovingContact> contacts_of(int pair, const PosePoint& point, const Sensitivity& s,
                                       bool never_closed = false) {
  std::vector<MovingContact> out;
  const auto& held = point.pose.state.contacts;
  for (std::size_t k = 0; k < held.size(); ++k)
    if (held[k].pair == pair)
      out.push_back({held[k].number, true, held[k].force, 0, held[k].geometry.a.p, held[k].geometry.b.p, s.closed(k)});
  const auto& open = point.pose.open;
  for (std::size_t k = 0; k < open.size(); ++k)
    if (open[k].pair == pair && (never_closed || open[k].number > 0))
      out.push_back({open[k].number, false, 0, open[k].gap, open[k].geometry.a.p, open[k].geometry.b.p, s.open(k)});
  return out;
}

/// The contact with the smallest gap, a closed one before all open ones; null where there is none.
const MovingContact* nearest(const std::vector<MovingContact>& contacts) {
  const MovingContact* best = nullptr;
  for (const MovingContact& c : contacts)
    if (best == nullptr || c.closed > best->closed || (c.closed == best->closed && c.gap < best->gap)) best = &c;
  return best;
}

/// Derivative of the force-weighted mean of the contact points: (sum F p)' / F - (sum F p) F' / F^2.
double centre_rate(const std::vector<MovingContact>& contacts, bool second, Eigen::Index axis) {
  double force = 0, force_rate = 0, moment = 0, moment_rate = 0;
  for (const MovingContact& c : contacts) {
    const double place = (second ? c.b : c.a)[axis], place_rate = (second ? c.motion.b : c.motion.a)[axis];
    if (!(c.force > 0)) continue;
    force += c.force;
    force_rate += c.motion.force;
    moment += c.force * place;
    moment_rate += c.motion.force * place + c.force * place_rate;
  }
  return force > 0 ? (moment_rate - moment / force * force_rate) / force : kNone;
}

double force_rate(const std::vector<MovingContact>& contacts) {
  double sum = 0;
  for (const MovingContact& c : contacts) sum += c.motion.force;
  return sum;
}

std::vector<MovingContact> within(const RegionDef& region, std::vector<MovingContact> contacts) {
  std::erase_if(contacts, [&](const MovingContact& c) { return !(c.force > 0) || !region.contains(c.b); });
  return contacts;
}

class Outputs {
 public:
  Outputs(const PlacedScene& scene, const JointModel& model, const std::vector<StepPlan>& steps)
      : scene_(scene), model_(model), steps_(steps) {}

  std::vector<Output> list(int contact_numbers) {
    for (int j = 0; j < static_cast<int>(scene_.joints.size()); ++j) add_joint(j);
    for (int k = 0; k < static_cast<int>(scene_.combinations.size()); ++k) {
      const QuantityRef quantity{scene_.combinations[at(k)].terms.front().coordinate, k};
      add_quantity(quantity);
      add_reaction(quantity);
    }
    for (int p = 0; p < static_cast<int>(model_.pairs.size()); ++p) add_pair(p, contact_numbers);
    for (int l = 0; l < static_cast<int>(model_.ligaments.size()); ++l) add_ligament(l);
    for (const BundleDef& bundle : scene_.bundles)
      if (!bundle.members.empty()) add_bundle(bundle);
    for (const ExtensorMechanism& one : extensor_mechanisms(scene_)) add_extensor(one);
    for (int l = 0; l < static_cast<int>(model_.loads.size()); ++l)
      if (model_.loads[at(l)].scale)
        add(model_.loads[at(l)].name + ".scale", "1", 1,
            [l](const PosePoint&, const Sensitivity& s) { return s.load_scale(l); });
    for (int l = 0; l < static_cast<int>(model_.loads.size()); ++l)
      if (std::any_of(steps_.begin(), steps_.end(), [l](const auto& step) { return drives(step.prescribed, at(l)); }))
        add(model_.loads[at(l)].name + ".factor", "1", 1,
            [l](const PosePoint&, const Sensitivity& s) { return s.driving_factor(l); });
    return std::move(out_);
  }

 private:
  using Rate = std::function<double(const PosePoint&, const Sensitivity&)>;

  void add(const std::string& column, const char* unit, double shown, Rate rate, int number = 0) {
    out_.push_back({column, unit, shown, std::move(rate), number});
  }

  void add_quantity(const QuantityRef& q) {
    add(coordinate_column(scene_, q), q.is_rotation() ? "deg" : "mm", q.is_rotation() ? to::kDegree : to::kMillimetre,
        [q](const PosePoint&, const Sensitivity& s) { return s.quantity(q); });
  }

  void add_reaction(const QuantityRef& q) {
    const bool prescribed = std::any_of(steps_.begin(), steps_.end(), [&](const StepPlan& step) {
      return std::any_of(step.prescribed.begin(), step.prescribed.end(),
                         [&](const auto& p) { return p.coordinate == q && p.drivers.empty(); });
    });
    if (prescribed)
      add(reaction_column(scene_, q), q.is_rotation() ? "Nm" : "N", 1,
          [q](const PosePoint&, const Sensitivity& s) { return s.reaction(q); });
  }

  void add_joint(int j) {
    const JointDef& joint = scene_.joints[at(j)];
    for (int i = 0; i < 6; ++i)
      if (joint.leaves(i)) add_quantity({j, i});
    for (int i = 0; i < 6; ++i) add_reaction({j, i});
    for (int i = 0; joint.type != JointDef::Type::free && i < 6; ++i)
      add(held_column(joint.name, at(i)), i < 3 ? "N" : "Nm", 1,
          [j, i](const PosePoint&, const Sensitivity& s) { return s.held_reaction(j)[i]; });
    for (std::size_t i = 0; joint.grood_suntay && i < kClinicalColumns; ++i)
      add(clinical_column(joint, i), i < 3 ? "deg" : "mm", clinical_unit(i),
          [&joint, j, i](const PosePoint&, const Sensitivity& s) {
            const auto m = s.clinical(j);
            return m ? clinical_numbers(joint, *m)[i] : kNone;
          });
  }

  void add_pair(int p, int contact_numbers) {
    const std::string& name = model_.pairs[at(p)].name;
    add(name + ".force_N", "N", 1,
        [p](const PosePoint& point, const Sensitivity& s) { return force_rate(contacts_of(p, point, s)); });
    add(name + ".gap_mm", "mm", to::kMillimetre, [p](const PosePoint& point, const Sensitivity& s) {
      const auto contacts = contacts_of(p, point, s, true);
      const MovingContact* c = nearest(contacts);
      return c == nullptr ? kNone : c->motion.gap;
    });
    for (const bool second : {false, true})
      for (int i = 0; i < 3; ++i)
        add(name + "." + point_column(scene_, at(p), second, at(i)), "mm", to::kMillimetre,
            [p, second, i](const PosePoint& point, const Sensitivity& s) {
              const auto contacts = contacts_of(p, point, s);
              const double centre = centre_rate(contacts, second, i);
              const MovingContact* c = nearest(contacts);
              return std::isfinite(centre) || c == nullptr ? centre : (second ? c->motion.b : c->motion.a)[i];
            });
    for (const RegionDef& region : scene_.contacts[at(p)].regions) add_region(p, name + "." + region.name, region);
    for (int k = 1; contact_numbers > 1 && k <= contact_numbers; ++k) add_numbered(p, k);
  }

  void add_region(int p, const std::string& name, const RegionDef& region) {
    add(name + ".force_N", "N", 1, [p, region](const PosePoint& point, const Sensitivity& s) {
      return force_rate(within(region, contacts_of(p, point, s)));
    });
    for (int i = 0; i < 3; ++i)
      add(fmt::format("{}.{}_mm", name, kAxisNames[i]), "mm", to::kMillimetre,
          [p, region, i](const PosePoint& point, const Sensitivity& s) {
            return centre_rate(within(region, contacts_of(p, point, s)), true, i);
          });
  }

  void add_numbered(int p, int number) {
    const std::string name = fmt::format("{}.{}", model_.pairs[at(p)].name, number);
    const auto motion = [p, number](const PosePoint& point, const Sensitivity& s) {
      for (const MovingContact& c : contacts_of(p, point, s))
        if (c.number == number) return c.motion;
      return ContactMotion{kNone, kNone, Vec3::Constant(kNone), Vec3::Constant(kNone)};
    };
    add(
        name + ".force_N", "N", 1, [motion](const auto& point, const auto& s) { return motion(point, s).force; },
        number);
    add(
        name + ".gap_mm", "mm", to::kMillimetre,
        [motion](const auto& point, const auto& s) { return motion(point, s).gap; }, number);
    for (const bool second : {false, true})
      for (int i = 0; i < 3; ++i)
        add(
            name + "." + point_column(scene_, at(p), second, at(i)), "mm", to::kMillimetre,
            [motion, second, i](const auto& point, const auto& s) {
              const ContactMotion m = motion(point, s);
              return (second ? m.b : m.a)[i];
            },
            number);
  }

  void add_ligament(int l) {
    const std::string& name = model_.ligaments[at(l)].name;
    add(name + ".length_mm", "mm", to::kMillimetre, [l](const auto&, const auto& s) { return s.ligament(l).length; });
    add(name + ".strain", "1", 1, [l](const auto&, const auto& s) { return s.ligament(l).strain; });
    add(name + ".force_N", "N", 1, [l](const auto&, const auto& s) { return s.ligament(l).force; });
  }

  void add_bundle(const BundleDef& bundle) {
    const auto sum = [members = bundle.members](const Sensitivity& s, double LigamentMotion::*number) {
      double total = 0;
      for (const int l : members) total += s.ligament(l).*number;
      return total;
    };
    const double share = 1 / static_cast<double>(bundle.members.size());
    add(bundle.name + ".strain", "1", 1,
        [sum, share](const auto&, const auto& s) { return share * sum(s, &LigamentMotion::strain); });
    add(bundle.name + ".force_N", "N", 1, [sum](const auto&, const auto& s) { return sum(s, &LigamentMotion::force); });
  }

  void add_extensor(const ExtensorMechanism& one) {
    const auto muscle = [one](const Sensitivity& s) {
      double sum = 0;
      for (const std::size_t l : one.quadriceps) sum += s.tension(static_cast<int>(l));
      return sum;
    };
    const auto tendon = [one](const Sensitivity& s) {
      double sum = 0;
      for (const std::size_t l : one.tendon) sum += s.ligament(static_cast<int>(l)).force;
      return sum;
    };
    add(one.quadriceps_column(), "N", 1, [muscle](const auto&, const auto& s) { return muscle(s); });
    add(one.tendon_column(), "N", 1, [tendon](const auto&, const auto& s) { return tendon(s); });
    add(one.ratio_column(), "1", 1, [model = &model_, one, muscle, tendon](const auto& point, const auto& s) {
      double force = 0, pull = 0;
      for (const std::size_t l : one.quadriceps) force += load_tension(*model, point.target, point.pose.state, l);
      for (const std::size_t l : one.tendon) pull += show_ligament(*model, point.pose.state, static_cast<int>(l)).force;
      return (tendon(s) - pull / force * muscle(s)) / force;
    });
  }

  const PlacedScene& scene_;
  const JointModel& model_;
  const std::vector<StepPlan>& steps_;
  std::vector<Output> out_;
};

constexpr const char* kAskedFor = "is an input of the scene: no parameter changes it";

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::vector<Output> outputs_of(const PlacedScene& scene, const JointModel& model, const std::vector<StepPlan>& steps,
                               int contact_numbers) {
  return Outputs(scene, model, steps).list(contact_numbers);
}

std::string why_not_smooth(const std::string& column) {
  for (const char* name : {"step", "increment", "time_s"})
    if (column == name) return kAskedFor;
  for (const char* name : {"status", "branch", "stability", "newton.iterations", "residual"})
    if (column == name) return "is no smooth function of the pose";
  if (column == "stability.min_eigenvalue_Nmm")
    return "has no exact derivative here: that of an eigenvalue of the stiffness needs third derivatives of the "
           "surfaces";
  if (ends_with(column, ".factor")) return kAskedFor;
  if (ends_with(column, ".touches")) return "is 0 or 1: it has no derivative";
  if (ends_with(column, ".arc_mm") || column.find(".begin.") != std::string::npos ||
      column.find(".end.") != std::string::npos)
    return "has no derivative here: that of a touching point is not computed";
  if (ends_with(column, ".points")) return "counts: it has no derivative";
  return {};
}

}  // namespace genu
