// Every tolerance of the room `mesh_care`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cstddef>

namespace genu {

// mesh_crossings

/// [1] Relative volume of a tetrahedron that is round-off. Fails first: if too small, touching triangles count as
/// crossing; if too large, crossings are missed.
inline constexpr double kVolumeRounding = 1e-14;

/// [1] Relative area of a flat triangle that is round-off. Fails first: if too small, touching edges count as crossing.
inline constexpr double kTurnRounding = 1e-12;

// mesh_examination

/// [1] Fewer triangles than this get a note: a joint's surface has hundreds. Fails first: if too large, coarse test
/// meshes get a note.
inline constexpr std::size_t kFewTrianglesOfMesh = 100;

/// [1] Fewer triangles are no surface (a tetrahedron has four). Fails first: if too large, a tetrahedron is refused.
inline constexpr std::size_t kMinTrianglesOfMesh = 4;

// mesh_flaws

/// [1] Area of a piece over that of the largest below which it is a scrap. Fails first: if too large, the smaller
/// plateau of a tibia is reported.
inline constexpr double kScrapShare = 0.1;

/// [1] Area of a part over that of its piece below which it is a fin or fold. Fails first: if too large, a healthy half
/// is reported.
inline constexpr double kFinShare = 0.25;

/// [1] Vertices of a loop that are looked at. Fails first: if too small, a loop's shape is misjudged.
inline constexpr std::size_t kMaxSpokes = 64;

/// [rad] Sum of a vertex's angles below which it is a spike (2 pi when flat, 4.7 at a cube's corner). Fails first: if
/// too large, corners of cubes are reported.
inline constexpr double kSteepFan = 4.5;

/// [1] Mean cosine to a loop's plane below which the surface leaves it as a tube. Fails first: if too large, an open
/// sheet's border is reported as a tube.
inline constexpr double kTubeCosine = 0.5;

/// [1] Fewest vertices of a loop that can be a tube's end. Fails first: if too small, small holes are reported as
/// tubes.
inline constexpr std::size_t kMinTubeVertices = 12;

/// [1] Length of a loop over sqrt(4 pi area) above which it is the border of a sheet (a disc has 1). Fails first: if
/// too small, holes pass for borders.
inline constexpr double kLongLoopShare = 0.3;

// mesh_repair

/// [1] Longest loop that is filled; the time grows with its cube. Fails first: if too large, repair takes hours.
inline constexpr std::size_t kMaxFilledEdges = 1000;

/// [1] Rounds in which a filling that crosses its surroundings is enlarged. Fails first: if too small, repaired meshes
/// cross themselves.
inline constexpr int kMaxFillRounds = 4;

// mesh_shape

/// [1] Vertices at which the shape's curvature is sampled. Fails first: if too small, the summary of a mesh is noisy.
inline constexpr std::size_t kMaxShapeFits = 1000;

/// [1] Rays with which thickness is sampled. Fails first: if too small, a thin place is missed.
inline constexpr std::size_t kMaxThicknessRays = 400;

/// [1] Ray-triangle tests spent on thickness. Fails first: if too large, mesh-check is slow on large meshes.
inline constexpr double kThicknessRayTests = 4e7;

// piece_meetings

/// [m] Distance of the pieces of a surface below which they are said to touch. Fails first: if too small, a slit in a
/// surface is not told; if too large, the two plateaus of a tibia are said to touch.
inline constexpr double kPiecesTouch = 0.5e-3;

// mesh_smooth

/// [edge] Wavelength above which smoothing leaves a shape. Fails first: if too large, condyles are flattened.
inline constexpr double kSmoothedEdges = 16;

/// [1] Share of the way to the neighbours' mean in a step that shrinks (Taubin 1995). Fails first: above 1 it swings.
inline constexpr double kSmoothStep = 0.5;

/// [1] Rounds times the eigenvalue that passes. Fails first: if too small, steps stay.
inline constexpr double kSmoothRounds = 4;

// noise_field

/// [1] Cosine waves of a random noise field. Fails first: if too small, error bars of noise are not Gaussian.
inline constexpr int kNoiseWaves = 400;

}  // namespace genu
