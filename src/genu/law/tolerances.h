// Every tolerance of the room `law`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

namespace genu {

// force_law

/// [1] Relative difference of force or stiffness at a break of a law that counts as a jump. Fails first: if too small,
/// round-off of the law's numbers makes nonsmooth points.
inline constexpr double kLawJumpTolerance = 1e-9;

}  // namespace genu
