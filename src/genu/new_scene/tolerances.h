// Every tolerance of the room `new_scene`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cstddef>

namespace genu {

// bone_view

/// [m] Drop from a pixel to the next one at which an edge is drawn. Fails first: nothing (pictures).
inline constexpr double kEdgeDrop = 3e-3;

// knee_picture

/// [m] How far behind a surface a point still is seen: ends are written to a tenth of a millimetre. Fails first:
/// nothing (pictures).
inline constexpr double kSeenBehind = 1.5e-3;

/// [m] Distance of ends of one ligament that are drawn as one. Fails first: nothing (pictures).
inline constexpr double kEndsTogether = 0.02;

/// [m] What is shown beyond the outermost end. Fails first: nothing (pictures).
inline constexpr double kPictureRim = 6e-3;

// knee_frames

/// [deg] Turn of the bones against the axes of their files up to which the knee bends about those. Fails first: if too
/// large, flexion and the loads of laxity are about axes that are none of the knee's.
inline constexpr double kAxesKept = 3;

/// [deg] Turn of tibia to femur, as the reference knee lies on them, above which their axes are not believed
/// (shape-model knees: up to 11; drawn bones, whose condyles are round: 35). Fails first: if too small, knees scanned
/// in flexion bend about the axes of their files; if too large, bones without features bend about axes that are none.
inline constexpr double kBonesTurned = 25;

// new_landmarks

/// [m] Error (standard deviation) of landmarks whose file states none. Fails first: nothing (chosen, and said to be).
inline constexpr double kLandmarkError = 2e-3;

/// [m] How far a landmark may be off its bone. Fails first: if too small, points on cartilage or beside a coarse mesh
/// get a warning.
inline constexpr double kLandmarkOff = 6e-3;

/// [standard deviations] How far a landmark may be from where the reference knee has it. Fails first: if too small,
/// knees that differ get warnings; if too large, exchanged names do not.
inline constexpr double kLandmarkDoubt = 3.5;

/// [1] Ratio of the distances of points from the bones, turned by half about the long axis and as they are, below which
/// they are turned. Fails first: if too large, chance decides.
inline constexpr double kFrameFits = 0.3;

/// [1] Least cosine between the line through the epicondyles and the axis to the side. Fails first: if too large,
/// oblique scans get a warning.
inline constexpr double kEpicondylesAside = 0.8;

// new_fibula

/// [of the tibia's width] Length of the fibula, from its top, that counts as its head. Fails first: if too large, the
/// shaft of a tilted one tells the side; if too small, one stray vertex.
inline constexpr double kFibulaHead = 0.4;

/// [of the tibia's width] Largest distance of the fibula's head from the middle of the plateau along each axis. Fails
/// first: if too small, fibulae of small tibiae are refused; if too large, other bones are taken for it.
inline constexpr double kFibulaReach = 1.1;

/// [of the tibia's width] Distance of the fibula's head from the knee's middle, sideways, from which it tells the side.
/// Fails first: if too small, a bone amid the knee decides.
inline constexpr double kFibulaAside = 0.2;

// new_laxity (the ranges are those of docs/laxity.md)

/// [m] Least anterior displacement of a usual knee at 134 N. Fails first: nothing (said).
inline constexpr double kLeastDrawer = 2e-3;

/// [m] Largest such. Fails first: nothing (said).
inline constexpr double kMostDrawer = 10e-3;

/// [deg] Least varus and valgus together at 10 N m. Fails first: nothing (said).
inline constexpr double kLeastSideways = 2;

/// [deg] Largest such. Fails first: nothing (said).
inline constexpr double kMostSideways = 10;

/// [deg] Least internal and external rotation together at 5 N m. Fails first: nothing (said).
inline constexpr double kLeastRotation = 15;

/// [deg] Largest such. Fails first: nothing (said).
inline constexpr double kMostRotation = 50;

/// [m] How far inside its range the drawer is aimed at. Fails first: if too small, finer steps of the test are outside.
inline constexpr double kDrawerMargin = 0.3e-3;

/// [deg] The same of varus and valgus. Fails first: as above.
inline constexpr double kSidewaysMargin = 0.5;

/// [deg] The same of rotation. Fails first: as above.
inline constexpr double kRotationMargin = 1.5;

/// [mm or deg] What cutting a ligament has to add in its own direction, in the mean of the angles. Fails first: nothing
/// (said).
inline constexpr double kLeastCut = 0.5;

/// [mm or deg] How far above that, and above what cutting another adds there, is aimed at. Fails first: if too small,
/// finer steps of the test change the order.
inline constexpr double kCutMargin = 0.2;

/// [1] Factor of the slack length of a ligament that is cut. Fails first: if too small, it carries where a cut knee
/// goes far.
inline constexpr double kCutLength = 10;

/// [1] Increments of a laxity test of a new knee. Fails first: if too small, curves end that finer ones finish.
inline constexpr int kNewKneeIncrements = 2;

// new_aims

/// [1] Most that a strain is raised. Fails first: if too large, a ligament's strain is none of a living knee.
inline constexpr double kMostTightened = 0.024;

/// [1] Most that the strain of a cruciate or a collateral ligament is lowered. Fails first: if too large, it is slack
/// in all of passive flexion.
inline constexpr double kMostSlackened = 0.03;

/// [1] Most that the strain of a capsule or of the popliteofibular ligament is lowered. Fails first: if too large, the
/// posterior corners of the knee hold nothing.
inline constexpr double kMostCornerSlackened = 0.06;

/// [1] Largest factor of the stiffness of ligaments (LCL 2000 N at a strain of 1, MCL 5500 N, PCL 9000 N without it).
/// Fails first: if too large, a ligament is stiffer than any that was measured.
inline constexpr double kStiffestLigaments = 2;

/// [1] Least such factor. Fails first: if too small, a knee whose other ligaments are cut snaps.
inline constexpr double kSoftestLigaments = 0.6;

/// [1] Largest factor of the stiffness of the menisci. Fails first: if too large, menisci hold a knee whose ligaments
/// are wrong.
inline constexpr double kStiffestMenisci = 2;

/// [1] Least such factor. Fails first: if too small, a knee whose MCL is cut snaps.
inline constexpr double kSoftestMenisci = 0.4;

/// [1] Change of a strain that counts as one (kAimWeight). Fails first: if too large beside the stiffness, strains
/// change where stiffnesses would do.
inline constexpr double kUsualStrain = 0.02;

/// [1] The same of the logarithm of a stiffness. Fails first: if it is too large beside the strain, stiffnesses change
/// where strains would do.
inline constexpr double kUsualStiffness = 0.35;

/// [1] Weight of a usual change beside a violation by one margin, of their squares. Fails first: if too large, values
/// stay outside; if too small, ligaments change without need.
inline constexpr double kAimWeight = 0.02;

/// [1] Longest first step of an aim, in usual changes. Fails first: if too large, the derivatives do not hold that far.
inline constexpr double kAimReach = 1.2;

/// [1] Reach below which no further step is tried. Fails first: if too large, knees are left outside; if too small,
/// time.
inline constexpr double kLeastReach = 0.1;

/// [1] Part of a reach that is tried next where a step has not helped. Fails first: if too large, time; if too small, a
/// good step is stepped over.
inline constexpr double kShorterReach = 1.0 / 3;

/// [of the margins] How far inside the ranges a knee is left as it is. Fails first: if too small, finer steps of the
/// test are outside; if too large, rounds.
inline constexpr double kAimedEnough = 0.5;

/// [1] Steps of the least squares of a linear model. Fails first: if too small, its step is not the best.
inline constexpr int kAimIterations = 200;

/// [1] Violation that a value without a curve counts as, in margins. Fails first: if too small, curves are given up for
/// values inside.
inline constexpr double kMissingCurve = 3;

/// [1] Usual changes by which what holds a knee is tightened where curves end. Fails first: if too small, rounds; if
/// too large, knees become stiffer than needed.
inline constexpr double kTightenStep = 0.5;

/// [1] Steps after which ligaments stay as they are. Fails first: if too small, knees are left outside of the ranges;
/// if too large, time.
inline constexpr int kAimRounds = 8;

/// [1] Trials of a knee that was changed, the second from where the first is in balance. Fails first: if too small, the
/// reference pose is not in balance.
inline constexpr int kAimTrials = 2;

// new_ligaments

/// [1] Transition strain of ligaments of common proportions. Fails first: nothing (chosen, and said to be).
inline constexpr double kProportionTransition = 0.06;

/// [deg] Flexion up to which fibres of a new scene reach the strain of their bundle. Fails first: if too small, fibres
/// that are taut in deep flexion alone overload it; if too large, they leave all else slack.
inline constexpr double kSettledFlexion = 100;

/// [1] Strain that no fibre of a new scene exceeds in passive flexion. Fails first: if too small, the knee becomes lax;
/// if too large, single fibres carry what their bundle should.
inline constexpr double kMostNewStrain = 0.08;

/// [1] Trials in which the menisci of a new scene settle too. Fails first: if too small, they pull where they should
/// not; if too large, knee and menisci drift together.
inline constexpr int kMeniscusRounds = 3;

/// [1] Strain of the fibres of menisci in the mean of passive flexion. Fails first: if too small, nothing holds a slack
/// knee where its fibres are slack too, and laxity curves end near 0 N; if too large, menisci move the knee.
inline constexpr double kMeniscusStrain = 0.025;

/// [m] Change of a slack length below which it is settled. Fails first: if too small, trials; if too large, menisci
/// pull where they should not.
inline constexpr double kSettledLength = 2e-4;

/// [deg] Turn of bones against the axes of their files that gets a warning (knees whose files have the axes of the
/// body: 3 to 7, drawn bones: 10). Fails first: if too large, flexion is about an axis that is none, in silence.
inline constexpr double kMostTurned = 15;

/// [m] Misfits of the reference knee on both meshes together, below which nothing else is tried (shape-model knees: 0.4
/// to 0.8 mm). Fails first: if too large, exchanged bones pass; if too small, time.
inline constexpr double kSmallMisfit = 0.9e-3;

/// [1] Ratio of misfits of a knee and its mirror image that tells which it is; the square, of other mistakes. Fails
/// first: if too large, chance decides.
inline constexpr double kSideFits = 0.8;

// new_pieces

/// [m] Distance from a bone up to which its cartilage reaches. Fails first: if too small, thick cartilage is taken for
/// bone; if too large, so is a bone beside another one.
inline constexpr double kCartilageReach = 8e-3;

/// [1] Part of a mesh within that distance of a bone from which it can be its cartilage. Fails first: if too large,
/// cartilage that reaches beyond the mesh of its bone is taken for bone.
inline constexpr double kAllNear = 0.8;

/// [1] The same for the second of two files that shape does not tell apart. Fails first: if too small, two pieces of a
/// bone are taken for bone and cartilage.
inline constexpr double kMostlyNear = 0.5;

/// [m] Mean height over a bone above which a sheet is on it. Fails first: if too small, the bone under a closed sheet
/// of cartilage is taken for cartilage.
inline constexpr double kCartilageHeight = 0.2e-3;

/// [m] Thickness of a closed mesh above which it is no cartilage (cartilage of knees 2 to 4 mm, a femur's shaft 14).
/// Fails first: if too small, thick cartilage is taken for bone.
inline constexpr double kThickestCartilage = 6e-3;

/// [1] Vertices of a mesh that are looked at. Fails first: if too small, chance decides.
inline constexpr std::size_t kPieceSamples = 400;

// new_patella

/// [m] Distance from the femur up to which a mesh can be its patella. Fails first: if too small, patellae of knees with
/// an effusion are refused; if too large, those of another frame are taken.
inline constexpr double kPatellaAway = 0.03;

/// [1] Length over the tibia's width above which a mesh is no patella (patellae: 0.45 to 0.65). Fails first: if too
/// small, patellae with a piece of tendon are refused; if too large, femora are taken for one.
inline constexpr double kLargestPatella = 0.9;

// new_picture

/// [m] How far an end of a scene may be from where the reference knee or a landmark has it, to be that one: scenes have
/// tenths of a millimetre. Fails first: nothing (pictures).
inline constexpr double kWrittenEnd = 1e-4;

// new_side

/// [of the tibia's width] Sum of both, from which on they are not asked against how the reference knee fits. Fails
/// first: if too small, an unusual knee is taken for the other side; if too large, time.
inline constexpr double kSideSure = 0.1;

}  // namespace genu
