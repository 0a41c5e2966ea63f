// Overlap by brute force: samples of one surface against the other's own formula or triangles, both ways, then descent
// from the lowest samples over the sampled surface.
#include <algorithm>
#include <cmath>

#include "genu/core/units.h"
#include "genu/judge/pose.h"
#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

/// m, of a point of one surface over the other; not known where that has no inside or outside.
struct Gap {
  double gap = std::numeric_limits<double>::infinity();
  double sure = 0;  ///< m: uncertainty by facets: half of both error bounds, which are rarely reached together
  Vec3 p = Vec3::Zero();
  double spacing = 0;   ///< m: of the samples
  bool at_rim = false;  ///< of closed forms: nearest at an end of one, where the normals need not be opposite
};

class Gaps {
 public:
  explicit Gaps(const PoseCase& pose) : pose_(pose), scene_(pose.scene()) {}

  void judge(const std::string& name, int surface_a, int surface_b) {
    bool any = false;
    const double written = units::kMillimetre * pose_.row(name + ".gap_mm");
    pose_.out->expect("no overlap is written", "mm",
                      std::isfinite(written) ? to::kMillimetre * std::max(0.0, -written) : 0,
                      to::kMillimetre * (pose_.length_tolerance() + kWrittenGap), name);
    for (const bool back : {false, true}) {
      const int from = back ? surface_b : surface_a, to = back ? surface_a : surface_b;
      const Side &sampled = pose_.subject->sides[at(from)], &other = pose_.subject->sides[at(to)];
      if (sampled.shape && !sampled.shape->bounded()) continue;
      any = true;
      const Pose X = in_other(from, to);
      const Gap least = lowest(sampled, other, X);
      if (!std::isfinite(least.gap)) continue;
      pose_.out->expect("no overlap anywhere", "mm", to::kMillimetre * std::max(0.0, -least.gap),
                        to::kMillimetre * (pose_.length_tolerance() + 1e-9 + least.sure),
                        name + ", " + scene_.surfaces[at(from)].name + " in " + scene_.surfaces[at(to)].name);
      if (std::isfinite(written) && sampled.shape && other.shape) {
        // The surface is at most one spacing deeper than the lowest sample.
        if (!least.at_rim && !scene_.surfaces[at(from)].patch && !scene_.surfaces[at(to)].patch)
          pose_.out->expect("smallest gap is not too small", "mm",
                            to::kMillimetre * std::max(0.0, least.gap - least.spacing - written),
                            to::kMillimetre * (pose_.length_tolerance() + 1e-8), name);
        pose_.out->expect(
            "smallest gap is the smallest", "mm", to::kMillimetre * std::max(0.0, written - least.gap),
            to::kMillimetre * (pose_.length_tolerance() + (least.at_rim ? kRimPassed * pose_.subject->size : 1e-8)),
            name);
      }
    }
    if (!any) pose_.out->skip("overlap of " + name + ": neither surface has ends");
  }

 private:
  /// From the frame of the first surface's samples to the frame of the second surface.
  Pose in_other(int from, int to) const {
    const SurfaceDef &a = scene_.surfaces[at(from)], &b = scene_.surfaces[at(to)];
    const bool mesh_a = a.shape == SurfaceDef::Shape::mesh, mesh_b = b.shape == SurfaceDef::Shape::mesh;
    const Pose X_Wa = mesh_a ? pose_.poses[at(a.body)] : pose_.poses[at(a.body)] * a.placement;
    const Pose X_Wb = mesh_b ? pose_.poses[at(b.body)] : pose_.poses[at(b.body)] * b.placement;
    return X_Wb.inverse() * X_Wa;
  }

  /// First-order distance of x from a closed form.
  static double about(const Shape& shape, const Vec3& x) { return shape.value(x) / shape.gradient(x).norm(); }

  Gap over(const Side& other, const Vec3& x) const {
    Gap out;
    if (other.shape) {
      out.gap = about(*other.shape, x);
      return out;
    }
    if (other.facets->clear_of(x)) return out;
    const auto near = other.facets->nearest(x, kOverlapReach * other.facets->edge());
    if (!near || near->at_border || !other.facets->in_patch(near->p)) return out;
    out.gap = near->distance;
    return out;
  }

