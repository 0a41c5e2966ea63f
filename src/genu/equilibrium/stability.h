// Stability of an equilibrium: eigenvalues of the tangent stiffness on the motions that constraints and contacts leave
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
  bool complex_pair = false;  ///< some eigenvalues are complex: growth of a motion then depends on mass and damping
  bool flutter = false;       ///< the smallest eigenvalue is one of a complex pair
  VecX mode;  ///< 6B: its motion in that metric, twist about the origins of the poses, unit norm (real part)
  bool unilateral = false;  ///< a unilateral or nonsmooth part takes part (unilateral_stability.h)
  std::string unknown_why;  ///< why the verdict is unknown; it is neutral then. Empty: it is known
  MatX neutral;             ///< 6B x k: all motions at no cost, of an unstable pose too
  int free_motions = 0;
  /// Constraints (index) and contacts (M + index) with statically indeterminate forces: members of some self-stress.
  /// Empty where all forces are determined.
  std::vector<int> redundant;
};

const char* to_string(Stability::Verdict verdict);

/// The word in tables: the verdict, or flutter where a complex pair may move first. If the smallest eigenvalue is real
/// and negative, it is unstable.
const char* to_string(const Stability& stability);

/// Factors that turn twists (n = 6B) of that metric into m and rad, and wrenches into J.
VecX stability_metric(Eigen::Index n);

/// The tangent stiffness is -d(wrench)/d(twist). It includes the curvature of contacts and of constraints times their
/// multipliers. At an equilibrium it is symmetric where every load has a potential (weights, dead forces, loads toward
/// a point), and unsymmetric otherwise (followers, dead moments, most loads scaled over a coordinate). This is found
/// from the matrix. `length_scale` (m): the model's characteristic length.
Stability assess_stability(const Linearization& at, double length_scale);

/// The matrices of assess_stability().
struct FreeStiffness {
  MatX stiffness;       ///< 6B x 6B, J: of all motions, in the metric
  MatX held;            ///< gradients of constraints and contacts, rows of norm 1
  MatX basis;           ///< 6B x d, orthonormal: the free motions
  double known_to = 0;  ///< J: accuracy of the eigenvalues: rounding, and forces out of balance
};

/// `cancelled` (J, in the metric): size of terms that were removed from the stiffness. Their rounding remains in it.
FreeStiffness free_stiffness(const Linearization& at, double length_scale, double cancelled = 0);

/// The same without the basis, whose cost grows with the cube of the number of bodies. `out` keeps its memory.
void tangent_stiffness(const Linearization& at, double length_scale, double cancelled, FreeStiffness& out);

/// `motions` (columns, in the metric), with twists taken about the bodies' own origins in the file.
MatX about_own_origins(const Linearization& at, MatX motions);

/// Self-stresses: forces in equilibrium with themselves, one column each, of norm 1 together with the forces of
/// conforming surfaces. Rows: constraints, then contacts (positive: more pressure), per unit of the generalised force
/// that each can exert. Zeros where all forces are determined. `dependent`: rows of norm 1 closer than this to a
/// combination of others count as dependent.
MatX self_stresses(const Linearization& at, double length_scale, double dependent = kDependentRow);

/// The rows of `self_stresses` (columns of norm 1) that take part in any by more than rounding, in ascending order.
std::vector<int> taking_part(const MatX& self_stresses);

}  // namespace genu
