#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "genu/core/units.h"
#include "genu/judge/pose.h"
#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

/// What acts on the bodies that a joint carries, about its child's origin, in the world.
struct Sum {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double forces = 0, moments = 0, levers = 0;  ///< sums of sizes: N, N m, N m

  void add(const Force& f, const Vec3& about) {
    const Vec3 arm = f.point - about;
    force += f.force;
    moment += f.moment + arm.cross(f.force);
    forces += f.force.norm();
    moments += f.moment.norm();
    levers += arm.norm() * f.force.norm();
  }
};

/// One equation: the force along a coordinate plus its reaction is zero.
struct Equation {
  std::string name;
  bool rotation = false;
  int joint = 0;
  Vec3 origin, v, w;  ///< of the motion along the coordinate
  std::vector<bool> carried;
  double value = 0, tolerance = 0;
};

class Balance {
 public:
  Balance(const PoseCase& pose, PoseForces& forces, double more_force, double more_moment)
      : pose_(pose), forces_(forces), more_force_(more_force), more_moment_(more_moment) {}

  void judge() {
    const Scene& scene = pose_.scene();
    for (int j = 0; j < static_cast<int>(scene.joints.size()); ++j) add_joint(j);
    turn_loose();
    for (const Equation& e : equations_)
      pose_.out->expect(e.rotation ? "balance of moments" : "balance of forces", e.rotation ? "N m" : "N",
                        std::abs(e.value), e.tolerance, e.name);
  }

 private:
  double reaction(const CoordinateRef& c) const {
    const Scene& scene = pose_.scene();
    const auto written = [&](const QuantityRef& q) {
      const double r = pose_.row(quantity_name(scene, q) + ".reaction" + (q.is_rotation() ? "_Nm" : "_N"));
      return std::isfinite(r) ? r : 0;
    };
    double sum = written(QuantityRef(c));
    for (int k = 0; k < static_cast<int>(scene.combinations.size()); ++k)
      for (const auto& term : scene.combinations[at(k)].terms)
        if (term.coordinate == c) sum += term.factor * written({scene.combinations[at(k)].terms.front().coordinate, k});
    return sum;
  }

  /// N m or N: loads on the coordinate itself, springs and dampers of joints, and reactions.
  double along(const CoordinateRef& c, double& size) const {
    double sum = reaction(c);
    size += std::abs(sum);
    for (const auto& g : forces_.generalised)
      if (g.coordinate == c) {
        sum += g.value;
        size += std::abs(g.value);
      }
    return sum;
  }

  Sum sum_of(const std::vector<bool>& carried, const Vec3& about) const {
    Sum sum;
    for (const Force& f : forces_.forces)
      if (carried[at(f.body)]) sum.add(f, about);
    for (const LooseForce& f : forces_.loose) {
      const Vec3 on_a = 0.5 * f.size * (f.normal_b - f.normal_a).normalized();
      for (const bool a : {true, false})
        if (carried[at(a ? f.body_a : f.body_b)]) {
          sum.forces += 2 * on_a.norm();
          sum.levers += 2 * (f.point - about).norm() * on_a.norm();
        }
    }
    return sum;
  }

  /// Where almost no force acts.
  double least_force() const { return pose_.subject->least_force + pose_.slack * pose_.subject->force_scale; }
  double force_tolerance(const Sum& s) const {
    return (kBalanceTolerance + pose_.slack) * s.forces + more_force_ + least_force() +
           pose_.rounding * pose_.subject->springs;
  }
  double moment_tolerance(const Sum& s) const {
    const double size = pose_.subject->size;
    return (kBalanceTolerance + pose_.slack) * (s.forces * size + s.moments) + kLeverRounding * s.levers +
           s.forces * pose_.rounding + more_moment_ + (least_force() + pose_.rounding * pose_.subject->springs) * size;
  }