  /// A closer look at a low sample: the nearest point must be on the patch.
  Gap closely(const Side& other, const Vec3& x) const {
    Gap gap = over(other, x);
    gap.p = x;
    if (!std::isfinite(gap.gap)) return gap;
    if (other.shape) {
      const auto foot = other.shape->nearest(x);
      if (!foot || !other.shape->in_patch(*foot)) return {};
      gap.gap = (other.shape->value(x) < 0 ? -1 : 1) * (x - *foot).norm();
    } else {
      gap.sure = 0.5 * other.facets->lean(x, kLeanReach * other.facets->edge()).distance;
    }
    return gap;
  }

  /// Whether a closed form ends close to its point p.
  bool ends_beside(const Shape& shape, const Vec3& p) const {
    const Vec3 n = shape.normal(p), one = n.unitOrthogonal(), two = n.cross(one);
    for (int k = 0; k < 8; ++k) {
      const double angle = k * M_PI / 4;
      const auto q =
          shape.onto(p + kBesideShare * pose_.subject->size * (std::cos(angle) * one + std::sin(angle) * two));
      if (!q || !shape.in_patch(*q)) return true;
    }
    return false;
  }

  /// Whether the normals are not opposite at p, or one of the two surfaces ends close to it.
  bool at_rim(const Shape& sampled, const Shape& other, const Pose& X, const Vec3& p) const {
    if (1 + (X.R * sampled.normal(p)).dot(other.normal(X * p)) > kOpposedRounding || ends_beside(sampled, p))
      return true;
    const auto foot = other.nearest(X * p);
    return !foot || ends_beside(other, *foot);
  }

  /// Descent over the sampled closed form, with halved steps.
  Gap descend(const Shape& sampled, const Side& other, const Pose& X, Vec3 p, double step) const {
    double best = over(other, X * p).gap;
    while (step > 1e-8) {
      const Vec3 n = sampled.normal(p), one = n.unitOrthogonal(), two = n.cross(one);
      Vec3 better = p;
      for (int k = 0; k < 8; ++k) {
        const double angle = k * M_PI / 4;
        const auto q = sampled.onto(p + step * (std::cos(angle) * one + std::sin(angle) * two));
        if (!q || !sampled.in_patch(*q)) continue;
        if (const double gap = over(other, X * *q).gap; gap < best) best = gap, better = *q;
      }
      if (better == p) step /= 2;
      p = better;
    }
    Gap found = closely(other, X * p);
    if (other.shape) found.at_rim = at_rim(sampled, *other.shape, X, p);
    return found;
  }

  Gap lowest(const Side& sampled, const Side& other, const Pose& X) const {
    std::vector<std::pair<double, Vec3>> low;
    double spacing = 0;
    const auto consider = [&](const Vec3& p) {
      const double gap = over(other, X * p).gap;
      if (std::isfinite(gap)) low.emplace_back(gap, p);
    };
    if (sampled.shape) {
      for (const Sample& s : pose_.subject->samples[at(sampled.index)]) {
        consider(s.p);
        spacing = std::max(spacing, std::sqrt(s.area));
      }
    } else {
      for (const Vec3& v : sampled.facets->vertices())
        if (sampled.facets->in_patch(v)) consider(v);
      spacing = sampled.facets->edge();
    }
    std::sort(low.begin(), low.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    Gap least;
    std::vector<Vec3> taken;
    double worst = -std::numeric_limits<double>::infinity();
    for (const auto& [gap, p] : low) {
      const bool lowest = taken.empty() && sampled.shape && other.shape;  // always followed, for the gap
      if (taken.size() >= kDescents || (gap > 2 * spacing && !lowest)) break;
      const auto beside = [&, at_p = p](const Vec3& q) { return (q - at_p).norm() < 4 * spacing; };
      if (sampled.shape && std::any_of(taken.begin(), taken.end(), beside)) continue;
      const Gap found = sampled.shape ? descend(*sampled.shape, other, X, p, spacing) : closely(other, X * p);
      if (!std::isfinite(found.gap)) continue;
      taken.push_back(p);
      const double own = sampled.shape ? 0 : 0.5 * sampled.facets->lean(p, kLeanReach * spacing).distance;
      // The one with the largest excess over its facets' uncertainty.
      if (const double beyond = -found.gap - found.sure - own; beyond > worst) {
        worst = beyond;
        least = found;
        least.sure += own;
      }
    }
    least.spacing = spacing;
    return least;
  }

  const PoseCase& pose_;
  const Scene& scene_;
};

}  // namespace

void check_gaps(const PoseCase& pose) {
  Gaps gaps(pose);
  for (const ContactDef& pair : pose.scene().contacts) gaps.judge(pair.name, pair.surface_a, pair.surface_b);
}

}  // namespace genu::judge
