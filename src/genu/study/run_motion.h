// A scene with [dynamics]: motion over time in the place of steps from equilibrium to equilibrium.
#pragma once

#include "genu/motion/motion.h"
#include "genu/study/run_scene.h"

namespace genu {

/// What the solver is asked for.
MotionPlan plan_motion(const DynamicsDef& dynamics);

/// Integrates the motion. What could not be is in the summary's exit code and verdict, never an error.
Solution solve_motion(const Prepared& prepared, const RunOptions& options);

/// Options that ask for what equilibria alone have are refused in `out`.
[[nodiscard]] bool check_motion_options(const Prepared& prepared, const RunOptions& options, Diagnostics& out);

/// Not one row, because the motion cannot begin (a body without inertia that nothing holds): said in `out`.
[[nodiscard]] bool refused_start(const Prepared& prepared, const Solution& found, Diagnostics& out);

/// What every command but `run` says of such a scene.
[[nodiscard]] bool refuse_motion(const Prepared& prepared, const char* command, Diagnostics& out);

}  // namespace genu
