// Where a path leads next: extrapolated from its tangents at the last poses.
//
// With n tangents the prediction errs by the power n + 1 of the step: of the points of contact too, on surfaces whose
// retraction is of third order (Surface::retract) up to the fourth.
#pragma once

#include <array>

#include "genu/model/correction.h"

namespace genu {

/// How fast a path moves the bodies: the sum of their speeds, in characteristic lengths and rad per unit of t.
double path_speed(const JointModel& model, const Correction& tangent);

class PathPrediction {
 public:
  explicit PathPrediction(const JointModel& model) : model_(&model) {}

  /// Forgets what is behind: another step, other contacts.
  void forget() { known_ = 0; }

  /// The path has gone on by `span` (> 0) of t, from a pose with tangent `from` to one with tangent `to`: what drove
  /// and touched it then does so still.
  void went_on(double span, const Correction& from, const Correction& to);

  /// The state `h` of t beyond the last, `state`, with the tangent `tangent`. False, with `out` unspecified, where a
  /// contact point would leave what is known of its surface.
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
