// Every tolerance of the room `equilibrium`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cstddef>
#include <limits>

namespace genu {

// active_set

/// [1] Changes of the active set at one pose; more is chatter. Fails first: if too small, poses with many contacts end
/// as chatter.
inline constexpr int kMaxSetChanges = 24;

/// [step] Places on the way between two poses where overlap is looked for. Fails first: if too small, a jump through a
/// thin sheet is refused.
inline constexpr int kMaxPassingLooks = 200;

/// [1] Scaled residual to which poses are solved that locate a change. Fails first: if too large, round-off of a loose
/// solver decides on which side of the change a pose is, and more are solved (time).
inline constexpr double kLocatingResidual = 1e-12;

/// [length scale] Overlap on a straight way that a rolling body has. Fails first: if too small, a rolling body counts
/// as one that passed through a sheet.
inline constexpr double kPassingOverlap = 0.1;

// adrift

/// [size] Way of a body from its start beyond which it counts as driven away. Fails first: if too small, a search that
/// only got stuck is called that.
inline constexpr double kAdriftSizes = 1;

// contact_inspection

/// [1/spacing] Relative curvature below which a contact may be about to split. Fails first: if too small, a twin
/// between samples is missed.
inline constexpr double kSplittingCurvature = 3e-3;

/// [1/spacing] Relative curvature across a valley above which twins lie along its bottom. Fails first: if too large,
/// more probes (time).
inline constexpr double kValleyCurvature = 4 * kSplittingCurvature;

/// [spacing] Distances at which twins of a flat contact are looked for. Fails first: if too small, twins are missed.
inline constexpr double kProbeRadii[] = {0.3, 0.8, 1.6, 3};

/// [length scale] Overlap of a sample beyond the deepest refined minimum that is round-off. Fails first: if too small,
/// good poses fail the certificate; if too large, a contact is missed.
inline constexpr double kUnexplainedOverlap = 1e-6;

/// [1] Round-off of a gap over length scale and distance from the origin (32 epsilon). Fails first: if too small,
/// scenes far from the origin chatter.
inline constexpr double kGapRounding = 32 * std::numeric_limits<double>::epsilon();

/// [gap tolerance] Gap up to which a candidate touches: what Newton leaves, with levers. Fails first: if too small, a
/// touching place is missed.
inline constexpr double kTouchingTolerances = 16;

/// [force scale] Contact force below which a pull is round-off. Fails first: if too small, contacts open and close in
/// turn (chatter); if too large, a pulling contact stays.
inline constexpr double kPullTolerance = 1e-9;

// descent_seed

/// [1] Descent steps of a seed, each stage. Fails first: if too small, hard starts fail.
inline constexpr int kMaxDescents = 150;

/// [1] The same in careful strides. Fails first: if too small, hard starts fail.
inline constexpr int kMaxCarefulDescents = 600;

/// [step] Careful stride over the longest usual one. Fails first: if too large, careful starts leave their basin.
inline constexpr double kCarefulStride = 0.05;

/// [force scale] Force of a seed along the free motions that ends the descent: a seed, not a result. Fails first: if
/// too large, Newton starts too far away.
inline constexpr double kBalancedForce = 1e-5;

/// [force scale] The same where samples come and go and no step descends further. Fails first: if too small, hard
/// starts fail.
inline constexpr double kNearEnoughForce = 0.05;

/// [stiffness scale] Least stiffness, for finite steps along free motions. Fails first: if too small, free bodies fly
/// off.
inline constexpr double kMinDescentStiffness = 1e-3;

/// [size] Longest translation of a descent step. Fails first: if too large, bodies pass through each other.
inline constexpr double kMaxDescentTranslation = 0.1;

/// [rad] Largest rotation of a descent step. Fails first: if too large, bodies pass through each other.
inline constexpr double kMaxDescentRotation = 0.1;

/// [longest step] Step below which Newton's method takes over. Fails first: if too large, Newton starts too far away.
inline constexpr double kNewtonStep = 1e-3;

/// [longest step] Step below which a descent is stuck. Fails first: if too small, time at bad starts.
inline constexpr double kStuckStep = 1e-7;

/// [force x length] Change of energy that is round-off. Fails first: if too small, a descent never ends.
inline constexpr double kWorkRounding = 1e-13;

// feasible_direction

/// [1] Violation of a bound by a unit motion that is round-off. Fails first: if too small, feasible motions are
/// rejected, and stability is wrong.
inline constexpr double kBoundTolerance = 1e-9;

/// [1] Least descent of a unit motion along a row to count as a way out. Fails first: if too small, round-off calls a
/// stable pose unstable.
inline constexpr double kDescentTolerance = 1e-6;

// newton

/// [1] Scaled residual below which a step first tries the Jacobian at hand. Fails first: if too large, wasted steps
/// (time).
inline constexpr double kJacobianReuse = 1e-2;

/// [1] Fall of the residual for which the last Jacobian counts as that of the solution. Fails first: if too large,
/// tangents and stability lose digits.
inline constexpr double kTrustedFall = 1e-3;

/// [1] Twice the fall of a step for which the same Jacobian is used again. Fails first: if too large, slow convergence
/// (time).
inline constexpr double kSteepFall = 1e-2;

/// [1] Error of the unknowns, over the residual tolerance, above which a solution is polished. Fails first: if too
/// large, ill-conditioned poses are inexact.
inline constexpr double kPolishOfTolerance = 1e3;

/// [1] Least such error, scaled. Fails first: if too small, polishing for nothing (time).
inline constexpr double kMinPolishError = 1e-9;

/// [1] Scaled residual left by terms that cancel. Fails first: if too small, polishing never ends.
inline constexpr double kResidualRounding = 1e-15;

/// [1] Share of the promised fall a polishing step must reach. Fails first: if too small, noise along a free motion
/// moves the pose.
inline constexpr double kMinPolishFall = 0.25;

// pair_gaps

/// [length scale] Gap of a sample below its refined minimum that is round-off. Fails first: if too small, the minimum
/// is replaced by a sample.
inline constexpr double kSampleGapRounding = 1e-9;

// piece_changes

/// [1] How much shorter, over the length of its arc, a path may be that lifts off hollow places. Fails first: if too
/// small, paths over noise of meshes are refused; if too large, lengths over hollows are too long.
inline constexpr double kHollowTolerance = 1e-6;

/// [1] Least eigenvalue over the largest, of the second derivatives of a path's length across it, below which a path
/// that is not found any more has slipped off. Fails first: if too small, no reason is given; if too large, a wrong
/// one.
inline constexpr double kSlippingHold = 0.02;

/// [length scale] Length past a break of a law that is round-off, as for gaps. Fails first: if too small, ligaments
/// change pieces in turn.
inline constexpr double kLengthRounding = 1e-12;

/// [1] Distance to a break of a law, scaled, that is reported. Fails first: nothing (report only).
inline constexpr double kNearestBreak = 0.01;

// pose_accuracy

/// [force scale] Force that may be idle at one of many poses; more is not. Fails first: if too small, forces of
/// redundant contacts are called certain.
inline constexpr double kIdleForce = 3e-8;

/// [length scale, rad] Distance from a nonsmooth point within which both sides are tried. Fails first: if too small,
/// stability on the point is that of one side.
inline constexpr double kNearBreak = 1e-6;

/// [length scale] Error that Newton leaves at every pose. Fails first: if too small, stability of conforming poses is
/// round-off.
inline constexpr double kConvergedLength = 2e-12;

/// [1] Error of a pose over its last correction, which is an estimate. Fails first: if too small, uncertain stability
/// is called certain.
inline constexpr double kCorrectionMargin = 10;

/// [1] Scaled residual up to which the bounds hold; they grow with it. Fails first: if too small, coarse tolerances
/// make every pose uncertain.
inline constexpr double kUsualResidual = 1e-9;

/// [force scale] Round-off of the unbalanced force. Fails first: if too small, exact poses have no error.
inline constexpr double kForceRounding = 1e-15;

// rigid_descent

/// [1] Steps of a slide. Fails first: if too small, long slides are given up.
inline constexpr int kMaxSlides = 600;

/// [1] Damping factors tried for a step. Fails first: if too small, a steep slide is given up.
inline constexpr int kMaxSlideTries = 40;

/// [1] Ratio of damping from step to step. Fails first: if too large, steps are needlessly short (time).
inline constexpr double kSlideDampingRatio = 3;

/// [step] Step of a slide below which damping decreases. Fails first: if too large, damping rises and falls in turn
/// (time).
inline constexpr double kShortSlide = 0.5;

/// [stiffness scale] Damping below which there is none, over the least stiffness. Fails first: if too large, the last
/// steps are needlessly short (time).
inline constexpr double kNoSlideDamping = 1e-3;

/// [1] Residual of the least distance problem at which the surfaces leave no way. Fails first: if too small, a step of
/// rounding.
inline constexpr double kNoWay = 1e-12;

/// [step] Longest step of a slide over that of a descent on a foundation. Fails first: if too large, contacts are seen
/// too late.
inline constexpr double kSlideStride = 0.15;

// scaled_solver

/// [1] Reciprocal condition below which LU gives way to the orthogonal decomposition. Two contacts 0.1 mm apart on a
/// knee have 1e-12; parallel planes 1e-17. Fails first: if too large, a gap of 0.05 nm stays; if too small, dependent
/// contacts give infinite forces.
inline constexpr double kTrustLu = 1e-15;

/// [1] Reciprocal condition above which it is only bounded. Fails first: if too large, estimates for nothing (time).
inline constexpr double kSurelyRegular = 1e-12;

/// [1] Pivot over the largest that counts as zero in the orthogonal decomposition. Fails first: if 1e-6 or more, Newton
/// stalls.
inline constexpr double kRankThreshold = 1e-10;

/// [bodies] From here on bodies are many: matrices are factored by blocks, and motions are measured from body to
/// body. Fails first: if too large, time; if too small, the last digits of joints of few bodies change.
inline constexpr int kManyBodies = 10;

// block_pattern

/// [bodies] Of a constraint or contact that is eliminated with one of its bodies. Fails first: if too small, the last
/// node grows with the number of contacts (time).
inline constexpr std::size_t kBodiesOfNarrowRow = 3;

// block_lu

/// [pivot block] Entry of a pivot that is too small for one. Fails first: if too small, the pose is inaccurate; if too
/// large, the dense matrix is factored without need (time).
inline constexpr double kLeastBlockPivot = 1e-13;

/// [block] Growth of a pivot block by elimination. Fails first: as the one before.
inline constexpr double kLargestGrowth = 1e6;

/// [solves] To estimate a condition. Fails first: if too small, it is underestimated.
inline constexpr int kConditionSolves = 5;

// self_stress

/// [1] Component of a unit self-stress that is round-off. Fails first: if too small, all forces are called
/// indeterminate.
inline constexpr double kIdleShare = 1e-9;

/// [1] Touching places that enter a self-stress, smallest gap first. Fails first: if too small, a redundant contact is
/// missed.
inline constexpr std::size_t kMaxTouchingPlaces = 60;

// stability

/// [1] Eigenvalue over the largest below which a motion costs nothing. Fails first: if too small, round-off decides
/// stability; if too large, soft joints are neutral.
inline constexpr double kNeutralShare = 1e-10;

/// [1] Stiffness left by terms that cancel, over their size. Fails first: if too small, a free body is stable or
/// unstable by round-off.
inline constexpr double kCancelledStiffness = 1e-13;

/// [1] Component of a unit self-stress from which a force takes part. Fails first: if too small, all forces are called
/// indeterminate.
inline constexpr double kPartOfSelfStress = 1e-6;

/// [1] Imaginary part over the largest eigenvalue below which it is real. Fails first: if too small, flutter from
/// round-off.
inline constexpr double kRealShare = 1e-9;

/// [1] Distance of a unit row from a combination of others that makes it dependent. Fails first: if too small,
/// redundant contacts are called determinate.
inline constexpr double kDependentRow = 1e-10;

/// [m] Length that weighs as much as 1 rad in every scene's metric. Fails first: nothing (a convention of the
/// eigenvalues).
inline constexpr double kMetricLength = 0.01;

// stiffness_homotopy

/// [force / length^3] First foundation of the stiffness homotopy; for a knee 10 MPa cartilage 6 mm thick. Fails first:
/// if too large, hard starts fail.
inline constexpr double kFirstModulus = 1.3e3;

/// [1] Ratio of stiffness of one stage to the last. Fails first: if too large, stages fail.
inline constexpr double kStiffnessRatio = 4.5;

/// [1] Most stages. Fails first: if too small, the seed overlaps too much for Newton.
inline constexpr int kMaxStages = 6;

/// [length scale] Overlap at which stages end. Fails first: if too large, Newton starts too far away.
inline constexpr double kStageOverlap = 1e-3;

/// [1] Steps of each stage. Fails first: if too small, hard starts fail.
inline constexpr int kMaxStageSteps = 80;

/// [1] Scaled residual that ends a stage: a seed, not a result. Fails first: if too large, Newton starts too far away.
inline constexpr double kStageResidual = 1e-5;

/// [1] The same where samples come and go and no step reduces it further. Fails first: if too small, hard starts fail.
inline constexpr double kNearEnoughResidual = 0.1;

/// [size] Longest translation of a step. Fails first: if too large, bodies pass through each other.
inline constexpr double kMaxStageTranslation = 0.06;

/// [rad] Largest rotation of a step. Fails first: if too large, bodies pass through each other.
inline constexpr double kMaxStageRotation = 0.05;

/// [1] Ratio of residuals at which a body is falling freely. Fails first: if too small, falling bodies end as a
/// failure.
inline constexpr double kFallingRatio = 1 + 1e-9;

// undetermined

/// [1] Motion over the largest from which an undetermined coordinate is named. Fails first: if too small, every
/// coordinate is named.
inline constexpr double kNamedShare = 0.2;

// unilateral_stability

/// [length scale] Motion that shows whether an unloaded layer resists at first order. Fails first: if too small,
/// round-off decides.
inline constexpr double kLayerProbe = 1e-6;

/// [1] Ratio of two such motions. Fails first: if too small, linear and square growth look alike.
inline constexpr double kLayerProbeRatio = 100;

/// [1] Growth over that ratio up to which the load is linear (square growth: 100). Fails first: if too large, a grazing
/// layer counts as stiff.
inline constexpr double kLinearGrowth = 3;

// unilateral_stiffness

/// [1] Faces of the cone of motions that are examined. Fails first: if too small, stability is undecided with many
/// touching places.
inline constexpr int kMaxStabilityCases = 20000;

/// [1] Difference of unit rows that are one bound. Fails first: if too small, cases double.
inline constexpr double kParallelRows = 1e-12;

/// [1] Asymmetry of a stiffness that is round-off. Fails first: if too small, conservative systems are treated as
/// general.
inline constexpr double kSymmetryRounding = 1e-12;

/// [1] Distance of a unit motion from a bound to be inside of the cone. Fails first: if too small, motions on the bound
/// count as inside.
inline constexpr double kInsideCone = 1e-9;

/// [1] Part of an eigenvector outside of the known space. Fails first: if too small, a multiple eigenvalue gets
/// round-off vectors.
inline constexpr double kNewEigenvector = 1e-8;

/// [1] The same for free motions. Fails first: if too small, one free motion is counted twice.
inline constexpr double kNewFreeMotion = 1e-6;

// uniqueness

/// [1] Reciprocal condition below which a pose is not unique. Fails first: if too large, stiff poses are called
/// non-unique.
inline constexpr double kSingularStep = 1e-13;

/// [1] The same over the scaled residual. Fails first: if too small, coarse tolerances hide non-unique poses.
inline constexpr double kSingularOfResidual = 100;

// stability_by_blocks

/// [steps] Of Lanczos' method. Fails first: if too small, all eigenvalues are computed instead (time).
inline constexpr int kMostLanczosSteps = 100;

/// [eigenvalue] Residual of the softest motion. Its eigenvalue has the square of it. Fails first: if too small, time.
inline constexpr double kLanczosResidual = 1e-7;

}  // namespace genu
