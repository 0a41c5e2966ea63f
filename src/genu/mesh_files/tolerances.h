// Every tolerance of the room `mesh_files`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cstddef>
#include <cstdint>

namespace genu {

// mesh_file_check

/// [1] Memory needed for each byte of a mesh file (measured on binary STL). Fails first: if too small, out of memory
/// instead of a refusal.
inline constexpr std::uint64_t kMemoryPerByte = 8;

// mesh_formats

/// [file unit] Largest coordinate; beyond it a file is damaged (1000 km in mm). Fails first: if too large, squares
/// overflow.
inline constexpr double kMaxCoordinate = 1e9;

/// [1] Most vertices or triangles of a mesh: an int counts three a triangle. Fails first: if too large, counters
/// overflow.
inline constexpr std::size_t kMaxMeshCount = 700'000'000;

// mesh_reader

/// [m] Step of coordinates above which rounding shows in curvature. Fails first: if too large, curvature of the smooth
/// surface is noise without a warning.
inline constexpr double kCoarseCoordinateStep = 2e-6;

/// [1] Fewest vertices from which decimals are recognised; fewer may be decimals by chance. Fails first: if too small,
/// designed shapes pass for rounded files.
inline constexpr std::size_t kMinDecimalVertices = 100;

// mesh_stl

/// [B] Beginning of a text file that is searched for what identifies it. Fails first: if too small, a file with a long
/// header is not recognised.
inline constexpr std::uint64_t kBytesSearched = 1 << 23;

/// [1] Share of control characters above which bytes are no text (binary STL has 0.04 or more of them). Fails first: if
/// too small, an ASCII file with a damaged place passes for binary.
inline constexpr double kMaxControlShare = 0.02;

// stl_writer

/// [m] Rounding of binary STL that changes no curvature visibly. Fails first: if too large, written meshes have noise.
inline constexpr double kUnseenRounding = 1e-6;

/// [edge] Rounding of binary STL, over the shortest edge, that turns no triangle visibly. Fails first: if too large,
/// written meshes have turned facets.
inline constexpr double kUnseenEdgeShare = 0.05;

// vtp_arrays

/// [1] Largest ratio of zlib's output to its input (zlib reaches 1032). Fails first: if too large, a damaged file asks
/// for all memory.
inline constexpr std::uint64_t kMaxInflation = 1100;

// mesh_space

/// [B] Beginning of a file in which its frame is looked for. Fails first: if too small, frames that differ are not
/// seen.
inline constexpr std::size_t kSpaceSearched = 4096;

}  // namespace genu
