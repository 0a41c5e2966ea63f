// Every tolerance of the room `path`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace genu {

// arc_length_follower

/// [arc length] First substep. Fails first: if too large, the follower leaves its branch at the start.
inline constexpr double kFirstArc = 0.01;

/// [arc length] Longest substep. Fails first: if too large, events within a substep are missed.
inline constexpr double kLongestArc = 0.1;

/// [arc length] Shortest substep; below it the path is stuck. Fails first: if too large, sharp turns end the path.
inline constexpr double kShortestArc = 1e-9;

/// [1] Cosine of the angle between directions at a substep's ends. Fails first: if too small, the follower leaves its
/// branch.
inline constexpr double kMinTurnCosine = 0.95;

/// [step] Value of t at which a path that runs back is given up. Fails first: if too near to 0, snap-through ends
/// early.
inline constexpr double kFarthestBack = -10;

/// [1] Most substeps of a path by arc length. Fails first: if too small, long paths end early.
inline constexpr int kMaxArcSubsteps = 100000;

/// [arc] Correction over the substep that stays on the branch. Fails first: if too large, the follower leaves its
/// branch.
inline constexpr double kArcCorrectionShare = 0.3;

/// [arc length] Correction that is always allowed. Fails first: if too small, short substeps are refused for round-off.
inline constexpr double kArcCorrectionSlack = 1e-7;

/// [1] Changes of the active set at one place of the path. Fails first: if too small, places with many changes end the
/// path.
inline constexpr int kMaxArcSetChanges = 6;

/// [length scale, rad] Distance within which changes belong to one place. Fails first: if too small, one place ends the
/// path.
inline constexpr double kSamePlace = 1e-5;

/// [substeps] How far ahead a limit point is looked for. Fails first: if too small, limit points are not reported.
inline constexpr int kMaxLimitLooks = 30;

// arc_length_follower_events

/// [step] Change of t that is none. Fails first: if too large, events near each other are merged.
inline constexpr double kNoProgress = 1e-14;

/// [length scale, rad] Distance at which a path is back at its start. Fails first: if too small, a closed path is
/// followed for ever.
inline constexpr double kLoopClosed = 1e-6;

/// [1] Rate of t along the path that is round-off. Fails first: if too small, sliding under a constant load makes limit
/// points.
inline constexpr double kNoDirection = 1e-12;

/// [1] Slowest rate of t within a substep, over the slower end's, below which t may turn twice. Fails first: if too
/// small, a pair of limit points is missed.
inline constexpr double kSlowShare = 0.1;

/// [arc length] Shortest substep that is searched for limit points. Fails first: if too large, a pair of limit points
/// is missed.
inline constexpr double kMinTurnArc = 1e-6;

/// [arc length] Distance within which a limit point and its vanishing stiffness are one. Fails first: if too small, one
/// event is listed twice.
inline constexpr double kSameTurn = 1e-6;

/// [arc length] Shortest substep that may hide a leap. Fails first: if too small, halving without end.
inline constexpr double kMinLeapArc = 1e-6;

/// [1] Rate of t above which a sign change of stiffness is a bifurcation. Fails first: if too small, limit points are
/// listed as bifurcations too.
inline constexpr double kTurningRate = 1e-6;

/// [arc length] Accuracy of an event's place. Fails first: if too large, events are inexact.
inline constexpr double kEventArc = 1e-11;

/// [length scale, rad] Distance of the poses on both sides of an event from which it is a leap. Fails first: if too
/// small, events are called leaps.
inline constexpr double kArcLeap = 1e-5;

/// [length scale, rad] Distance of a row's pose from the path's above which the path's is kept. Fails first: if too
/// small, rows keep the path's value of t.
inline constexpr double kRowLeap = 1e-5;

// arc_newton

/// [1] Newton iterations of a substep. Fails first: if too small, short substeps (time).
inline constexpr int kMaxArcIterations = 12;

