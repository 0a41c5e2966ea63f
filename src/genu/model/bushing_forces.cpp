#include "genu/model/bushing_forces.h"

#include "genu/model/twist.h"
#include "genu/model/two_body_scatter.h"

namespace genu {
namespace {

TwoBodyScatter scatter_of(const JointModel& model, const Bushing& b) {
  return {model.bodies[at(b.body_a)].moving, model.bodies[at(b.body_b)].moving};
}

BushingPoint point_of(const Bushing& b, const State& state) {
  return {b, state.poses[at(b.body_a)], state.poses[at(b.body_b)]};
}

}  // namespace

void add_bushings(const JointModel& model, const State& state, VecX& wrench, MatX* stiffness) {
  for (const Bushing& b : model.bushings) {
    const BushingPoint point = point_of(b, state);
    const TwoBodyScatter scatter = scatter_of(model, b);
    const Vec6 f = -b.stiffness * point.displacement();
    scatter.add_wrench(point.wrench(f), wrench);
    if (stiffness == nullptr) continue;
    const Eigen::Matrix<double, 6, 12> G = point.gradient();
    scatter.add_stiffness(point.wrench_rate(f) - G.transpose() * (b.stiffness * G), *stiffness);
  }
}

double add_bushing_dampers(const JointModel& model, const State& state, const VecX& twist, VecX& wrench) {
  double power = 0;
  for (const Bushing& b : model.bushings) {
    if (b.damping.isZero(0)) continue;
    const BushingPoint point = point_of(b, state);
    Vec12 twists;
    twists << twist_of_body(model, b.body_a, twist), twist_of_body(model, b.body_b, twist);
    const Vec6 rate = point.gradient() * twists, force = b.damping * rate;
    power += rate.dot(force);
    scatter_of(model, b).add_wrench(point.wrench(-force), wrench);
  }
  return power;
}

}  // namespace genu
