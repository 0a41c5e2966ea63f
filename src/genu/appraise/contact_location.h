// How well the places of contacts are known, given the noise of the meshes they were found on.
//
// Where two surfaces touch, their gap is (1/2) s . K s over the common tangent plane, K the relative curvature. Noise
// turns the normals against each other by sigma_slope, which moves the touching point by K^-1 sigma_slope: along the
// direction of least relative curvature kappa by sigma_slope / kappa. Noise changes kappa itself by sigma_curvature: of
// a smaller one no more is known than that it is about sqrt(kappa^2 + sigma_curvature^2), which takes its place here.
// Where kappa / sigma_curvature is below 10, the surfaces are nearly parallel for all that is known, and the place of
// the contact is doubtful. (All at given orientations of the bodies: where a joint is free to tilt, the place moves
// less.) The pose is not: heights are known much better than slopes. So this qualifies the place and refuses nothing.
#pragma once

#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/pose_table.h"
#include "genu/results/summary.h"

namespace genu {

/// One entry for each contact pair with a noisy mesh that some solved pose has in contact.
std::vector<ContactLocation> locate_contacts(const Prepared& prepared, const std::vector<PoseRecord>& records);

}  // namespace genu
