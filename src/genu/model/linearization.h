// The equations of a pose, 6B + M + 5N of them (Dortmans 1984), and their exact derivatives at a state.
//
//   equilibrium  6 for each moving body: ligaments + loads + joint springs + contact forces + multipliers = 0
//   constraints  M: prescribed coordinate, or combination of some, = target; coordinate that a joint holds = its value;
//                and H: length of a ligament held at a jump of its force = the jump's
//   contacts     5 each: closure 2, gap 1, tangency 2 (contact_equations.h)
// The unknowns are the twist of each moving body, M + H multipliers, and for each contact ds_A, ds_B and the force.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "genu/contact/contact_equations.h"
#include "genu/core/cancelled.h"
#include "genu/model/correction.h"
#include "genu/model/state.h"

namespace genu {

struct LayerMemories;

/// In SI and unscaled, so that each block can be checked separately.
struct Linearization {
  VecX wrench;     ///< 6B: total wrench on each moving body, 0 at equilibrium
  MatX stiffness;  ///< 6B x 6B: its derivative to the twists at fixed contact points and forces
  MatX
      gradient;  ///< (M + H) x 6B: gradients of prescribed quantities, of coordinates held by joints, of held ligaments
  VecX constraint;  ///< M + H: value - target; target - length for a held ligament
  /// A multiplier that is the factor of loads, not a reaction along the gradient of its constraint.
  struct LoadColumn {
    Eigen::Index row = 0;  ///< of the constraint
    VecX wrench;           ///< 6B: of the loads with factor 1
  };
  std::vector<LoadColumn> load_columns;
  std::vector<ContactBlock> contacts;
  /// What earlier poses have shown of each elastic layer. Linearizations used in turn share it.
  std::shared_ptr<LayerMemories> layers;
  std::vector<double> layer_loads;                 ///< N, of each elastic layer: sum of p dA
  std::vector<double> layer_errors;                ///< N, estimated error of it
  double layer_damped = 0;                         ///< W: power dissipated by elastic layers, in motion
  VecX layer_wrench;                               ///< 6B: part of `wrench` from elastic layers; empty without any
  VecX length_gradient;                            ///< 6B: of the last ligament that is not straight (reused memory)
  TwoBodyWrench pull;                              ///< of the last straight ligament (reused memory)
  std::vector<std::array<int, 2>> contact_bodies;  ///< moving index of a and b of each contact, -1 where fixed
  bool derivatives = true;                         ///< false: derivatives are missing or belong to an earlier state
  /// 3B: from the reference point of each moving body's twist to the body's own origin in the file, world axes, m;
  /// empty where they coincide for every body
  VecX own_origins;
};

/// Values and derivatives of a joint's coordinates at `state`.
JointPoint joint_point(const JointModel& model, const State& state, int joint);

/// A load with factor 1, without scales, that is no cable.
LoadWrench load_wrench(const JointModel& model, const State& state, const Load& load);

/// Adds a load of any kind times `factor`, without its scale, to the wrench on each moving body (6B).
void add_load_wrench(const JointModel& model, const State& state, const Load& load, double factor, VecX& wrench);

enum class Derivatives { all, none };

/// Evaluates residual and derivatives at `state`, whose coordinates must be those of its poses (update_coordinates()).
/// `out` keeps its memory from call to call. Derivatives::none: residuals only, at a fraction of the cost; `stiffness`
/// and the derivatives of `contacts` are then invalid.
void linearize(const JointModel& model, const State& state, const Target& target, Linearization& out,
               Derivatives wanted = Derivatives::all);

/// Makes linearize() stop the quadrature of elastic layers once `cancelled` is true; the wrench is then not finite.
void stop_layers_when(const Cancelled& cancelled, Linearization& out);

/// Without constraints and rigid contacts: `wrench` and `stiffness` of all terms without unknowns of their own. With a
/// `twist` (6B) elastic layers are damped and feedback has its term with rates; the stiffness includes neither.
void linearize_forces(const JointModel& model, const State& state, const Target& target, Linearization& out,
                      const VecX* twist = nullptr);

/// Constraints only: `gradient` and `constraint` of `out`; wrench and stiffness contain the effect of the multipliers.
void linearize_constraints(const JointModel& model, const State& state, const Target& target, Linearization& out);

/// The scale of a load at a state and a time (s); 1 without a scale. Of feedback without its term with rates.
LoadScale::Value load_scale(const Load& load, const State& state, double time);

/// The scale in motion, with `twist` (6B) for the rate of feedback's coordinate.
double load_scale_in_motion(const JointModel& model, const Load& load, const State& state, double time,
                            const VecX& twist);

/// Rate of the wrench on each moving body (6B) with the path's parameter at fixed poses, from step factors and scales
/// over time. `rate`: derivative of `target`.
VecX load_rate(const JointModel& model, const State& state, const Target& target, const Target& rate);

/// Rate of the residuals of `count` constraints. Prescribed values change; the length of a held ligament is constant.
VecX constraint_rate(const Target& rate, Eigen::Index count);

/// The reaction of a revolute or fixed joint on its child: [force, moment about the child's origin] in the parent's
/// axes (N, N m). The multipliers must be those of a solved state. The moment about a revolute axis (stiffness,
/// prescribed angle) is not included.
Vec6 joint_reaction(const JointModel& model, const State& state, int joint);

}  // namespace genu