  void add_joint(int j) {
    const JointDef& joint = pose_.scene().joints[at(j)];
    const Vec3 origin = pose_.poses[at(joint.child)].p;
    const std::vector<bool> carried = carried_by(pose_.scene(), j);
    const Sum sum = sum_of(carried, origin);
    for (int i = 0; i < 6; ++i) {
      if (!joint.leaves(i)) continue;
      const Motion m = motion_of(pose_.scene(), pose_.q, pose_.poses, j, i);
      double size = 0;
      Equation e{coordinate_name(pose_.scene(), {j, i}), i < 3, j, origin, m.v, m.w, carried};
      e.value = sum.force.dot(m.v) + sum.moment.dot(m.w) + along({j, i}, size);
      e.tolerance = (i < 3 ? moment_tolerance(sum) : force_tolerance(sum)) + (kBalanceTolerance + pose_.slack) * size;
      equations_.push_back(std::move(e));
    }
    if (joint.type != JointDef::Type::free) add_held(j, origin, carried, sum);
  }

  /// A joint's own force and moment against the sum of the others: six equations, in the parent's axes.
  void add_held(int j, const Vec3& origin, const std::vector<bool>& carried, const Sum& sum) {
    const JointDef& joint = pose_.scene().joints[at(j)];
    const Mat3& R = pose_.poses[at(joint.parent)].R;
    double size = 0;
    const Vec3 axis = joint.type == JointDef::Type::revolute ? joint.rotations[0].axis : Vec3(Vec3::Zero());
    const double about = joint.type == JointDef::Type::revolute ? along({j, 0}, size) : 0;
    static constexpr const char* kAxes = "xyz";
    for (int i = 0; i < 3; ++i) {
      const std::string axis_name(1, kAxes[i]);
      const double f = pose_.row(joint.name + ".reaction.force_" + axis_name + "_N");
      const double m = pose_.row(joint.name + ".reaction.moment_" + axis_name + "_Nm");
      if (!std::isfinite(f) || !std::isfinite(m)) {
        pose_.out->expect("balance of forces", "N", f, 0, joint.name + ".reaction");
        continue;
      }
      Equation force{joint.name + ".reaction.force_" + axis_name, false, j, origin, R.col(i), Vec3::Zero(), carried};
      force.value = sum.force.dot(R.col(i)) + f;
      force.tolerance = force_tolerance(sum) + kBalanceTolerance * std::abs(f);
      Equation moment{joint.name + ".reaction.moment_" + axis_name, true, j, origin, Vec3::Zero(), R.col(i), carried};
      moment.value = sum.moment.dot(R.col(i)) + m + about * axis[i];
      moment.tolerance = moment_tolerance(sum) + kBalanceTolerance * (std::abs(m) + size);
      equations_.push_back(std::move(force));
      equations_.push_back(std::move(moment));
    }
  }

  /// The work of a loose contact's force of direction n (on A) along an equation's motion.
  static double work(const Equation& e, const LooseForce& f, const Vec3& force_on_a) {
    const Vec3 along = e.v + e.w.cross(f.point - e.origin);
    const double on = (e.carried[at(f.body_a)] ? 1 : 0) - (e.carried[at(f.body_b)] ? 1 : 0);
    return on * along.dot(force_on_a);
  }

