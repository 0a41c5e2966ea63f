#include "hard_cases/population/energy_twin.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace genu::population {
namespace {

constexpr double kRadians = std::numbers::pi / 180, kArm = 20;

double ligament_energy(const Ligament& l, double slack, double length) {
  const double stretch = length - slack;
  if (l.law == Ligament::Law::spring) return 0.5 * l.stiffness * stretch * stretch;
  const double e = stretch / slack;
  if (e <= 0) return 0;
  if (l.law == Ligament::Law::quadratic) return l.stiffness * slack * e * e * e / 3;
  if (l.law == Ligament::Law::linear) return l.stiffness * slack * e * e / 2;
  const double t = l.transition;
  if (e <= t) return l.stiffness * slack * e * e * e / (6 * t);
  return l.stiffness * slack * (t * t / 6 + (e * e - t * t) / 2 - t * (e - t) / 2);
}

/// How far a shape whose axes are `axes` in the world reaches against `n` from its centre.
double reach(const Shape& shape, const Mat3& axes, const Vec3& n) {
  if (shape.kind == Shape::Kind::torus) {
    const double along = axes.col(2).dot(n);
    return shape.radii.x() * std::sqrt(std::max(0.0, 1 - along * along)) + shape.radii.y();
  }
  return shape.radii.cwiseProduct(axes.transpose() * n).norm();
}

}  // namespace

double distance(const TwinPose& a, const TwinPose& b) {
  return (a.translation - b.translation).norm() + std::abs(a.adduction - b.adduction) +
         std::abs(a.rotation - b.rotation);
}

EnergyTwin::EnergyTwin(const Knee& knee) : knee_(knee) {
  for (const Ligament& l : knee.ligaments) {
    const double length = (l.femur + knee.reference - l.tibia).norm();
    slack_.push_back(l.law == Ligament::Law::spring ? length - l.reference_strain / l.stiffness
                                                    : length / (1 + l.reference_strain));
  }
}

TwinPose EnergyTwin::reference() const { return {0, 0, knee_.reference}; }

Mat3 EnergyTwin::turn(double flexion, const Vec5& x) const {
  const Mat3 X(Eigen::AngleAxisd(flexion * kRadians, Vec3::UnitX())), Y(Eigen::AngleAxisd(x[0] / kArm, Vec3::UnitY())),
      Z(Eigen::AngleAxisd(x[1] / kArm, Vec3::UnitZ()));
  return knee_.flexion_last ? Mat3(Z * Y * X) : Mat3(X * Y * Z);
}

double EnergyTwin::energy(double flexion, const Vec5& x) const {
  const Mat3 R = turn(flexion, x);
  const Vec3 t = x.tail<3>();
  double sum = 0;
  for (std::size_t i = 0; i < slack_.size(); ++i) {
    const Ligament& l = knee_.ligaments[i];
    sum += ligament_energy(l, slack_[i], (R * l.femur + t - l.tibia).norm());
  }
  for (const Force& f : knee_.forces) sum -= f.begins * f.force.dot(R * f.point + t);
  return sum;
}

std::vector<double> EnergyTwin::gaps(double flexion, const Vec5& x) const {
  const Mat3 R = turn(flexion, x);
  std::vector<double> out;
  for (const Contact& c : knee_.contacts) {
    const Vec3 n = c.tibia.frame.axes.col(2), centre = R * c.femur.frame.origin + Vec3(x.tail<3>());
    out.push_back(n.dot(centre - c.tibia.frame.origin) - reach(c.femur, R * c.femur.frame.axes, n));
  }
  return out;
}

double EnergyTwin::lagrangian(double flexion, const Vec5& x, const std::vector<double>& forces,
                              double stiffness) const {
  double sum = energy(flexion, x);
  const std::vector<double> open = gaps(flexion, x);
  for (std::size_t i = 0; i < open.size(); ++i) {
    const double pushed = std::max(0.0, forces[i] - stiffness * open[i]);
    sum += (pushed * pushed - forces[i] * forces[i]) / (2 * stiffness);
  }
  return sum;
}

