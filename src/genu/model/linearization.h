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

/// Everything in SI and unscaled, so that each block can be read and checked by itself.
struct Linearization {
  VecX wrench;      ///< 6B: total wrench on each moving body, 0 at equilibrium
  MatX stiffness;   ///< 6B x 6B: its derivative to the twists with contact points and forces held
  MatX gradient;    ///< (M + H) x 6B: derivative of the constraints: prescribed, held by joints, held ligaments
  VecX constraint;  ///< M + H: value - target; target - length for a held ligament
  std::vector<ContactBlock> contacts;
  /// Of each elastic layer, what earlier poses have shown: linearizations that are used in turn share it.
  std::shared_ptr<LayerMemories> layers;
  std::vector<double> layer_loads;   ///< N, of each elastic layer: sum of p dA
  std::vector<double> layer_errors;  ///< N, and its error, estimated
  double layer_damped = 0;           ///< W: what elastic layers take, in motion
  VecX layer_wrench;                 ///< 6B: what of `wrench` elastic layers exert; empty without any
  VecX length_gradient;              ///< 6B: of the last ligament that is not straight (kept here for its memory)
  TwoBodyWrench pull;                ///< of the last straight ligament (kept here for its memory)
  std::vector<std::array<int, 2>> contact_bodies;  ///< moving index of a and b of each contact, -1 where fixed
  bool derivatives = true;                         ///< false: those of an earlier state, or none
  /// 3B: from the origin that each moving body's twist means to the body's own in the file, world axes, m; empty where
  /// they are the same for every body
  VecX own_origins;
};

/// Values and derivatives of a joint's coordinates at `state`.
JointPoint joint_point(const JointModel& model, const State& state, int joint);

/// A load at the factor 1, scales not included.
LoadWrench load_wrench(const JointModel& model, const State& state, const Load& load);

enum class Derivatives { all, none };

/// Evaluates residual and derivatives at `state`, whose coordinates are those of its poses (update_coordinates());
/// `out` keeps its memory from call to call. With Derivatives::none the residuals alone, at a fraction of the cost:
/// `stiffness` and those of `contacts` are then not to be used.
void linearize(const JointModel& model, const State& state, const Target& target, Linearization& out,
               Derivatives wanted = Derivatives::all);

/// Lets linearize() leave off while it sums elastic layers, once `cancelled` says so: the wrench is then not finite.
void stop_layers_when(const Cancelled& cancelled, Linearization& out);

/// Without constraints and rigid contacts: `wrench` and `stiffness` of all that has no unknowns of its own. With a
/// `twist` (6B) elastic layers are damped; the stiffness knows nothing of that.
void linearize_forces(const JointModel& model, const State& state, const Target& target, Linearization& out,
                      const VecX* twist = nullptr);

/// The constraints alone: `gradient` and `constraint` of `out`; wrench and stiffness hold what their multipliers exert.
void linearize_constraints(const JointModel& model, const State& state, const Target& target, Linearization& out);

/// What a load's scale is at a state and a time (s); 1 for a load without a scale.
LoadScale::Value load_scale(const Load& load, const State& state, double time);

/// How fast the wrench on each moving body (6B) changes with the path's parameter while the bodies stand still: by the
/// factors of the steps and by scales over time. `rate` is the derivative of `target`.
VecX load_rate(const JointModel& model, const State& state, const Target& target, const Target& rate);

/// The same of the constraints' residuals, of which the model has `count`: what is prescribed changes, what a held
/// ligament's length has to be does not.
VecX constraint_rate(const Target& rate, Eigen::Index count);

/// What a revolute or fixed joint exerts on its child to hold its coordinates: [force, moment about the child's origin]
/// in the parent's axes (N, N m). The multipliers must be those of a solved state. The moment along a revolute axis
/// (stiffness, prescribed angle) is not part of it.
Vec6 joint_reaction(const JointModel& model, const State& state, int joint);

}  // namespace genu
