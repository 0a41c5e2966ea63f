#include "genu/surface/blend_field.h"

#include <algorithm>
#include <limits>

#include "genu/surface/tolerances.h"

namespace genu {
namespace {

Vec3 centre_of(const double* record) { return {record[0], record[1], record[2]}; }

void pack(const HeightFit& fit, int degree, double* record) {
  for (int k = 0; k < 3; ++k) {
    record[k] = fit.origin[k];
    for (int a = 0; a < 3; ++a) record[3 + 3 * a + k] = fit.axes(k, a);
  }
  for (int i = 0; i <= fit.degree; ++i) {
    for (int j = 0; j <= fit.degree - i; ++j) {
      record[BlendNodes::kHeader + coefficient_index(degree, i, j)] =
          fit.coefficients[coefficient_index(fit.degree, i, j)];
    }
  }
}

}  // namespace

BlendField::BlendField(std::span<const HeightFit> fits, std::vector<int> sheet, int degree, double blend_radius,
                       const std::vector<Crease>& creases)
    : degree_(degree),
      blend_radius_(blend_radius),
      stride_(BlendNodes::kHeader + coefficient_count(degree)),
      records_(fits.size() * stride_, 0.0),
      sheet_(std::move(sheet)) {
  for (const Crease& c : creases) {
    across_.resize(std::max(across_.size(), static_cast<std::size_t>(std::max(c.a, c.b)) + 1));
    across_[static_cast<std::size_t>(c.a)].emplace_back(c.b, c.convex);
    across_[static_cast<std::size_t>(c.b)].emplace_back(c.a, c.convex);
  }
  std::vector<Vec3> centres;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    pack(fits[i], degree, &records_[i * stride_]);
    centres.push_back(fits[i].origin);
  }
  cells_ = CellLists(centres, std::span(&blend_radius, 1), 0.5 * blend_radius);
  mixed_.assign(cells_.cell_count(), 0);
  for (int c = 0; c < cells_.cell_count(); ++c) {
    const auto list = cells_.list(c);
    mixed_[c] = std::any_of(list.begin(), list.end(), [&](int i) { return sheet_[i] != sheet_[list[0]]; });
  }
}

int BlendField::nearest_node(const Vec3& x) const { return nearest_node(x, cells_.at(x)); }

int BlendField::nearest_node(const Vec3& x, std::span<const int> candidates) const {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int i : candidates) {
    const double* record = &records_[static_cast<std::size_t>(i) * stride_];
    const Vec3 d = x - centre_of(record);
    const double across = d.x() * record[9] + d.y() * record[10] + d.z() * record[11];
    const double squared = d.squaredNorm();
    if (squared >= blend_radius_ * blend_radius_) continue;
    const double score = across * across + kSidewaysWeight * squared;
    if (score < least) least = score, best = i;
  }
  return best;
}

/// The sheet that answers for x where those of a crease are in reach.
template <int D>
int BlendField::across_creases(const Vec3& x, std::span<const int> candidates, int nearest) const {
  if (static_cast<std::size_t>(nearest) >= across_.size() || across_[static_cast<std::size_t>(nearest)].empty())
    return nearest;
  BlendJet here, beyond;
  if (!blend_sum<D, 0>(nodes(), x, candidates, nearest, here)) return nearest;
  int sheet = nearest;
  for (const auto& [other, convex] : across_[static_cast<std::size_t>(nearest)]) {
    if (!blend_sum<D, 0>(nodes(), x, candidates, other, beyond)) continue;
    if (convex ? beyond.f > here.f : beyond.f < here.f) here.f = beyond.f, sheet = other;
  }
  return sheet;
}

template <int D, int Order>
bool BlendField::evaluate(const Vec3& x, BlendJet& out) const {
  const int cell = cells_.cell_of(x);
  const auto candidates = cells_.list(cell);
  if (candidates.empty()) return false;
  int sheet = -1;
  if (mixed_[cell]) {
    const int nearest = nearest_node(x, candidates);
    if (nearest < 0) return false;
    sheet = sheet_[nearest];
    if (!across_.empty()) sheet = across_creases<D>(x, candidates, sheet);
  }
  return blend_sum<D, Order>(nodes(), x, candidates, sheet, out);
}

template <int Order>
bool BlendField::dispatch(const Vec3& x, BlendJet& out) const {
  switch (degree_) {
    case 2:
      return evaluate<2, Order>(x, out);
    case 3:
      return evaluate<3, Order>(x, out);
    default:
      return evaluate<4, Order>(x, out);
  }
}

bool BlendField::value(const Vec3& x, double& f) const {
  BlendJet jet;
  const bool known = dispatch<0>(x, jet);
  f = jet.f;
  return known;
}

bool BlendField::value(const Vec3& x, double& f, Vec3& gradient) const {
  BlendJet jet;
  const bool known = dispatch<1>(x, jet);
  f = jet.f;
  gradient = jet.gradient;
  return known;
}

bool BlendField::value(const Vec3& x, double& f, Vec3& gradient, Mat3& hessian) const {
  BlendJet jet;
  const bool known = dispatch<2>(x, jet);
  f = jet.f;
  gradient = jet.gradient;
  hessian = jet.hessian;
  return known;
}

}  // namespace genu