/// Damped Newton with derivatives by differences, until the slope is nothing. False where it does not get there. The
/// differences are of what is smooth alone: a contact's force changes its slope where it begins to push.
bool EnergyTwin::descend(double flexion, const std::vector<double>& forces, double stiffness, Vec5& x) const {
  constexpr double kStep = 2e-5, kFlat = 1e-4, kFarthest = 2;  // mm, N, mm
  constexpr int kMost = 300;
  const auto value = [&](const Vec5& at) { return lagrangian(flexion, at, forces, stiffness); };
  // Of the energy less the work of forces `pushed` at the contacts, as if they stayed.
  const auto slope = [&](const Vec5& at, const std::vector<double>& pushed) {
    const auto smooth = [&](const Vec5& there) {
      const std::vector<double> open = gaps(flexion, there);
      double sum = energy(flexion, there);
      for (std::size_t i = 0; i < open.size(); ++i) sum -= pushed[i] * open[i];
      return sum;
    };
    Vec5 out;
    for (int i = 0; i < 5; ++i) {
      const Vec5 h = kStep * Vec5::Unit(i);
      out[i] = (8 * (smooth(at + h) - smooth(at - h)) - (smooth(at + 2 * h) - smooth(at - 2 * h))) / (12 * kStep);
    }
    return out;
  };
  double damping = 0;
  for (int k = 0; k < kMost; ++k) {
    std::vector<double> pushed = gaps(flexion, x);
    for (std::size_t i = 0; i < pushed.size(); ++i) pushed[i] = std::max(0.0, forces[i] - stiffness * pushed[i]);
    const Vec5 g = slope(x, pushed);
    if (!g.allFinite()) return false;
    if (g.norm() < kFlat && k > 0) return true;
    Mat5 H;
    std::vector<Vec5> opens(pushed.size());
    for (int i = 0; i < 5; ++i) {
      const Vec5 h = 1e-4 * Vec5::Unit(i);
      H.col(i) = (slope(x + h, pushed) - slope(x - h, pushed)) / 2e-4;
      const std::vector<double> beyond = gaps(flexion, x + h), before = gaps(flexion, x - h);
      for (std::size_t c = 0; c < opens.size(); ++c) opens[c][i] = (beyond[c] - before[c]) / 2e-4;
    }
    for (std::size_t c = 0; c < opens.size(); ++c)
      if (pushed[c] > 0) H += stiffness * opens[c] * opens[c].transpose();
    H = (0.5 * (H + H.transpose())).eval();
    for (;; damping = std::max(4 * damping, 1e-3 * (1 + H.diagonal().cwiseAbs().maxCoeff()))) {
      const Eigen::LLT<Mat5> factors(H + damping * Mat5::Identity());
      if (factors.info() != Eigen::Success) continue;
      Vec5 step = -factors.solve(g);
      if (step.norm() > kFarthest) step *= kFarthest / step.norm();
      const double before = value(x), after = value(x + step);
      if (!(after <= before + 1e-12 * std::abs(before))) {
        if (damping > 1e14) return g.norm() < 100 * kFlat;
        continue;
      }
      x += step;
      break;
    }
    damping *= 0.1;
    if (damping < 1e-6) damping = 0;
    if (x.tail<3>().norm() > 500) return false;  // out of joint
  }
  return false;
}

std::optional<EnergyTwin::Minimum> EnergyTwin::minimise(double flexion, const TwinPose& start,
                                                        std::vector<double> forces, double stiffness) const {
  Vec5 x;
  x << start.adduction * kRadians * kArm, start.rotation * kRadians * kArm, start.translation;
  forces.resize(knee_.contacts.size(), 0.0);
  constexpr int kMost = 60;
  constexpr double kClosed = 1e-7;  // mm
  for (int round = 0; round < kMost; ++round) {
    if (!descend(flexion, forces, stiffness, x)) return std::nullopt;
    const std::vector<double> open = gaps(flexion, x);
    double worst = 0;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const double pushed = std::max(0.0, forces[i] - stiffness * open[i]);
      worst = std::max(worst, pushed > 0 ? std::abs(open[i]) : std::max(0.0, -open[i]));
      forces[i] = pushed;
    }
    if (worst < kClosed) {
      Minimum out;
      out.pose = {x[0] / kArm / kRadians, x[1] / kArm / kRadians, x.tail<3>()};
      out.forces = forces;
      return out;
    }
    stiffness = std::min(3 * stiffness, 3e3);
  }
  return std::nullopt;
}

}  // namespace genu::population
