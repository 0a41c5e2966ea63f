// Every tolerance of the room `motion`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

namespace genu {

// contact_choice

/// [1] Impulse, rate or acceleration over the largest that is round-off. Fails first: if too small, contacts chatter at
/// impacts.
inline constexpr double kImpulseRounding = 1e-9;

// equations_of_motion

/// [1] Scaled residual of positions on their constraints (round-off of some lengths' size). Fails first: if too small,
/// projections for nothing.
inline constexpr double kProjectedResidual = 1e-14;

/// [1] Residual up to which a projection succeeds. Fails first: if too small, motions far from the origin fail.
inline constexpr double kMaxProjectedResidual = 1e-11;

/// [1] Newton steps of a projection. Fails first: if too small, long steps fail.
inline constexpr int kMaxProjections = 8;

/// [1] Reciprocal condition of J J^T below which constraints are dependent. Fails first: if too small, reactions are
/// round-off.
inline constexpr double kDependentConstraints = 1e-13;

/// [1] Relative round-off of a position. Fails first: if too small, the integrator asks for more digits than there are.
inline constexpr double kPlaceRounding = 1e-15;

/// [s] Speeds below length / this are small. Fails first: nothing (a convention of the error norm).
inline constexpr double kSpeedTime = 1;

// layer_onset

/// [search depth] Motion between two looks at a layer. Fails first: if too large, contact begins unseen.
inline constexpr double kOnsetTravel = 0.1;

/// [1] Halvings of a step at a layer's onset. Fails first: if too small, the onset is inexact.
inline constexpr int kMaxOnsetCuts = 60;

// motion

/// [1] Switches within kStillTime of the duration; more is chatter. Fails first: if too small, bouncing bodies are
/// refused.
inline constexpr int kMaxSwitches = 1000;

/// [duration] Time within which switches count as simultaneous. Fails first: if too large, bouncing bodies are refused.
inline constexpr double kStillTime = 1e-9;

/// [steps] Steps between looks for stiffness; one costs 30 evaluations. Fails first: if too small, time.
inline constexpr long kStiffnessLooks = 500;

/// [steps] Steps between looks at headway. Fails first: if too small, slow but good motions end.
inline constexpr long kHeadwayLooks = 1000;

/// [duration] Least headway in so many steps: 1e12 steps lie ahead. Fails first: if too large, slow but good motions
/// end.
inline constexpr double kMinHeadway = 1e-9;

/// [1] Step times decay above which Adams is stiff (orders 4 to 8 are stable to 0.5 to 1). Fails first: if too large,
/// stiff motions take small steps.
inline constexpr double kStabilityBound = 0.6;

/// [interval] A row this near to the end is the end. Fails first: if too small, a row is written twice.
inline constexpr double kTimeRounding = 1e-12;

/// [1] Drift from the constraints above which integration restarts on them. Fails first: if too large, bodies overlap.
inline constexpr double kMaxDrift = 1e-6;

/// [tolerance] Error of a step over that of the motion. Fails first: if too large, motions miss their tolerance.
inline constexpr double kStepShare = 1e-3;

/// [1] Least tolerance of a step; round-off is not far below. Fails first: if too small, steps shrink to nothing.
inline constexpr double kMinStepTolerance = 1e-14;

// motion_contacts

/// [1] Contacts among which sets are tried: 2^10 small systems. Fails first: if too small, impacts with many contacts
/// end the motion.
inline constexpr int kMaxContactsAtOnce = 10;

/// [step error] Gap below which bodies touch. Fails first: if too small, contacts open by integration error.
inline constexpr double kStepErrors = 10;

/// [length scale] Gap that touches at the start. Fails first: if too small, bodies at rest begin with an impact.
inline constexpr double kTouchingAtStart = 1e-9;

/// [length scale] Overlap that is refused at the start. Fails first: if too small, equilibrium poses are refused.
inline constexpr double kOverlappingAtStart = 1e-6;

/// [gap] Motion over the clearance before pairs are looked at again. Fails first: if too large, contact begins unseen.
inline constexpr double kClearanceShare = 0.9;

/// [1/spacing] Relative curvature below which a twin may be born at any step. Fails first: if too small, a twin is
/// missed.
inline constexpr double kTwinCurvature = 1.2e-2;

/// [touching gap] Gap of a twin that touches. Fails first: if too large, a twin opens and closes in turn.
inline constexpr double kTwinGap = 1e-3;

/// [touching gap] Overlap above which contact was seen too late. Fails first: if too small, steps are repeated for
/// nothing.
inline constexpr double kLateOverlap = 2;

/// [1] Halvings that locate a change. Fails first: if too small, changes are located inexactly.
inline constexpr int kMaxHalvings = 60;

// motion_switches

/// [scale] Value of a switch's function that is zero: round-off and the root's place are far below. Fails first: if too
/// small, a switch is found twice.
inline constexpr double kSideRounding = 1e-11;

/// [scale, rad] How far a root is passed before it counts. Fails first: if too small, a switch is found twice.
inline constexpr double kRootShift = 1e-12;

// motion_watch

/// [length scale] How far touching bodies move unwatched. Fails first: if too large, a second contact begins unseen.
inline constexpr double kWatchLength = 0.1;

/// [size] The same over the smaller surface's size. Fails first: if too large, a second contact begins unseen.
inline constexpr double kWatchSize = 0.05;

/// [length scale] Size of a surface without bounds. Fails first: if too small, turning bodies are watched too seldom.
inline constexpr double kUnboundedReach = 10;

// ode_integrator

/// [1] CVODE's limit of steps; one a call is taken. Fails first: nothing.
inline constexpr long kMaxOdeSteps = 100'000'000;

/// [time] Steps shorter than this make no headway. Fails first: if too large, slow but good motions end.
inline constexpr double kStallShare = 1e-14;

/// [1] Such steps in a row. Fails first: if too small, slow but good motions end.
inline constexpr int kMaxStalled = 100;

/// [SI] Step of the difference that shows stiffness. Fails first: if too small, round-off; it only chooses the method.
inline constexpr double kDifferenceStep = 1e-7;

/// [eigenvalue] Real part over the size from which a root is damped. Fails first: if too small, oscillations are called
/// stiff.
inline constexpr double kDampedShare = 0.1;

// touch_times

/// [time] Accuracy of the time at which a path begins to touch a surface. Fails first: if too small, bisection ends in
/// round-off; if too large, events are late.
inline constexpr double kTouchTime = 1e-12;

}  // namespace genu