/// [1] Largest correction in the metric. Fails first: if too large, the follower leaves its branch.
inline constexpr double kMaxArcCorrection = 0.5;

// event_newton

/// [1] Newton iterations to an event. Fails first: if too small, bisection instead (time).
inline constexpr int kMaxEventIterations = 8;

/// [1] Ratio of two corrections from which the next one is foretold. Fails first: if too large, events are inexact
/// where convergence is slow.
inline constexpr double kEventContraction = 0.1;

/// [length scale, rad] Foretold correction that is not computed. Fails first: if too large, events are inexact.
inline constexpr double kEventError = 1e-11;

// flutter_tolerance

/// [substep] How near the beginning of a flutter is located where elastic layers act. Fails first: if too small,
/// bisections for a jump of a ray (time).
inline constexpr double kFlutterShare = 1.0 / 128;

// law_events

/// [rise] Miss of a break by the cubic of a ligament's length, over its rise, that is looked at. Fails first: if too
/// small, a short visit to another piece is missed.
inline constexpr double kNearBreakShare = 0.01;

// path

/// [rows] Rows between checkpoints at least. Fails first: if too small, time.
inline constexpr int kRestRows = 16;

/// [rows] Unsolved rows in a row that are stepped over. Fails first: if too large, time on a path that has ended.
inline constexpr int kMaxSkippedRows = 3;

// path_follower

/// [length scale, rad] Motion of one substep. Fails first: if too large, near limit points another branch is found.
inline constexpr double kLongestMotion = 0.25;

/// [step] Longest substep. Fails first: if too large, contacts that come and go are missed.
inline constexpr double kLongestSubstep = 0.1;

/// [substep] Rest of a way that is no substep of its own. Fails first: if too small, substeps of rounding length.
inline constexpr double kRestShare = 1e-6;

/// [1] Rate over the Jacobian's error above which its sign is certain. Fails first: if too small, events of round-off.
inline constexpr double kRateMargin = 30;

/// [1] Change of the speed across a substep above which it is halved. Fails first: if too large, a leap to another
/// branch passes.
inline constexpr double kSpeedRatio = 2;

/// [step] Substep that is never halved for that. Fails first: if too small, breaks of laws are halved without end.
inline constexpr double kShortestSpeedStep = 1e-6;

/// [length scale, rad] Motion that is never halved for that. Fails first: if too large, a leap over two near limit
/// points passes.
inline constexpr double kStillMotion = 1e-3;

/// [motion] Error of the prediction over the motion. Fails first: if too large, a leap to another branch passes.
inline constexpr double kPredictionShare = 0.5;

/// [length scale, rad] Error that is always allowed. Fails first: if too small, short substeps are refused for
/// round-off.
inline constexpr double kPredictionSlack = 1e-5;

/// [tangent] Motion over the tangent's that stays on the branch. Fails first: if too large, a leap to another branch
/// passes.
inline constexpr double kMotionFactor = 4;

/// [length scale, rad] Motion that is always allowed. Fails first: if too small, rows after a still one are refused.
inline constexpr double kMotionSlack = 0.02;

/// [step] Part of a step in which changes of contact crowd. Fails first: if too large, paths with many contacts end
/// early.
inline constexpr double kCrowdedStep = 1e-5;

/// [1] Changes of contact in it. Fails first: if too small, paths with many contacts end early.
inline constexpr int kMaxCrowdedChanges = 100;

/// [length scale, rad] Motion after a contact drops above which it is a jump. Fails first: if too small, rounding is
/// listed as a jump.
inline constexpr double kFallMotion = 1e-6;

/// [1] Stretches without a solution that are stepped over. Fails first: if too small, paths with many contacts end
/// early.
inline constexpr int kMaxSteppedOver = 30;

/// [length scale, rad] Motion across such a stretch above which it is a jump. Fails first: if too small, rounding is
/// listed as a jump.
inline constexpr double kStepOverMotion = 1e-3;

