// Every tolerance of the room `scene`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cstddef>
#include <cstdint>

namespace genu {

// shared by rooms

/// [SI] Largest number of a scene or table. Fails first: if too large, squares overflow.
inline constexpr double kMaxNumber = 1e20;

// centre_bodies

/// [size] Distance of a body's origin from the scene above which coordinates are centred (at 10 Newton needed twice the
/// iterations). Fails first: if too large, round-off of far origins.
inline constexpr double kFarFromCentre = 4;

/// [m] Size of a scene that shows none. Fails first: if too small, bodies are centred for nothing.
inline constexpr double kMinSceneSize = 0.01;

// check_scene

/// [m] Distance below which points coincide: far above the rounding of poses. Fails first: if too small, a load or
/// ligament has a direction of round-off.
inline constexpr double kCoincidentDistance = 1e-9;

// read_bushings

/// [1] Difference of two entries of a stiffness matrix, over the larger, and of its least eigenvalue below 0 over the
/// largest, that is rounding of the file. Fails first: if too small, matrices with six digits are refused.
inline constexpr double kSymmetric = 1e-6;

// read_contacts

/// [1] Finest relative tolerance of a layer. Fails first: if too small, refinement never ends.
inline constexpr double kMinLayerTolerance = 1e-8;

/// [1] Coarsest relative tolerance of a layer. Fails first: if too large, forces jump from pose to pose.
inline constexpr double kMaxLayerTolerance = 0.1;

// read_dynamics

/// [1] Most rows of a motion. Fails first: if too large, results.csv fills the disk.
inline constexpr double kMaxMotionRows = 1'000'000;

/// [1] Finest tolerance of a motion. Fails first: if too small, steps reach round-off.
inline constexpr double kMinMotionTolerance = 1e-12;

/// [1] Coarsest tolerance of a motion. Fails first: if too large, energy drifts.
inline constexpr double kMaxMotionTolerance = 1e-2;

/// [1] Violation of an inertia's triangle inequality, over the largest moment, that is round-off. Fails first: if too
/// small, flat bodies are refused.
inline constexpr double kInertiaRounding = 1e-9;

// read_joints

/// [1] Cosine of the angle between neighbouring rotations' axes up to which they are perpendicular as written. Fails
/// first: if too small, directions of three digits are refused; if too large, an axis is moved visibly.
inline constexpr double kAxesAskew = 1e-3;

/// [1] Sine of the angle between the first and the third axis above which the second is perpendicular to both. Fails
/// first: if too small, it is along the rounding of nearly equal axes.
inline constexpr double kAxesApart = 0.1;

/// [1] Length of a direction as written that is none. Fails first: if too large, directions of small numbers are
/// refused.
inline constexpr double kLeastDirection = 1e-6;

// read_parts

/// [rad] Directions closer than this define no plane (6 digits of input). Fails first: if too small, frames of
/// round-off.
inline constexpr double kParallelSine = 1e-6;

// read_patch

/// [half turn] Rounding of a patch's angles at a full turn. Fails first: if too small, a full circle in degrees is
/// refused.
inline constexpr double kAngleRangeRounding = 1e-12;

// read_solid_shapes

/// [1] Most parts of a solid. Fails first: if too large, evaluation is slow.
inline constexpr std::size_t kMaxSolidParts = 1000;

// read_solver

/// [1] Finest residual tolerance; round-off stops the fall some orders above. Fails first: if too small, no pose is
/// accepted.
inline constexpr double kMinSolverTolerance = 1e-14;

/// [1] Coarsest residual tolerance that is accepted and not taken for a mistake. Fails first: if too small, files of
/// old are refused.
inline constexpr double kMaxSolverTolerance = 1e-3;

/// [1] Residual tolerance that looser ones count as. Fails first: if too large, contacts that split are lost, and
/// events are sought in noise (time).
inline constexpr double kLoosestSolverTolerance = 1e-10;

// read_steps

/// [1] Most increments of a step. Fails first: if too large, memory for rows.
inline constexpr std::int64_t kMaxIncrements = 1'000'000;

/// [1] Part of a prescribed combination, over its length, that the earlier ones leave. Fails first: if too small,
/// dependent combinations are accepted and the pose is overconstrained.
inline constexpr double kDependentRowNorm = 1e-9;

// read_surfaces

/// [1] Largest exponent of a polynomial's term. Fails first: if too large, powers lose digits.
inline constexpr std::int64_t kMaxExponent = 20;

// read_thickness

/// [m] Largest search depth of a layer. Fails first: if too large, rays meet the far side of a bone.
inline constexpr double kMaxSearchDepth = 1;

// reader

/// [B] Largest scene file (the largest known has 14 kB). Fails first: if too large, hostile files fill memory.
inline constexpr std::size_t kMaxSceneBytes = 16u << 20;

// toml_document

/// [1] Deepest nesting of tables. Fails first: if too large, hostile files overflow the stack.
inline constexpr int kMaxTomlDepth = 32;

/// [1] Most dots of a key; tables are destroyed recursively. Fails first: if too large, hostile files overflow the
/// stack.
inline constexpr int kMaxDotsInKey = 250;

// unlikely_numbers

/// [1] Strain of a ligament above which it was probably written in percent (ligaments fail at 0.1 to 0.3). Fails first:
/// if too small, laws for large strains get a warning.
inline constexpr double kMostStrain = 0.5;

/// [1] Strain at the reference pose above which a ligament would have failed. Fails first: if too small, prestrained
/// bundles get a warning.
inline constexpr double kMostReferenceStrain = 0.3;

/// [1] Stiffness over that of a whole ligament of this name, or its inverse, that is probably in another unit. Fails
/// first: if too small, a ligament of many thin bundles gets a warning.
inline constexpr double kMostStiffnessRatio = 100;

/// [Pa] Largest Young's modulus of a layer that is no mistake of the unit (PEEK: 4e9). Fails first: if too small, an
/// implant gets a warning.
inline constexpr double kLikelyMaxModulus = 1e10;

/// [Pa] Smallest Young's modulus of a layer that is no mistake of the unit. Fails first: if too large, soft cartilage
/// gets a warning.
inline constexpr double kLikelyMinModulus = 2e4;

/// [m] Largest radius that is no mistake of the unit. Fails first: if too small, a nearly flat dish gets a warning.
inline constexpr double kLikelyMaxRadius = 3;

/// [m] Largest thickness of a layer that is no mistake of the unit (implants: 15 mm). Fails first: if too small, a
/// thick insert gets a warning.
inline constexpr double kLikelyMaxThickness = 0.03;

/// [m] Smallest thickness of a layer that is no mistake of the unit. Fails first: if too large, a finger's cartilage
/// gets a warning.
inline constexpr double kLikelyMinThickness = 5e-5;

/// [m] Smallest radius that is no mistake of the unit. Fails first: if too large, a rim gets a warning.
inline constexpr double kLikelyMinRadius = 2e-4;

// values

/// [m] Largest length of a scene. Fails first: if too large, squares lose digits.
inline constexpr double kMaxLength = 1e7;

/// [rad] Largest angle of a scene. Fails first: if too large, sines lose digits.
inline constexpr double kMaxAngle = 1e5;

// words

/// [1] Letters of a word that is suggested because it begins so. Fails first: if too small, one letter suggests a name
/// that has nothing to do with it.
inline constexpr std::size_t kShortestBeginning = 3;

/// [1] Longest word that gets a suggestion; the cost is quadratic. Fails first: if too large, hostile files take long.
inline constexpr std::size_t kLongestSuggested = 64;

/// [1] Longest name of an object; file names contain it. Fails first: if too large, files cannot be created.
inline constexpr std::size_t kLongestName = 100;

}  // namespace genu
