// Another way to the same poses: the energy of ligaments and dead forces is minimised while convex femoral shapes stay
// above their planes (augmented Lagrangian, derivatives by differences). No equation of genu's, no code of genu's.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "hard_cases/population/knee_spec.h"

namespace genu::population {

struct TwinPose {
  double adduction = 0, rotation = 0;  ///< deg
  Vec3 translation = Vec3::Zero();     ///< mm
};

/// How far apart two poses are: mm plus deg.
double distance(const TwinPose& a, const TwinPose& b);

class EnergyTwin {
 public:
  /// `knee` is comparable() and stays; forces that begin at 0 are left out.
  explicit EnergyTwin(const Knee& knee);

  struct Minimum {
    TwinPose pose;
    std::vector<double> forces;  ///< N, one for each contact
  };

  /// The minimum at the bottom of the slope from `start` at a flexion in deg; empty where the search does not end. It
  /// begins with these contact forces (N; none where left out) and gaps that cost `stiffness` (N/mm).
  std::optional<Minimum> minimise(double flexion, const TwinPose& start, std::vector<double> forces = {},
                                  double stiffness = 300) const;

  /// From the pose with the angles 0 in which slack lengths are defined.
  TwinPose reference() const;

 private:
  using Vec5 = Eigen::Matrix<double, 5, 1>;  ///< angles times kArm, translations: all in mm
  using Mat5 = Eigen::Matrix<double, 5, 5>;

  double energy(double flexion, const Vec5& x) const;
  std::vector<double> gaps(double flexion, const Vec5& x) const;
  double lagrangian(double flexion, const Vec5& x, const std::vector<double>& forces, double stiffness) const;
  bool descend(double flexion, const std::vector<double>& forces, double stiffness, Vec5& x) const;
  Mat3 turn(double flexion, const Vec5& x) const;

  const Knee& knee_;
  std::vector<double> slack_;  ///< mm
};

}  // namespace genu::population
