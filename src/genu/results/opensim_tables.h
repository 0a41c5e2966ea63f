// Results in OpenSim's words and units: SI throughout, but angles in degrees.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/results/report.h"

namespace genu {

/// The coordinates that are written, and what OpenSim calls each.
using OpenSimNames = std::vector<std::pair<CoordinateRef, std::string>>;

/// `rows` of the run's table, at `times` (s): degrees and metres. Column `time`, then one for each name.
ResultTable opensim_motion(const ReportRun& run, const OpenSimNames& names, const std::vector<std::size_t>& rows,
                           const std::vector<double>& times);

/// Forces at the same rows; N, N m, m, m^2, Pa:
///   LIGAMENT.force_total, .length, .strain             as OpenSim-JAM's Blankevoort1991Ligament reports them
///   CONTACT.contact_force_x ..., .contact_moment_x ... on the second surface's body, in its axes, about its origin
///   CONTACT.center_of_pressure_x ...                   in that body; nan where nothing touches
///   CONTACT.contact_area, .pressure_mean, .pressure_max, .proximity_max    of elastic layers and their regions
///   COORDINATE_moment, COORDINATE_force                what a prescribed coordinate costs, as inverse dynamics names
///   it JOINT.reaction_force_x ..., .reaction_moment_x ... of joints that hold, on the child, in the parent's axes
ResultTable opensim_forces(const ReportRun& run, const OpenSimNames& names, const std::vector<std::size_t>& rows,
                           const std::vector<double>& times);

}  // namespace genu
