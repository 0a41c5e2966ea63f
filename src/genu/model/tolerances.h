// Every tolerance of the room `model`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

namespace genu {

// build_layer

/// [1] Edge of the triangles cut from formulas for a layer, over the smaller surface's size. Fails first: if too large,
/// the load of a layer jumps from pose to pose.
inline constexpr double kLayerEdgeShare = 0.01;

/// [1] The same for smooth quadrature. Fails first: if too large, smooth quadrature misses its tolerance.
inline constexpr double kSmoothLayerEdgeShare = 0.02;

/// [1] How far unbounded shapes of a layer are cut into triangles, over the larger surface's size. Fails first: if too
/// small, contact runs over the edge.
inline constexpr double kLayerReach = 3;

// build_model

/// [size] Least length scale over the model's size, when all forces meet in one place. Fails first: if too small,
/// scaled tolerances shrink to round-off.
inline constexpr double kMinLengthShare = 0.01;

/// [m] Spread of a model's attachments below which they lie in one place, but for rounding. Fails first: if too small,
/// the length scale of a model whose forces meet in one point is round-off, and any residual passes.
inline constexpr double kLeastSpread = 1e-9;

/// [1] Strain at which ligaments give the force scale. Fails first: if too large, forces of a slack joint are all
/// called small.
inline constexpr double kTypicalStrain = 0.01;

// bushing

/// [rad] Rotation below which series take the place of closed forms. Fails first: if too small, cancellation in the
/// slope of the logarithm; if too large, the series' remainder.
inline constexpr double kLogSeriesAngle = 0.2;

// closed_contact

/// [1] Most Newton steps that close a contact's points. Fails first: if too small, conforming contacts are refused.
inline constexpr int kMaxClosingSteps = 20;

/// [length scale] A step shorter than this moves the points no more. Fails first: if too small, round-off never
/// settles.
inline constexpr double kClosedStep = 1e-14;

/// [length scale] Steps below it that grow again are round-off. Fails first: if too large, contacts are closed
/// inexactly.
inline constexpr double kClosingRounding = 1e-9;

// contact_field

/// [length scale] How far unbounded shapes are sampled. Fails first: if too small, contact far out is not found.
inline constexpr double kSamplingReach = 10;

/// [m] Radius that bounds the sag of a face without curvature known (a knee's). Fails first: if too large, contact
/// between samples is missed.
inline constexpr double kSaggingRadius = 25e-3;

// grood_suntay

/// [rad] Sine between flexion and rotation axes below which the clinical angles do not exist. Fails first: if too
/// small, angles of round-off are written.
inline constexpr double kMinFloatingAxis = 1e-12;

// joint_coordinates

/// [1] Deviation of joint axes from unit length and right angles. Fails first: if too small, rounded axes are refused.
inline constexpr double kUnitAxisTolerance = 1e-12;

/// [1] Cosine of the second angle below which the first is chosen freely; it turns R by less than pi times this. Fails
/// first: if too large, angles near gimbal lock are wrong.
inline constexpr double kGimbalCosine = 1e-14;

/// [1] Sine of the second angle below which gradients of the others do not exist. Fails first: if too small, gradients
/// of round-off.
inline constexpr double kGimbalSine = 1e-12;

// law_breaks

/// [1] Difference of force at a break of a law, over 1 N + the force, that is round-off. Fails first: if too small, a
/// continuous law is refused as one that jumps.
inline constexpr double kStatedForceTolerance = 1e-9;

// layer_levels

/// [force scale] Load below which a layer's tolerance is absolute. Fails first: if too small, grazing contact is
/// refined for ever.
inline constexpr double kMinLayerLoadShare = 0.01;

// ligament_law

/// [1] Relative error with which a length found for a force gives it back. Fails first: if too small, stiff laws are
/// refused.
inline constexpr double kForceInverseTolerance = 1e-9;

// parameters

/// [1] Standard change of a positive parameter (1 %), by which effects are ranked. Fails first: nothing (a convention
/// of the ranking).
inline constexpr double kRelativeChange = 0.01;

/// [1] Standard change of a strain. Fails first: nothing (a convention of the ranking).
inline constexpr double kStrainChange = 0.01;

/// [Nm] Standard change of a moment. Fails first: nothing (a convention of the ranking).
inline constexpr double kMomentChange = 0.01;

/// [m] Distance at which a polynomial's term changes by 1 mm. Fails first: nothing (a convention of the ranking).
inline constexpr double kTermReach = 10e-3;

// load_scale

/// [rad or m] Distance from its target at which feedback gives the force scale, at least. Fails first: if too small,
/// the force scale of a joint held by feedback alone is round-off.
inline constexpr double kFeedbackError = 0.1;

// step_plan

/// [1] Scaled residual of an accepted pose, for the least size of a step. Fails first: if too small, steps below what a
/// pose resolves are tried.
inline constexpr double kSolvedResidual = 1e-8;

}  // namespace genu
