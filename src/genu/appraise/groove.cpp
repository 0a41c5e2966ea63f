#include "genu/appraise/groove.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/appraise/tolerances.h"

namespace genu {
namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();

struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void see(double x) { low = std::min(low, x), high = std::max(high, x); }
  double middle() const { return (low + high) / 2; }
  double width() const { return high - low; }
};

/// Heights of a cut over equal pieces of the lateral axis; kNothing where there is no surface.
struct Profile {
  double from = 0;
  std::vector<double> height;

  double middle_of(std::size_t first, std::size_t last) const {
    return from + kProfilePiece * (static_cast<double>(first + last + 1) / 2);
  }
};

/// Of points within half a piece of the plane through `on` with normal `across`. What lies lower than its highest point
/// by more than `depth` is no surface that a patella glides on: the plane meets the rear of the condyles too.
Profile cut(const std::vector<Vec3>& points, const Span& span, const Vec3& on, const Vec3& across, const Vec3& lateral,
            const Vec3& up, double depth) {
  Profile out{span.low, {}};
  out.height.assign(static_cast<std::size_t>(span.width() / kProfilePiece) + 1, kNothing);
  for (const Vec3& p : points) {
    if (std::abs(across.dot(p - on)) > kProfilePiece / 2) continue;
    double& height = out.height[static_cast<std::size_t>((lateral.dot(p) - span.low) / kProfilePiece)];
    height = std::max(height, up.dot(p - on));
  }
  const double highest = *std::max_element(out.height.begin(), out.height.end());
  for (double& height : out.height)
    if (height < highest - depth) height = kNothing;
  return out;
}

struct Groove {
  double middle = 0, depth = 0;
};

/// The deepest one whose deepest place is in the middle half of the profile: hollows beside a condyle are none. A notch
/// without a surface is as deep as from the lower crest to the lowest point of the cut.
Groove deepest(const Profile& profile) {
  const std::size_t n = profile.height.size();
  std::vector<double> left(n, kNothing), right(n, kNothing), depth(n, 0);
  double lowest = std::numeric_limits<double>::infinity();
  for (const double h : profile.height)
    if (h > kNothing) lowest = std::min(lowest, h);
  for (std::size_t i = 1; i < n; ++i) {
    left[i] = std::max(left[i - 1], profile.height[i - 1]);
    right[n - 1 - i] = std::max(right[n - i], profile.height[n - i]);
  }
  for (std::size_t i = 0; i < n; ++i)
    if (const double crest = std::min(left[i], right[i]); crest > kNothing)
      depth[i] = std::max(0.0, crest - std::max(profile.height[i], lowest));
  const auto begin = depth.begin() + static_cast<std::ptrdiff_t>(n / 4),
             end = depth.end() - static_cast<std::ptrdiff_t>(n / 4);
  if (begin == end) return {};
  const std::size_t at = static_cast<std::size_t>(std::max_element(begin, end) - depth.begin());
  if (!(depth[at] > 0)) return {};
  std::size_t first = at, last = at;
  while (first > 0 && depth[first - 1] >= depth[at] / 2) --first;
  while (last + 1 < n && depth[last + 1] >= depth[at] / 2) ++last;
  return {profile.middle_of(first, last), depth[at]};
}

}  // namespace

std::optional<PatellaAcross> patella_across(const std::vector<Vec3>& femur, const std::vector<Vec3>& patella,
                                            const Pose& X_FP, const Vec3& lateral, const Vec3& anterior) {
  const Vec3 turned = X_FP.R * anterior, along = turned - lateral.dot(turned) * lateral;
  if (femur.empty() || patella.empty() || !(along.norm() > kLeastAcross)) return std::nullopt;
  const Vec3 up = along.normalized(), across = up.cross(lateral);
  Span own, whole;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : patella) {
    const Vec3 x = X_FP * p;
    middle += x / static_cast<double>(patella.size());
    own.see(lateral.dot(x));
  }
  // Distal of the femur is where the trochlea goes on round it: the side of the cut where more of its surface lies.
  double side = 0;
  for (const Vec3& p : femur) {
    side += across.dot(p - middle);
    whole.see(lateral.dot(p));
  }
  for (double away = 0; away <= kGrooveReach; away += kProfilePiece) {
    const Groove groove = deepest(
        cut(femur, whole, middle + std::copysign(away, side) * across, across, lateral, up, kFrontOfCut * own.width()));
    if (groove.depth < kLeastGroove) continue;
    return PatellaAcross{own.middle(), own.width(), groove.middle, groove.depth};
  }
  return std::nullopt;
}

}  // namespace genu
