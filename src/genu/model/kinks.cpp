#include "genu/model/kinks.h"

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
  Finder(const JointModel& model, const State& state, const Target& target, double near, double force)
      : model_(model), state_(state), target_(target), near_(near), force_(force) {}

  std::vector<Kink> find() {
    for (std::size_t i = 0; i < model_.ligaments.size(); ++i) add_ligament(i);
    for (const JointSpring& spring : model_.joint_springs) add_stops(spring);
    for (std::size_t i = 0; i < model_.loads.size(); ++i)
      if (target_.load_factors[i] != 0) add_scale(model_.loads[i], target_.load_factors[i]);
    for (const Load& weight : model_.weights) add_scale(weight, 1);
    return std::move(out_);
  }

 private:
  /// Of several that the pose is so near to, the stiffness below the first and above the last.
  static void meet(double past, double below, double above, std::optional<Kink>& kink) {
    if (!kink) kink = Kink{.past = past, .below = below};
    if (std::abs(past) < std::abs(kink->past)) kink->past = past;
    kink->above = above;
  }

  void add_ligament(std::size_t i) {
    const auto& l = model_.ligaments[i];
    const LigamentLaw& law = l.ligament.law;
    if (law.breaks().empty()) return;
    const double length = ligament_length(l, state_.poses);
    const auto piece = std::find_if(state_.pieces.begin(), state_.pieces.end(),
                                    [&](const LigamentPiece& p) { return at(p.ligament) == i && !p.by_length; });
    if (piece != state_.pieces.end() && piece->held) return;
    const LawValue pull = law.evaluate(length, piece == state_.pieces.end() ? LigamentLaw::kByLength : piece->piece);
    std::optional<Kink> kink;
    bool begun = false;
    for (const LawBreak& b : law.breaks()) {
      const double past = length - b.length;
      const bool begins = pull.force != 0 && std::abs(pull.force) <= force_ && (past > 0 ? b.below : b.above).slack;
      if (b.jumps() || (!begins && std::abs(past) > near_ * model_.scales.length)) continue;
      meet(past, b.below.stiffness, b.above.stiffness, kink);
      begun = begun || begins;
    }
    if (!kink || (kink->below == kink->above && kink->below != 0)) return;
    const VecX gradient = ligament_length_gradient(model_, l, state_.poses);
    if (begun) kink->force = pull.force;
    add(*kink, model_.scales.length, pull.stiffness, gradient, -gradient);
  }

  void add_stops(const JointSpring& spring) {
    const double angle = state_.coordinates[at(spring.joint)][0], within = -spring.stiffness,
                 beyond = within - spring.stop;
    std::optional<Kink> kink;
    if (std::abs(angle - spring.lower) <= near_) meet(angle - spring.lower, beyond, within, kink);
    if (std::abs(angle - spring.upper) <= near_) meet(angle - spring.upper, within, beyond, kink);
    if (!kink || kink->below == kink->above) return;
    const VecX gradient = gradient_of({spring.joint, 0});
    add(*kink, 1, spring.slope(angle), gradient, gradient);
  }

  void add_scale(const Load& load, double factor) {
    if (!load.scale || !load.scale->coordinate()) return;
    const CoordinateRef q = *load.scale->coordinate();
    const double value = state_.coordinates[at(q.joint)][at(q.index)], unit = q.index < 3 ? 1 : model_.scales.length;
    std::optional<Kink> kink;
    for (const LoadScale::Kink& k : load.scale->kinks_over_coordinate())
      if (std::abs(value - k.x) <= near_ * unit) meet(value - k.x, factor * k.below, factor * k.above, kink);
    if (!kink || kink->below == kink->above) return;
    const VecX wrench = scattered(load_wrench(model_, state_, load).wrench, load.body_a, load.body_b);
    add(*kink, unit, factor * load.scale->evaluate(value).slope, gradient_of(q), wrench);
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

  void add(Kink kink, double unit, double here, const VecX& gradient, const VecX& wrench) {
    kink.unit = unit;
    kink.here = here;
    kink.gradient = gradient;
    kink.wrench = wrench;
    out_.push_back(std::move(kink));
  }

  const JointModel& model_;
  const State& state_;
  const Target& target_;
  const double near_, force_;
  std::vector<Kink> out_;
};

}  // namespace

std::vector<Kink> kinks_near(const JointModel& model, const State& state, const Target& target, double near,
                             double force) {
  return Finder(model, state, target, near, force).find();
}

}  // namespace genu
