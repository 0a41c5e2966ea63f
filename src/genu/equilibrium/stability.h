// Whether an equilibrium is stable: the eigenvalues of its tangent stiffness on what constraints and contacts leave
// free.
#pragma once

#include <string>
#include <vector>

#include "genu/equilibrium/tolerances.h"
#include "genu/model/linearization.h"

namespace genu {

struct Stability {
  enum class Verdict { stable, unstable, neutral };
  Verdict verdict = Verdict::stable;
  /// Smallest eigenvalue (real part) of the tangent stiffness, N m, in the metric where translations count in units of
  /// 10 mm and rotations in rad, twist about each moving body's own origin. +infinity where nothing is free to move.
  double smallest = 0;
  bool complex_pair = false;  ///< some eigenvalues are complex: whether motion grows depends on mass and damping
  bool flutter = false;       ///< the smallest belongs to one
  VecX mode;  ///< 6B: its motion in that metric, twist about the origins of the poses, unit norm (real part)
  bool unilateral = false;  ///< something lets go one way, or is stiffer there (unilateral_stability.h)
  std::string untold;       ///< why the verdict is not known; it is neutral then. Empty: it is
  MatX neutral;             ///< 6B x k: all motions that cost nothing, of an unstable pose too
  int free_motions = 0;
  /// Of constraints (their index) and contacts (M + index): those whose forces can be traded against one another, as
  /// they hold the same motion twice. Empty where all forces are determined.
  std::vector<int> redundant;
};

const char* to_string(Stability::Verdict verdict);

/// What tables say: the verdict, or flutter where a complex pair is what may move first: unless a real eigenvalue is
/// negative, and the smallest.
const char* to_string(const Stability& stability);

/// What twists (n = 6B) in that metric are multiplied with for m and rad, and wrenches for J.
VecX stability_metric(Eigen::Index n);

/// The tangent stiffness is -d(wrench)/d(twist) with the curvature of contacts and of constraints, times their
/// multipliers, included. At an equilibrium it is symmetric where every load has a potential (weights, dead forces,
/// loads toward a point), and unsymmetric where one has none (followers, dead moments, most loads scaled over a
/// coordinate): no load has to say which it is. `length_scale` (m) is the model's characteristic length.
Stability assess_stability(const Linearization& at, double length_scale);

/// What assess_stability() looks at.
struct FreeStiffness {
  MatX stiffness;       ///< 6B x 6B, J, of all motions in the metric
  MatX held;            ///< the gradients of what is held, rows of norm 1
  MatX basis;           ///< 6B x d, orthonormal: the motions that are free
  double known_to = 0;  ///< J: of its eigenvalues, by rounding and by the forces that do not balance
};

/// `cancelled` (J, in the metric): the size of terms that were taken out of the stiffness again, whose rounding is
/// still in it.
FreeStiffness free_stiffness(const Linearization& at, double length_scale, double cancelled = 0);

/// `motions` (columns, in the metric) with twists about the bodies' own origins in the file.
MatX about_own_origins(const Linearization& at, MatX motions);

/// Forces in balance among themselves, a column each, of norm 1 with what conforming surfaces exert besides: of
/// constraints, then contacts (positive where one presses more), per unit of the generalised force that each of them
/// can exert. Zeros where every force is determined. `dependent`: rows of norm 1 that are so near to a combination of
/// others are one.
MatX self_stresses(const Linearization& at, double length_scale, double dependent = kDependentRow);

/// The rows of `trades` (columns of norm 1) that take part in any by more than rounding, rising.
std::vector<int> taking_part(const MatX& self_stresses);

}  // namespace genu
