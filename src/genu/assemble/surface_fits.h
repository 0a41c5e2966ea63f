// Fitted surfaces with what a user gets of them: tables of a scene, a picture, numbers.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/scene/scene.h"
#include "genu/shape_fit/surface_fit.h"

namespace genu {

struct NamedFit {
  std::string name;  ///< of the surface
  std::string body;
  std::string source;          ///< what it was fitted to, for people
  SurfaceFit fit;              ///< in the body's frame
  std::vector<Vec3> contacts;  ///< m, in the body: where contacts were, if that is known
};

/// The polynomial as a scene has it.
SurfaceDef surface_def(const NamedFit& fit);

/// What a scene's table says of a fit's chart and patch; empty for a surface that is no polynomial with a patch of its
/// chart alone.
std::optional<KnownPatch> known_patch(const SurfaceDef& def);

/// "cylindrical, degree 9, patch 176 deg x 19.8 mm, rms 0.057 mm along its normal,
/// largest 0.331 mm at [1, 2, 3] mm, 3139 vertices".
std::string describe(const SurfaceFit& fit);

/// What speaks against using a fit: residuals far above the mesh's noise, a degree that had to be lowered. A sentence
/// each; none where it is a good one.
std::vector<std::string> doubts(const SurfaceFit& fit);

/// The tables of the surfaces, each under a comment that says how well it fits.
std::string surface_tables(const std::vector<NamedFit>& fits, double length_unit, double angle_unit);

/// The files of a fit, but for scene files: name and content. coverage.svg, summary.json.
std::vector<std::pair<std::string, std::string>> fit_files(const std::vector<NamedFit>& fits);

/// Writes files into a folder that appears whole or not at all. Returns what went wrong, else an empty text.
std::string write_folder(const std::string& folder, const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace genu