/// [1] Smallest eigenvalue over the largest seen below which the end is a limit point. Fails first: if too large, other
/// ends are called limit points.
inline constexpr double kVanishingStiffness = 0.02;

// path_follower_events

/// [length scale, rad] Distance of the poses on both sides of an event from which it is a leap. Fails first: if too
/// small, events are called leaps.
inline constexpr double kLeapDistance = 1e-6;

/// [1] Stiffness at a sign change over its values beside it that vanishes; a break of a law changes signs without it.
/// Fails first: if too small, limit points are missed.
inline constexpr double kVanishingShare = 1e-3;

/// [1] Poses solved to find the place of a change of contacts. Fails first: if too small, it is found by searches
/// (time).
inline constexpr int kMaxLooksForAChange = 60;

/// [1] Changes before a change that are found in this way within one substep. Fails first: if too small, the others are
/// found by searches (time).
inline constexpr int kMaxOtherChanges = 4;

/// [substep] How near the place of a change is found on the cubic of the path. Fails first: if too large, more poses
/// are solved to locate it (time).
inline constexpr double kPlaceOfChange = 1e-8;

/// [step] Distance from the last pose for which its contacts are the start. Fails first: if too large, wasted
/// iterations.
inline constexpr double kNearLastPose = 0.1;

// path_prediction

/// [step] Shortest substep whose tangents are differentiated. Fails first: if too small, predictions of rounding.
inline constexpr double kShortestSpan = 1e-7;

/// [1] Difference of the tangent over the last one, above which extrapolation stops. Fails first: if too large, poor
/// predictions at breaks (time).
inline constexpr double kSmoothShare = 0.2;

// path_turn

/// [step] How far beyond the last pose a limit point is looked for. Fails first: if too small, limit points are not
/// reported.
inline constexpr double kLimitReach = 0.5;

/// [smallest increment] Distance of a limit point from the last pose within which it ends the path although the
/// symmetric part of the stiffness does not vanish there. Fails first: if too large, a limit point of another branch is
/// reported.
inline constexpr double kNearTurn = 100;

// raised_loads

/// [loads] Parts of them under which a first pose is sought where none is found under all. Fails first: if too large,
/// none is found.
inline constexpr std::array<double, 4> kFirstParts = {0.3, 0.1, 0.03, 0.01};

/// [loads] Smallest step by which they are raised. Fails first: if too large, a steep path passes for ended; if too
/// small, time.
inline constexpr double kLoadIncrement = 1e-5;

// starts

/// [1] Shortest way to a start, over the whole. Fails first: if too small, starts repeat the first pose.
inline constexpr double kMinStartShare = 1.0 / 8;

/// [1] Displacement from a saddle along its unstable motion, in rad or 10 mm. Fails first: if too small, the descent
/// returns to the saddle.
inline constexpr double kBesideSaddle = 0.02;

/// [1] Saddles from which descents begin. Fails first: if too small, equilibria are missed.
inline constexpr std::size_t kMaxSaddles = 100;

/// [1] Stable poses between which saddles are sought. Fails first: if too small, saddles are missed.
inline constexpr std::size_t kMaxBetween = 10;

/// [1] Bisections between two stable poses. Fails first: if too small, saddles are missed.
inline constexpr int kMaxBisections = 8;

/// [rad] Largest change of a free angle of starts (20 deg). Fails first: if too small, equilibria are missed.
inline constexpr double kStartSpread = 20 * std::numbers::pi / 180;

// side_watch

/// [1] How much shorter, over its length, a path round another side has to be. Fails first: if too small, sides of
/// equal length are reported.
inline constexpr double kShorterShare = 0.01;

/// [1] Decrease of the straight line over a path's length after which another side is sought again. Fails first: if too
/// small, paths over round surfaces, which have none, cost time; if too large, another side is noticed late.
inline constexpr double kSidesSoughtAgain = 0.005;

}  // namespace genu
