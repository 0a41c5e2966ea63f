// The largest rectangle of a chart that a zone fills: where a polynomial that was fitted to the zone may be written
// down as a patch, because there is surface nearly everywhere under it.
#pragma once

#include <optional>
#include <vector>

#include "genu/mesh/mesh.h"
#include "genu/surface/surface_chart.h"

namespace genu {

struct CoveredBox {
  ChartBox box;
  double covered = 0;  ///< share of the box, 0 to 1, that the zone fills
};

/// The rectangle inside `limits` (and inside the zone's extent) with the most covered area, where a bare spot costs
/// kBareSpotCost times what a covered one brings; it holds `keep` as far as the extent does. An edge that is the zone's
/// own is its extreme coordinate, to rounding. Empty for a zone without area.
std::optional<CoveredBox> covered_box(const Mesh& zone, const SurfaceChart& chart,
                                      const std::optional<ChartBox>& limits, const std::optional<ChartBox>& keep);

}  // namespace genu
