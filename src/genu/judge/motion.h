// Checks of the rows of a motion: rates against differences of the coordinates, and Newton's and Euler's equations with
// accelerations from differences of the rates.
#pragma once

#include <optional>
#include <vector>

#include "genu/judge/pose.h"

namespace genu::judge {

class MotionRows {
 public:
  /// `rows`: the judged rows, in the table's order.
  MotionRows(const Subject& subject, const ResultsFile& table, const std::vector<std::size_t>& rows);

  /// Judges the k-th of the rows.
  void judge(std::size_t k, bool surfaces, Findings& out) const;

 private:
  /// Linear and angular momentum of a body about its centre of mass, and that centre.
  struct Momentum {
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero(), centre = Vec3::Zero();
  };
  struct At {
    double time = 0;
    Coordinates q, rates;
    std::vector<Momentum> momentum;  ///< of each body
    /// The active formula of each ligament, limit and contact: where it changes, accelerations are nonsmooth.
    std::vector<int> pieces;
  };
  At read(std::size_t row) const;
  std::vector<Motion> velocities(const Coordinates& q, const Coordinates& rates, const std::vector<Pose>& poses) const;
  std::vector<int> pieces_in(const Row& row, const At& here) const;
  /// Whether rows k - reach ... k + reach exist, have equal intervals, and have no nonsmooth point between them.
  bool smooth(std::size_t k, std::size_t reach, double& interval) const;
  bool knot_between(double from, double to) const;
  /// Slope of row values at row k with an error bound: the largest difference between two orders here and beside it.
  template <typename Value, typename Get>
  Value slope_at(std::size_t k, double h, Get get, double& error) const;
  void check_courses(const PoseCase& pose, const At& here) const;
  void check_rates(std::size_t k, const PoseCase& pose, Findings& out) const;
  std::vector<Motion> missed(std::size_t k, double h) const;
  bool add_inertia(std::size_t k, PoseForces& forces, double& unsure_force, double& unsure_moment) const;

  const Subject& subject_;
  const ResultsFile& table_;
  std::vector<std::size_t> rows_;
  std::vector<At> at_;
};

}  // namespace genu::judge
