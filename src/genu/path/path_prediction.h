// Predicts the next pose of a path from the tangents at the last poses.
//
// With n tangents the error is of order n + 1 in the step. For contact points, whose retraction is of third order
// (Surface::retract), it is at most of fourth order.
#pragma once

#include <array>

#include "genu/model/correction.h"

namespace genu {

/// Speed of the bodies along a path: sum of their speeds, in characteristic lengths and rad per unit of t.
double path_speed(const JointModel& model, const Correction& tangent);

class PathPrediction {
 public:
  explicit PathPrediction(const JointModel& model) : model_(&model) {}

  /// Forgets the last poses: another step, another active set.
  void forget() { known_ = 0; }

  /// The path continued by `span` (> 0) of t, from a pose with tangent `from` to one with tangent `to`, with the same
  /// loads and contacts.
  void went_on(double span, const Correction& from, const Correction& to);

  /// The state at distance `h` of t beyond `state`, the last one, with tangent `tangent`. False, with `out`
  /// unspecified, where a contact point would leave the known part of its surface.
  bool at(const State& state, const Correction& tangent, double h, State& out);

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(differences_, behind_, known_);
  }

 private:
  static constexpr std::size_t kMaxDifferences = 3;

  const JointModel* model_;
  std::array<Correction, kMaxDifferences> differences_;  ///< of the tangent: Newton's divided ones, the first one first
  std::array<double, kMaxDifferences> behind_{};  ///< t of the poses before the last, the nearest first, from it (< 0)
  std::size_t known_ = 0;                         ///< how many of both
  Correction way_, newer_, older_;
};

}  // namespace genu
