// Every tolerance of the room `store`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cstddef>
#include <cstdint>

namespace genu {

// checkpoint

/// [1] Tries to lock a checkpoint; a killed run takes a moment to release it. Fails first: if too small, --resume is
/// refused.
inline constexpr int kMaxLockTries = 40;

/// [us] Pause between them. Fails first: if too small, --resume is refused.
inline constexpr unsigned kLockPause = 50'000;

/// [1] Share of a run's time that checkpoints may take. Fails first: if too large, slow runs on slow disks.
inline constexpr double kCheckpointShare = 0.05;

// failure_file

/// [B] Least memory limit that a failure file may ask for. Fails first: if too small, the program cannot start.
inline constexpr std::uint64_t kMinMemoryLimit = std::uint64_t{1} << 26;

// read_results

/// [m] Distance of a written contact from the scene's surface. Fails first: if too small, written digits refuse a
/// result.
inline constexpr double kSameSurface = 1e-6;

// stop_of

/// [B] Memory kept to save results when memory is short. Fails first: if too small, rows are lost.
inline constexpr std::size_t kStopReserve = std::size_t{8} << 20;

}  // namespace genu
