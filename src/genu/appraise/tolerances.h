// Every tolerance of the room `appraise`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cstddef>

namespace genu {

// barely_held

/// [1] Stiffness of the softest motion over force of the layers times length scale, below which it is hardly any. Fails
/// first: if too small, motions that are free but for an error pass as held; if too large, soft joints are doubted.
inline constexpr double kHardlyAnyStiffness = 5e-4;

// contact_location

/// [1] Mean curvature over its error below which a contact's place is doubtful. Fails first: if too small, doubtful
/// places pass.
inline constexpr double kDoubtfulRatio = 10;

// hertz_check

/// [radius] Contact over the smallest radius up to which Hertz applies (slopes squared are 4 %). Fails first: if too
/// large, Hertz is compared where it does not hold.
inline constexpr double kNarrowContact = 0.2;

/// [thickness] Contact over the thickness up to which Hertz applies (at 0.1 a bonded layer is 10 % stiffer). Fails
/// first: if too large, Hertz is compared where it does not hold.
inline constexpr double kThickLayer = 1;

/// [1] Relative difference of the area from Hertz' ellipse. Fails first: if too large, Hertz is compared with edge
/// contact.
inline constexpr double kEllipseTolerance = 0.2;

// jumps

/// [1] Jumps that the verdict lists one by one. Fails first: if too large, the verdict is a list.
inline constexpr int kJumpsTold = 3;

// layer_doubts

/// [search depth] How far the other surface is looked for. Fails first: if too small, doubts are not seen.
inline constexpr double kRaySearch = 2;

/// [m] Least such distance. Fails first: if too small, doubts of thin layers are not seen.
inline constexpr double kMinRaySearch = 5e-3;

/// [1] Rays that are looked at. Fails first: if too large, time.
inline constexpr std::size_t kMaxDoubtRays = 4000;

/// [1] Fewest rays that decide which side a layer faces. Fails first: if too small, a stray ray decides.
inline constexpr std::size_t kMinDeciding = 20;

/// [1] Share of them that must agree. Fails first: if too small, false warnings.
inline constexpr double kDecidingShare = 0.75;

/// [Pa] Young's modulus above which a layer is all but rigid: no finer mesh shows its contact area. Fails first: if too
/// small, an implant of polyethylene is called that.
inline constexpr double kStiffLayer = 5e9;

/// [1] Triangles that have gone through the other body over those that overlap, above which they are reported. Fails
/// first: if too small, false warnings at rims.
inline constexpr double kPassedShare = 1e-3;

/// [m] Offset of a ray from its own surface. Fails first: if too small, a ray meets its own start.
inline constexpr double kClearStart = 1e-9;

/// [1] Rim's neighbourhood over the side of a point's cell. Fails first: if too small, contact at the rim is not
/// reported.
inline constexpr double kRimCell = 0.5;

/// [1] Rows that are looked at. Fails first: if too small, doubts between them are missed.
inline constexpr std::size_t kMaxDoubtRows = 200;

/// [1] Share of peak pressure or load that is reported. Fails first: if too small, warnings about nothing.
inline constexpr double kReportedShare = 0.01;

/// [tolerance] Error of a layer's force that is reported. Fails first: if too small, estimates just above their limit
/// are.
inline constexpr double kMissedTolerance = 2;

// implausible

/// [1] Factor of a load that can only pull, in the last pose of a path that ended, over its largest: below this it is
/// nearly slack. Fails first: if too small, a muscle that goes slack is not named.
inline constexpr double kSlackDriver = 0.05;

/// [rad] Rotation of a bushing above which the answer is doubted: at half a turn its rotation vector jumps. Fails
/// first: if too large, a jump between two rows is not noticed.
inline constexpr double kMostBushingTurn = 2.6;

// patella

/// [1] Share of a patella's way that goes sideways where it leaves its groove. Fails first: if too small, a snap along
/// the groove is called a subluxation.
inline constexpr double kSidewaysShare = 0.5;

/// [m] Least way of a patella that leaves its groove. Fails first: if too small, a path that ends in the groove is
/// called a subluxation.
inline constexpr double kLeastSubluxation = 1e-3;

/// [m] Least way along which it slides out at a limit point. Fails first: if too small, round-off decides.
inline constexpr double kLeastSlide = 1e-8;

/// [1] How far a patella's middle may lie off the groove, over its width: clinicians measure the part of the width that
/// lies lateral of the groove (the bisect offset), 75 % here. Fails first: if too small, patellae that ride laterally
/// are doubted (the shape model's S002 reaches 0.2); if too large, those that have left the groove are not.
inline constexpr double kMostOffGroove = 0.25;

/// [m] Edge of the triangles that show how far contact surfaces reach. Fails first: if too large, a small closed form
/// has no width.
inline constexpr double kSideEdge = 1e-3;

/// [1] Most pieces of an edge that is longer. Fails first: if too small, a cut through a coarse mesh has holes; if too
/// large, time.
inline constexpr int kMostSidePieces = 20;

/// [m] How far unbounded contact surfaces are followed. Fails first: if too small, the middle of a wide one is wrong.
inline constexpr double kSideReach = 0.1;

// groove

/// [m] Width and thickness of the pieces of a cut through the femur. Fails first: if too small, a coarse mesh has
/// holes; if too large, the groove is known badly.
inline constexpr double kProfilePiece = 2e-3;

/// [width of the patella] How deep a cut through the femur is looked at, from its highest point. Fails first: if too
/// small, deep grooves have no bottom (that counts as one); if too large, the rear of the condyles counts as a crest.
inline constexpr double kFrontOfCut = 0.5;

/// [m] Depth of a hollow that is a groove. Fails first: if too small, bumps of a mesh are grooves; if too large, flat
/// trochleas have none.
inline constexpr double kLeastGroove = 1e-3;

/// [m] How far distal of the patella a groove is looked for. Fails first: if too small, nothing is said of a patella
/// above the trochlea.
inline constexpr double kGrooveReach = 0.03;

/// [1] Least part of the patella's anterior axis across the femur's lateral one. Fails first: if too small, a cut is
/// turned by round-off.
inline constexpr double kLeastAcross = 0.2;

// layer_verdict

/// [1] Triangles in contact below which a sum jumps visibly from pose to pose. Fails first: if too large, coarse but
/// good layers get a warning.
inline constexpr double kFewLayerTriangles = 50;

/// [search depth] Depth that counts as all of the search depth. Fails first: if too large, truncated layers are not
/// reported.
inline constexpr double kNearSearchDepth = 0.95;

// verdict

/// [step] Distance of a limit point from the change of stability there. Fails first: if too small, rounding tells them
/// apart and both are said.
inline constexpr double kLimitAndChange = 1e-9;

/// [reach] Distance to a mesh flaw, over its reach, within which contact touches it. Fails first: if too small, contact
/// on a flaw is not reported.
inline constexpr double kNearFlaw = 3;

// place

/// [1] Relative difference of the factors of loads that are all lighter by the same part. Fails first: if too small,
/// the part is not named.
inline constexpr double kSameFactor = 1e-9;

// shorter_sides

/// [1] Rows of a run in which other sides of surfaces are tried. Fails first: if too small, a shorter side is noticed
/// late; if too large, runs of wrapped paths take longer.
inline constexpr std::size_t kRowsForSides = 8;

// implausible

/// [m] How far proximal of a femur's origin its axis of flexion may be. Fails first: if too small, knees that only flex
/// are doubted; if too large, dislocations forward and upward are not.
inline constexpr double kAboveOrigin = 0.03;

/// [1] Points looked at between. Fails first: if too small, the one that moves least is missed.
inline constexpr int kAboveOriginSteps = 6;

}  // namespace genu