  /// Turns the directions of loose contact forces away from the facets' normals as little as necessary to satisfy all
  /// equations within tolerance (Tikhonov regularisation, discrepancy principle). Then checks that they lie within the
  /// cones.
  void turn_loose() {
    const std::size_t n = forces_.loose.size();
    if (n == 0) return;
    const auto rows = static_cast<Eigen::Index>(equations_.size()), unknowns = static_cast<Eigen::Index>(2 * n);
    std::vector<Vec3> direction(n);
    std::vector<double> length(n);  // of the vectors to be normalised, for exact derivatives: two nearly parallel
                                    // forces can turn far against each other before a sum shows it
    std::vector<std::array<Vec3, 3>> frame;  // the facets' normal, and two axes across it, one cone width per unit
    for (const LooseForce& f : forces_.loose) {
      const Vec3 middle = (f.normal_b - f.normal_a).normalized(), one = middle.unitOrthogonal();
      const double most = std::max(std::min(f.turn_a, f.turn_b), 1e-6);
      frame.push_back({middle, most * one, most * middle.cross(one)});
    }
    VecX x = VecX::Zero(unknowns), left(rows);
    const auto leave = [&] {
      for (std::size_t c = 0; c < n; ++c) {
        const auto k = static_cast<Eigen::Index>(2 * c);
        direction[c] = frame[c][0] + x[k] * frame[c][1] + x[k + 1] * frame[c][2];
        length[c] = direction[c].norm();
        direction[c] /= length[c];
      }
      for (Eigen::Index i = 0; i < rows; ++i) {
        const Equation& e = equations_[static_cast<std::size_t>(i)];
        left[i] = e.value;
        for (std::size_t c = 0; c < n; ++c) left[i] += work(e, forces_.loose[c], forces_.loose[c].size * direction[c]);
        left[i] /= std::max(e.tolerance, 1e-300);
      }
    };
    leave();
    MatX J = MatX::Zero(rows + unknowns, unknowns);
    VecX right(rows + unknowns);
    const auto balanced = [&] { return left.cwiseAbs().maxCoeff() <= 0.5; };
    const auto turn = [&](double hold) {
      for (std::size_t c = 0; c < n; ++c)
        for (std::size_t side = 1; side < 3; ++side) {
          const auto k = static_cast<Eigen::Index>(2 * c + side - 1);
          const Vec3 turned = (frame[c][side] - direction[c].dot(frame[c][side]) * direction[c]) / length[c];
          for (Eigen::Index i = 0; i < rows; ++i) {
            const Equation& e = equations_[static_cast<std::size_t>(i)];
            J(i, k) = work(e, forces_.loose[c], forces_.loose[c].size * turned) / std::max(e.tolerance, 1e-300);
          }
          J(rows + k, k) = hold;
        }
      right << -left, -hold * x;
      x += J.colPivHouseholderQr().solve(right);
      leave();
    };
    for (double hold = kStiffestHold; hold > kSoftestHold && !balanced(); hold /= 4)
      for (int round = 0; round < 3; ++round) turn(hold);
    // The forces of two contacts can turn together about their sum. Beyond the point where their moment is largest,
    // every direction leads away from balance, so other starts within the cones are tried.
    for (Eigen::Index k = 0; k < 2 * unknowns && !balanced(); ++k) {
      const VecX before = x;
      const double missed = left.cwiseAbs().maxCoeff();
      x.setZero();
      x[k / 2] = k % 2 == 0 ? 1 : -1;
      leave();
      for (int round = 0; round < kMaxConeRounds && !balanced(); ++round) turn(kSoftestHold);
      if (left.cwiseAbs().maxCoeff() < missed) continue;
      x = before;
      leave();
    }
    for (Eigen::Index i = 0; i < rows; ++i) {
      Equation& e = equations_[static_cast<std::size_t>(i)];
      e.value = left[i] * std::max(e.tolerance, 1e-300);
    }
    for (std::size_t c = 0; c < n; ++c) {
      const LooseForce& f = forces_.loose[c];
      const auto angle = [&](const Vec3& normal) {
        return to::kDegree * std::atan2(direction[c].cross(normal).norm(), direction[c].dot(normal));
      };
      for (const auto& [normal, cone] : {std::pair(Vec3(f.normal_b), f.turn_b), std::pair(Vec3(-f.normal_a), f.turn_a)})
        pose_.out->expect("directions of contact forces", "deg", angle(normal), to::kDegree * cone + kMinCone, f.name);
    }
  }

  const PoseCase& pose_;
  PoseForces& forces_;
  double more_force_, more_moment_;
  std::vector<Equation> equations_;
};

}  // namespace

void check_balance(const PoseCase& pose, PoseForces& forces, double more_force, double more_moment) {
  if (forces.incomplete) return;
  Balance(pose, forces, more_force, more_moment).judge();
}

}  // namespace genu::judge
