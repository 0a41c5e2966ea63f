#include "genu/model/nonsmooth_points.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "genu/model/ligament_pieces.h"
#include "genu/model/linearization.h"

namespace genu {
namespace {

class Finder {
 public:
  Finder(const JointModel& model, const State& state, const Target& target, const NonsmoothReach& reach)
      : model_(model), state_(state), target_(target), reach_(reach) {}

  std::vector<NonsmoothPoint> find() {
    find_all();
    return std::move(out_);
  }

  bool any() {
    find_all();
    return met_ || !out_.empty();
  }

 private:
  void find_all() {
    for (std::size_t i = 0; i < model_.ligaments.size(); ++i) add_ligament(i);
    for (const JointSpring& spring : model_.joint_springs) add_stops(spring);
    for (std::size_t i = 0; i < model_.loads.size(); ++i)
      if (const double factor = load_factor(target_, state_, i); factor != 0) add_scale(model_.loads[i], factor);
    for (const Load& weight : model_.weights) add_scale(weight, 1);
  }

  /// m, rad: possible remaining motion along `gradient`.
  double reach(double unit, const VecX& gradient) const {
    const double moved = reach_.twist.size() > 0 ? std::abs(reach_.twist.dot(gradient)) : 0;
    return reach_.least * unit + reach_.length + moved;
  }

  /// Several points within reach become one: the stiffness below the first and above the last.
  void meet(double below, double above, std::optional<NonsmoothPoint>& point) {
    met_ = true;
    if (!point) point = NonsmoothPoint{.gradient = {}, .wrench = {}, .below = below};
    point->above = above;
  }

  void add_ligament(std::size_t i) {
    const auto& l = model_.ligaments[i];
    const LigamentLaw& law = l.law;
    if (law.breaks().empty()) return;
    const double length = l.path.length(state_.poses, state_.wraps), unit = model_.scales.length,
                 most = reach_.most * unit;
    const auto piece = std::find_if(state_.pieces.begin(), state_.pieces.end(),
                                    [&](const LigamentPiece& p) { return at(p.ligament) == i && !p.by_length; });
    const bool by_length = piece == state_.pieces.end();
    if (!by_length && piece->held) return;
    const int on = by_length ? law.piece_at(length) : piece->piece;
    const LawValue pull = law.evaluate(length, by_length ? LigamentLaw::kByLength : on);
    std::optional<NonsmoothPoint> point;
    VecX gradient;
    int sharp = 0;  // sharp breaks before this one
    for (const LawBreak& b : law.breaks()) {
      const int pieces = b.sharp() ? sharp++ : sharp;
      const double past = length - b.length, force = std::abs(pull.force);
      const bool begun = force > 0 && force <= reach_.little && (past > 0 ? b.below : b.above).slack && !b.jumps();
      if (!begun && std::abs(past) > most) continue;
      if (gradient.size() == 0) gradient = l.path.length_gradient(state_.poses, model_.moving_count, state_.wraps);
      if (!(begun && force <= reach_.idle) && std::abs(past) > reach(unit, gradient)) continue;
      if (b.jumps())
        out_.push_back({.gradient = gradient,
                        .wrench = {},
                        .jump = b.force_jump(),
                        .beyond = on > pieces,
                        .ligament = static_cast<int>(i),
                        .law_break = pieces});
      else
        meet(b.below.stiffness, b.above.stiffness, point);
    }
    if (point && (point->below != point->above || point->below == 0)) add(*point, pull.stiffness, gradient, -gradient);
  }

  void add_stops(const JointSpring& spring) {
    const double angle = state_.coordinates[at(spring.joint)][0], within = -spring.stiffness,
                 beyond = within - spring.stop;
    std::optional<NonsmoothPoint> point;
    VecX gradient;
    const auto look = [&](double stop, double below, double above) {
      if (!(std::abs(angle - stop) <= reach_.most)) return;
      if (gradient.size() == 0) gradient = gradient_of({spring.joint, 0});
      if (std::abs(angle - stop) <= reach(1, gradient)) meet(below, above, point);
    };
    look(spring.lower, beyond, within);
    look(spring.upper, within, beyond);
    if (point && point->below != point->above) add(*point, spring.slope(angle), gradient, gradient);
  }

  void add_scale(const Load& load, double factor) {
    if (!load.scale || !load.scale->coordinate()) return;
    const CoordinateRef q = *load.scale->coordinate();
    const double value = state_.coordinates[at(q.joint)][at(q.index)], unit = q.index < 3 ? 1 : model_.scales.length;
    std::optional<NonsmoothPoint> point;
    VecX gradient;
    for (const LoadScale::NonsmoothPoint& k : load.scale->nonsmooth_points_over_coordinate()) {
      if (std::abs(value - k.x) > reach_.most * unit) continue;
      if (gradient.size() == 0) gradient = gradient_of(q);
      if (std::abs(value - k.x) <= reach(unit, gradient)) meet(factor * k.below, factor * k.above, point);
    }
    if (!point || point->below == point->above) return;
    VecX wrench = VecX::Zero(6 * model_.moving_count);
    add_load_wrench(model_, state_, load, 1, wrench);
    add(*point, factor * load.scale->evaluate(value).slope, gradient, wrench);
  }

  VecX scattered(const Vec12& of_two, int body_a, int body_b) const {
    VecX out = VecX::Zero(6 * model_.moving_count);
    const int bodies[2] = {body_a, body_b};
    for (int i = 0; i < 2; ++i)
      if (const int moving = bodies[i] < 0 ? -1 : model_.bodies[at(bodies[i])].moving; moving >= 0)
        out.segment<6>(6 * moving) += of_two.segment<6>(6 * i);
    return out;
  }

  VecX gradient_of(const CoordinateRef& q) const {
    const auto& joint = model_.joints[at(q.joint)];
    return scattered(joint_point(model_, state_, q.joint).gradient(q.index).transpose(), joint.parent, joint.child);
  }

  void add(NonsmoothPoint point, double here, const VecX& gradient, const VecX& wrench) {
    point.here = here;
    point.gradient = gradient;
    point.wrench = wrench;
    out_.push_back(std::move(point));
  }

  const JointModel& model_;
  const State& state_;
  const Target& target_;
  const NonsmoothReach& reach_;
  std::vector<NonsmoothPoint> out_;
  bool met_ = false;
};

}  // namespace

std::vector<NonsmoothPoint> nonsmooth_points_near(const JointModel& model, const State& state, const Target& target,
                                                  const NonsmoothReach& reach) {
  return Finder(model, state, target, reach).find();
}

bool any_nonsmooth_point_near(const JointModel& model, const State& state, const Target& target,
                              const NonsmoothReach& reach) {
  return Finder(model, state, target, reach).any();
}

}  // namespace genu
