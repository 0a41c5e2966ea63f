// Every tolerance of the room `osim`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cstddef>

namespace genu::osim {

// xml_tree

/// [1] Elements inside each other; models written by OpenSim have up to 15. Fails first: if too large, a file made to
/// harm exhausts the stack.
inline constexpr int kMaxDepth = 100;

/// [byte] Largest model file; full-body models have 1 to 5 MB. Fails first: if too large, a file made to harm exhausts
/// the memory.
inline constexpr std::size_t kMaxFileSize = 64'000'000;

// skeleton

/// [1] Deviation of a rotation axis from a coordinate axis, and of a slope from 1 or -1, that counts as none. Fails
/// first: if too large, a joint is imported with axes that it does not have; if too small, axes of five decimals are
/// refused.
inline constexpr double kAxisRounding = 1e-9;

/// [m, 1] Difference of two frames of one rigid body that counts as none. Fails first: if too small, round-off of a
/// chain of offsets makes two frames of one.
inline constexpr double kSameFrame = 1e-9;

// scene_numbers

/// [mm, 1] Numbers below it are written as 0. Fails first: if too large, coordinates lose digits.
inline constexpr double kWrittenAsZero = 1e-10;

}  // namespace genu::osim
