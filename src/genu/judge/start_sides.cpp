#include "genu/judge/start_sides.h"

#include <algorithm>
#include <limits>

#include "genu/core/units.h"
#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

/// A vertex over the other mesh: how far in front, m (behind: negative), and where.
struct Over {
  double height = 0;
  Vec3 p = Vec3::Zero();
};

/// Some vertices of `from` over the triangle of `other` whose middle is nearest, where both face each other or lie back
/// to back. `X`: from the frame of `from` to that of `other`.
std::vector<Over> heights(const Facets& from, const Facets& other, const Pose& X) {
  std::vector<Over> out;
  const std::size_t stride = 1 + from.vertices().size() / kSideVertices;
  for (std::size_t v = 0; v < from.vertices().size(); v += stride) {
    if (!from.in_patch(from.vertices()[v])) continue;
    const Vec3 x = X * from.vertices()[v];
    double nearest = std::numeric_limits<double>::infinity();
    int triangle = -1;
    for (int t = 0; t < static_cast<int>(other.triangles().size()); ++t)
      if (const double d = (other.centroid(t) - x).squaredNorm(); d < nearest) nearest = d, triangle = t;
    if (triangle < 0) continue;
    const Vec3 n = other.area(triangle).normalized(), away = x - other.centroid(triangle);
    const double height = n.dot(away);
    const bool beside = (away - height * n).norm() > 0.5 * std::abs(height) + other.edge();
    if (!beside && (X.R * from.normal_at(static_cast<int>(v))).dot(n) < 0) out.push_back({height, x});
  }
  return out;
}

std::vector<Over> heights(const Subject& subject, const std::vector<Pose>& poses, int a, int b) {
  const Side &from = subject.sides[at(a)], &other = subject.sides[at(b)];
  if (!from.facets || !other.facets) return {};
  const auto pose = [&](int surface) { return poses[at(subject.scene.surfaces[at(surface)].body)]; };
  return heights(*from.facets, *other.facets, pose(b).inverse() * pose(a));
}

/// Mean distance (m) of a pair that lies back to back; else 0.
double back_to_back(std::vector<Over> all) {
  double deepest = 0;
  for (const Over& o : all) deepest = std::max(deepest, -o.height);
  const bool behind =
      std::all_of(all.begin(), all.end(), [&](const Over& o) { return o.height < kStillBehind * deepest; });
  if (!behind || all.size() < kFewestOver) return 0;
  Vec3 middle = Vec3::Zero();
  for (const Over& o : all) middle += o.p / static_cast<double>(all.size());
  std::sort(all.begin(), all.end(),
            [&](const Over& p, const Over& q) { return (p.p - middle).norm() < (q.p - middle).norm(); });
  double inner = 0, outer = 0, sum = 0;
  const std::size_t third = all.size() / 3;
  for (std::size_t i = 0; i < third; ++i) {
    inner -= all[i].height;
    outer -= all[all.size() - 1 - i].height;
  }
  for (const Over& o : all) sum -= o.height;
  return inner < kGapWidens * outer ? sum / static_cast<double>(all.size()) : 0;
}

}  // namespace

StartSides::StartSides(const Subject& subject) {
  const std::vector<Pose> poses = poses_at(subject.scene, reference_coordinates(subject.scene));
  const auto look = [&](const ContactDef& def) {
    const double apart = back_to_back(heights(subject, poses, def.surface_a, def.surface_b));
    if (apart > 0) pairs_.push_back({def.name, def.surface_a, def.surface_b, apart});
  };
  for (const ContactDef& contact : subject.scene.contacts) look(contact);
  for (const auto& layer : subject.scene.layers) look(layer.pair);
}

void StartSides::check(const PoseCase& pose) const {
  for (const BackToBack& pair : pairs_) {
    const std::vector<Over> now = heights(*pose.subject, pose.poses, pair.a, pair.b);
    const auto front = std::count_if(now.begin(), now.end(), [](const Over& o) { return o.height > 0; });
    const bool through = 2 * static_cast<std::size_t>(front) > now.size();
    pose.out->expect("no body passes through another", "mm", through ? to::kMillimetre * pair.apart : 0, 0, pair.name);
  }
}

}  // namespace genu::judge
