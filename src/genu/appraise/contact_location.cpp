#include "genu/appraise/contact_location.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "genu/appraise/tolerances.h"
#include "genu/contact/contact_equations.h"
#include "genu/core/decompositions.h"

namespace genu {
namespace {

FitUncertainty uncertainty_of(const Prepared& prepared, const std::shared_ptr<const Surface>& surface) {
  const auto at = std::find(prepared.surfaces.begin(), prepared.surfaces.end(), surface);
  const auto index = static_cast<std::size_t>(at - prepared.surfaces.begin());
  if (index >= prepared.notes.size() || !prepared.notes[index].blend) return {};
  return prepared.notes[index].blend->facts().uncertainty;
}

/// 1/m, of stable contact: below 0 it is rounding.
double least_relative_curvature(const State& state, const JointModel::Pair& pair, const ContactGeometry& geometry) {
  const Mat2 K = relative_curvature(state.poses[static_cast<std::size_t>(pair.body_a)],
                                    state.poses[static_cast<std::size_t>(pair.body_b)], geometry);
  const Mat2 symmetric = 0.5 * (K + K.transpose());
  return std::max(0.0, symmetric_eigen(symmetric).values[0]);
}

}  // namespace

std::vector<ContactLocation> locate_contacts(const Prepared& prepared, const std::vector<PoseRecord>& records) {
  std::vector<ContactLocation> out;
  for (int p = 0; p < static_cast<int>(prepared.model.pairs.size()); ++p) {
    const JointModel::Pair& pair = prepared.model.pairs[static_cast<std::size_t>(p)];
    const FitUncertainty a = uncertainty_of(prepared, pair.a), b = uncertainty_of(prepared, pair.b);
    const double slope = std::hypot(a.slope, b.slope), curvature = std::hypot(a.curvature, b.curvature);
    if (!(curvature > 0)) continue;
    ContactLocation location;
    location.contact = pair.name;
    location.curvature_uncertainty = curvature;
    std::vector<double> spreads;
    for (std::size_t i = 0; i < records.size(); ++i) {
      if (!records[i].point.solved()) continue;
      const State& state = records[i].point.pose.state;
      double least = std::numeric_limits<double>::infinity();
      for (const ActiveContact& contact : state.contacts) {
        if (contact.pair == p) least = std::min(least, least_relative_curvature(state, pair, contact.geometry));
      }
      if (!std::isfinite(least)) continue;
      ++location.poses;
      spreads.push_back(slope / std::hypot(least, curvature));
      if (least < kDoubtfulRatio * curvature) ++location.doubtful;
      if (least >= location.least_curvature) continue;
      location.least_curvature = least;
      location.record = i;
    }
    if (location.poses == 0) continue;
    location.spread = slope / std::hypot(location.least_curvature, curvature);
    const auto middle = spreads.begin() + static_cast<std::ptrdiff_t>(spreads.size() / 2);
    std::nth_element(spreads.begin(), middle, spreads.end());
    location.typical_spread = *middle;
    out.push_back(location);
  }
  return out;
}

}  // namespace genu
