// The Newton step of a linearization, by two routes to the same numbers.
//
//   dense       all 6B + M + 5N unknowns at once: the reference, and the fallback where a contact's own block is
//   singular eliminated  the four surface coordinates of each contact first (Schur complement), then 6B + M + N: the
//   fast route
// Rows and columns are scaled by the model's characteristic length and force.
#pragma once

#include <array>
#include <vector>

#include "genu/equilibrium/scaled_solver.h"
#include "genu/model/linearization.h"

namespace genu {

/// One more unknown, the parameter of the path, and one more equation: row . [twist, parameter] = 0. The bordered
/// Jacobian is regular at limit points (arc-length control).
struct Border {
  VecX wrench_rate;      ///< 6B: rate of the equilibrium residual with the parameter
  VecX constraint_rate;  ///< M: rate of the constraint residual
  VecX twist;            ///< 6B: the row
  double parameter = 1;  ///< its last entry
};

class NewtonStep {
 public:
  enum class Route { automatic, dense, eliminated };

  explicit NewtonStep(const JointModel& model) : model_(&model) {}

  /// Factors the Jacobian of `at`. False where it is not finite, or where `route` is eliminated and a contact block is
  /// singular.
  [[nodiscard]] bool factor(const Linearization& at, const Target& target, Route route = Route::automatic,
                            const Border* border = nullptr);

  /// The step for the residuals of `at`. These may belong to another state than the factored one: the result is then
  /// the simplified Newton correction of the monotonicity test.
  void solve(const Linearization& at, Correction& out);

  /// The change of the unknowns for given rates of the equilibrium and constraint residuals, contacts kept closed. For
  /// rates of loads and targets this is the tangent of the path.
  void solve_rates(const VecX& wrench_rate, const VecX& constraint_rate, Correction& out);

  /// After factor() with a border: the tangent of the path, scaled to row . [twist, parameter] = 1.
  void solve_direction(Correction& out);

  /// Largest scaled residual: forces / force scale, lengths / length scale, angles in rad, sines.
  double residual(const Linearization& at, const Target& target) const;

  /// Norm of a correction in scaled unknowns, of the system factored last.
  double norm(const Correction& correction) const;

  Route route() const { return route_; }
  const ScaledSolver& linear() const { return solver_; }
  /// Contacts with their surface coordinates eliminated. Valid after factor() by the eliminated route.
  const std::vector<EliminatedContact>& eliminated() const { return eliminated_; }

 private:
  void assemble_dense(const Linearization& at);
  bool eliminate(const Linearization& at);
  void assemble_eliminated(const Linearization& at);
  void set_scales(const Linearization& at, const Target& target);
  void add_border(const Border& border);
  void solve_and_unpack(Correction& out);

  const JointModel* model_;
  Route route_ = Route::automatic;
  ScaledSolver solver_;
  std::vector<EliminatedContact> eliminated_;
  std::vector<std::array<int, 2>> bodies_;
  MatX matrix_;
  VecX rhs_, x_, row_scale_, column_scale_;
  int twists_ = 0, constraints_ = 0, contacts_ = 0;
  bool bordered_ = false;
};

}  // namespace genu
