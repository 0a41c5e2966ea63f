// Which of the settings that were tried is to be taken, and why, in one sentence.
#pragma once

#include "genu/study/accuracy_report.h"

namespace genu {

/// Sets report.targets; an error in `out` for each text that is none.
[[nodiscard]] bool read_targets(const AccuracyChoice& choice, AccuracyReport& report, Diagnostics& out);

/// Sets report.chosen, the fastest setting that keeps the targets, and report.sentence. First a mesh and a fit, then
/// their tolerance, if another one saves time. `closed_forms`: the scene is made of them, so that with targets it is a
/// mesh that is asked for. `own_tolerance`: of the scene.
void choose(AccuracyReport& report, bool closed_forms, double own_tolerance);

/// The chosen mesh and fit with each tolerance that solves the scene.
std::vector<AccuracySetting> tolerances_to_try(const AccuracyReport& report);

}  // namespace genu
