#include "genu/motion/wrenches.h"

#include "genu/model/linearization.h"
#include "genu/model/twist.h"

namespace genu {
namespace {

/// A point of a body: its arm from the body's origin, and its velocity (world axes).
struct BodyPoint {
  int moving;
  Vec3 arm, place, velocity;
};

BodyPoint point_of(const State& state, const VecX& twist, const LigamentPath::Point& point) {
  const Pose& X = state.poses[at(point.body)];
  BodyPoint out{point.moving, X.R * point.p, {}, Vec3::Zero()};
  out.place = X.p + out.arm;
  if (out.moving >= 0)
    out.velocity = twist.segment<3>(6 * out.moving) + twist.segment<3>(6 * out.moving + 3).cross(out.arm);
  return out;
}

void add_force(const BodyPoint& point, const Vec3& force, VecX& wrench) {
  if (point.moving < 0) return;
  wrench.segment<3>(6 * point.moving) += force;
  wrench.segment<3>(6 * point.moving + 3) += point.arm.cross(force);
}

/// A straight line of a ligament, from the one body to the other.
struct MovingLine {
  BodyPoint a, b;
  Vec3 direction;  ///< unit; 0 where the ends meet
  double length, rate;
};

MovingLine line_between(const State& state, const VecX& twist, const LigamentPath::Point& a,
                        const LigamentPath::Point& b) {
  MovingLine out{point_of(state, twist, a), point_of(state, twist, b), Vec3::Zero(), 0, 0};
  const Vec3 d = out.b.place - out.a.place;
  out.length = d.norm();
  if (out.length > 0) out.direction = d / out.length;
  if (out.a.moving != out.b.moving) out.rate = out.direction.dot(out.b.velocity - out.a.velocity);
  return out;
}

/// `tension` pulls the ends together.
void add_pull_along(const MovingLine& line, double tension, VecX& wrench) {
  if (tension == 0 || line.a.moving == line.b.moving) return;  // within one body it cancels
  add_force(line.a, tension * line.direction, wrench);
  add_force(line.b, -tension * line.direction, wrench);
}

void add_wrench(const JointModel& model, int body, const Vec6& part, VecX& wrench) {
  const int k = body < 0 ? -1 : model.bodies[at(body)].moving;
  if (k >= 0) wrench.segment<6>(6 * k) += part;
}

}  // namespace

double add_ligament_wrenches(const JointModel& model, const State& state, const std::vector<DamperMode>& modes,
                             const VecX& twist, VecX& wrench) {
  double taken = 0;
  auto piece = state.pieces.begin();
  for (std::size_t i = 0; i < model.ligaments.size(); ++i) {
    const auto& l = model.ligaments[i];
    const bool has_piece = piece != state.pieces.end() && at(piece->ligament) == i;
    const int k = has_piece && !piece->by_length ? piece->piece : LigamentLaw::kByLength;
    if (has_piece) ++piece;
    const auto pull = [&](double length, double rate) {
      const double tension = l.law.evaluate(length, k).force;
      const double damper = l.damping == 0 ? 0 : damper_tension(l, modes[i], tension, rate);
      taken += damper * rate;
      return tension + damper;
    };
    if (l.path.is_straight()) {
      const MovingLine line = line_between(state, twist, l.path.from(), l.path.to());
      add_pull_along(line, pull(line.length, line.rate), wrench);
      continue;
    }
    const auto each_line = [&](const auto& f) {
      l.path.for_each_line(state.wraps, [&](const LigamentPath::Point& a, const LigamentPath::Point& b,
                                            const TautLine&) { f(line_between(state, twist, a, b)); });
    };
    double length = 0, rate = 0;
    each_line([&](const MovingLine& line) {
      length += line.length;
      rate += line.rate;
    });
    const double tension = pull(length, rate);
    each_line([&](const MovingLine& line) { add_pull_along(line, tension, wrench); });
  }
  return taken;
}

double add_load_wrenches(const JointModel& model, const State& state, const Target& target, const VecX& twist,
                         VecX& wrench) {
  double power = 0;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    const double factor = target.load_factors[i] * load_scale_in_motion(model, load, state, target.time, twist);
    if (load.kind == Load::Kind::coordinate || factor == 0) continue;
    const Vec12 unit = load_wrench(model, state, load).wrench;
    const Vec6 on_a = factor * unit.head<6>(), on_b = factor * unit.tail<6>();
    add_wrench(model, load.body_a, on_a, wrench);
    add_wrench(model, load.body_b, on_b, wrench);
    power += on_a.dot(twist_of_body(model, load.body_a, twist)) + on_b.dot(twist_of_body(model, load.body_b, twist));
  }
  return power;
}

void add_weight_wrenches(const JointModel& model, const State& state, VecX& wrench) {
  for (const Load& weight : model.weights)
    add_wrench(model, weight.body_a, load_wrench(model, state, weight).wrench.head<6>(), wrench);
}

}  // namespace genu
