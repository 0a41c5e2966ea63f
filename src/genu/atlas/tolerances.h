// Numbers of the atlas that decide an outcome. docs/tolerances.md is made from this header.
#pragma once

#include <cstddef>

namespace genu {

// point_tree

/// [m] How far two points with opposite normals are apart, half of it counted for their turn. Fails first: if too
/// small, points find partners on the other side of a sheet; if too large, none on a surface that is bent more.
inline constexpr double kTurnLength = 8e-3;

/// [1] Most vertices of a mesh that are asked. Fails first: if too small, partners are far to the side; if too large,
/// time.
inline constexpr std::size_t kMostTargets = 40000;

// registration

/// [1] Iterations of each kind of map. Fails first: if too small, the map is not at its end.
inline constexpr int kMapIterations = 40;

/// [1] Iterations of each start before the best of them goes on. Fails first: if too small, a poor start is chosen.
inline constexpr int kStartIterations = 12;

/// [deg] Tilt of the further starts. Fails first: if too small, oblique scans are not matched.
inline constexpr double kStartTilt = 25;

/// [m] How far to the side of a point its partner may be at a start. Fails first: if too small, rough starts find no
/// partners; if too large, a shaft that the mesh has not pulls at its end.
inline constexpr double kStartAside = 0.03;

/// [m] The same at the end. Fails first: if too small, coarse meshes have no partners; if too large, what the mesh has
/// not pulls at its rim.
inline constexpr double kPartnerAside = 6e-3;

/// [1] Points of a mesh that are asked whether the reference shows them. Fails first: if too small, chance.
inline constexpr std::size_t kAskedTargets = 1000;

/// [1] Partners below which a map is left as it is. Fails first: if too small, singular equations.
inline constexpr std::ptrdiff_t kFewPartners = 30;

/// [m] Least misfit that is called usual. Fails first: if too small, noise of meshes gets no weight.
inline constexpr double kLeastMisfit = 1.5e-3;

/// [1] Usual misfit over the median. Fails first: if too small, what differs between people is ignored.
inline constexpr double kUsualMisfit = 2.5;

/// [m] Misfit within which a point is matched. Fails first: nothing (doubts only).
inline constexpr double kMatched = 3e-3;

/// [m] Reach b of the field. Fails first: if too small, insertions beyond the matched surface do not move along; if too
/// large, local shape is not followed.
inline constexpr double kFieldReach = 0.03;

/// [1] Weight lambda of the field's smoothness. Fails first: if too small, the field follows noise.
inline constexpr double kFieldSmoothness = 3;

/// [1] Places c_k of the field. Fails first: if too small, the field is coarser than its reach.
inline constexpr std::size_t kFieldPlaces = 150;

// fitted_knee

/// [m] Distance from the mesh within which an insertion is put onto it. Fails first: if too small, insertions float; if
/// too large, those on the fibula are put onto the tibia.
inline constexpr double kOntoMesh = 8e-3;

/// [m] Distance from the fibula within which the insertions that belong on it are put onto it. Fails first: if too
/// small, they float beside it; if too large, another bone is taken for it.
inline constexpr double kOntoFibula = 15e-3;

/// [of how far they are moved] What it adds to their standard error. Fails first: if too small, ends that the fibula
/// contradicts are said to be certain.
inline constexpr double kPutAsFar = 0.5;

/// [m] How much insertions differ between people beyond the shape of their bones (standard deviation; ACL and MCL
/// footprints: 1.5 to 3 mm). Fails first: if too small, the stated error is too small.
inline constexpr double kPeopleDiffer = 2.5e-3;

/// [1] Error for each metre from what was matched. Fails first: if too small, the error of what is beyond is.
inline constexpr double kErrorBeyond = 0.12;

/// [m] Misfit (median) above which a registration is poor. Fails first: if too large, meshes that are no knee get
/// ligaments of one.
inline constexpr double kPoorMisfit = 2.5e-3;

/// [m] The same of the patella's cartilage, which is small and nearly flat (patellae: 0.15 to 0.4 mm). Fails first: if
/// too large, any flat mesh is a patella.
inline constexpr double kPoorPatella = 8e-4;

/// [1] Least part of the reference that is matched. Fails first: if too large, bones cut short are refused.
inline constexpr double kLeastMatched = 0.5;

/// [1] Part of a mesh that cartilage of the reference shows, from which it is a joint surface alone (sheets: 0.97 to 1;
/// bones: at most 0.67, of a femur cut 25 mm above its notch). Fails first: if too large, cartilage is taken for bone
/// and insertions are put onto it; if too small, bones cut very short are taken for cartilage.
inline constexpr double kAllArticular = 0.85;

/// [1] How much less than taut a fibre of the reference counts in its slack length. Fails first: if too small, the
/// length hangs on few poses; if too large, on poses in which it carries nothing.
inline constexpr double kNearlyTaut = 0.01;

/// [1] How much more a fibre may strain than that of the reference does at most. Fails first: if too small, fibres are
/// slack where the reference's are taut; if too large, single fibres carry what their bundle should.
inline constexpr double kMoreTaut = 0.15;

}  // namespace genu
