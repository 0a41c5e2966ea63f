#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/judge/layer_casts.h"
#include "genu/judge/pose.h"
#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

class JudgedLayer {
 public:
  JudgedLayer(const PoseCase& pose, const LayerDef& layer, PoseForces& forces)
      : pose_(pose), scene_(pose.scene()), layer_(layer), forces_(forces), casts_(pose, layer) {}

  void judge(bool sum) {
    const std::string& name = layer_.pair.name;
    const Resultant written = read(name);
    if (!written.force.allFinite() || !written.moment.allFinite()) {
      pose_.out->expect("layer forces", "N", std::nan(""), 0, name);
      return;
    }
    pose_.out->expect("layer sums fit together", "N", std::abs(pose_.row(name + ".force_N") - written.force.norm()),
                      1e-9 * (1 + written.force.norm()), name);
    add_force(written);
    if (layer_.measured) return pose_.out->skip("pressure of " + name + ": its thickness is measured to a bone");
    if (layer_.damping > 0) return pose_.out->skip("pressure of " + name + ": it is damped");
    if (!sum) return;
    for (int region = -1; region < static_cast<int>(layer_.pair.regions.size()); ++region) {
      region_ = region < 0 ? nullptr : &layer_.pair.regions[at(region)];
      compare(region_ == nullptr ? written : read(name + "." + region_->name),
              region_ == nullptr ? name : name + "." + region_->name);
    }
  }

 private:
  Resultant read(const std::string& name) const {
    Resultant r;
    for (Eigen::Index i = 0; i < 3; ++i) {
      r.force[i] = pose_.row(fmt::format("{}.force_{}_N", name, "xyz"[i]));
      r.moment[i] = pose_.row(fmt::format("{}.moment_{}_Nm", name, "xyz"[i]));
    }
    r.area = 1e-6 * pose_.row(name + ".area_mm2");
    r.most = 1e6 * pose_.row(name + ".max_pressure_MPa");
    r.points = pose_.row(name + ".points");
    return r;
  }

  int body(bool second) const {
    return scene_.surfaces[at(second ? layer_.pair.surface_b : layer_.pair.surface_a)].body;
  }

  void add_force(const Resultant& r) {
    const Pose& X = pose_.poses[at(body(true))];
    const Vec3 force = X.R * r.force, moment = X.R * r.moment;
    forces_.forces.push_back({body(true), X.p, force, moment});
    forces_.forces.push_back({body(false), X.p, -force, -moment});
  }

  /// Those on the border are counted as the area that is written asks.
  static void count_on_border(double written_area, Resultant& sum) {
    for (const Resultant::OnBorder& t : sum.on_border)
      if (std::abs(sum.area + t.area - written_area) < std::abs(sum.area - written_area)) sum.add(t);
  }

  using Ways = std::vector<std::pair<int, int>>;  // surfaces: from, to

  struct Sums {
    Resultant coarse, middle, fine;
    /// Difference between two integrals: the error by samples at the border of contact.
    template <typename Difference>
    double spread(Difference difference) const {
      return std::max({difference(coarse, middle), difference(middle, fine), difference(coarse, fine)});
    }
  };

  /// Sums of what `ways` cast, in equal shares: as finely as it takes for kEnoughSamples in contact, and up to twice
  /// as finely.
  Sums sums(const Ways& ways) const {
    Sums out;
    for (const auto& [from, to] : ways) {
      const double share = 1.0 / static_cast<double>(ways.size());
      int fineness = 1;
      Resultant first = casts_.cast(region_, from, to, fineness);
      while (first.points < kEnoughSamples && first.points > 0 && fineness < kFinestSampling)
        first = casts_.cast(region_, from, to, fineness *= 2);
      out.coarse.join(first, share);
      out.middle.join(casts_.cast(region_, from, to, fineness + (fineness + 1) / 2), share);
      out.fine.join(fineness > 1 ? casts_.cast(region_, from, to, 2 * fineness) : casts_.cast(region_, from, to, 3),
                    share);
    }
    return out;
  }

  /// By that or up to 1.4 times as much, so that a layer and its regions share sums.
  Resultant raised(const Ways& ways, double by) const {
    if (by > 0) by = std::exp2(0.5 * std::ceil(2 * std::log2(by)));
    Resultant out;
    for (const auto& [from, to] : ways) {
      const Resultant& some = casts_.cast(region_, from, to, 1, by);
      const bool enough = some.points >= kRaisedSamples || some.points == 0;
      out.join(enough ? some : casts_.cast(region_, from, to, 2, by), 1.0 / static_cast<double>(ways.size()));
    }
    return out;
  }

  /// m, both together: how far the smooth surfaces of meshes may be from the judge's where contact is deepest, or where
  /// it would begin; of facets that are not bent half of the bounds, as for overlap.
  double beside_facets(const Ways& ways, const Resultant& sum) const {
    double edge = 0, out = 0;
    for (const int surface : {layer_.pair.surface_a, layer_.pair.surface_b})
      if (const auto& facets = pose_.subject->sides[at(surface)].facets) edge = std::max(edge, facets->edge());
    const Resultant nearest = sum.points > 0 ? sum : raised(ways, kNearlyTouching * edge);
    if (!(nearest.points > 0)) return 0;
    const Vec3 x = pose_.poses[at(body(true))] * nearest.deepest;
    for (const int surface : {layer_.pair.surface_a, layer_.pair.surface_b}) {
      const auto& facets = pose_.subject->sides[at(surface)].facets;
      if (!facets) continue;
      const Vec3 there = pose_.poses[at(scene_.surfaces[at(surface)].body)].inverse() * x;
      const auto& bent = pose_.subject->sides[at(surface)].bent;
      out += bent && layer_.quadrature == LayerDef::Quadrature::smooth
                 ? bent->doubt(there, kLeanReach * facets->edge())
                 : 0.5 * facets->lean(there, kLeanReach * facets->edge()).distance;
    }
    return out;
  }

  struct Row {
    double load = 0, area = 0, most = 0;  ///< N, m^2, Pa
  };
  /// What may be on the wrong side where the border of a region passes through the contact or beside it: a row of
  /// samples across the whole contact, the solver's or the judge's. Where samples are divided there, it is a quarter of
  /// the row (the solver divides by squares as wide as its nodes), what changes across it, and samples at both of its
  /// ends; but the largest pressure changes as across a row.
  Row row_at_border(const Ways& ways, const Resultant& region) const {
    if (region_ == nullptr || (region.points > 0 && !(region.outside > 0))) return {};
    Resultant whole;
    for (const auto& [from, to] : ways)
      whole.join(casts_.cast(nullptr, from, to, 2), 1.0 / static_cast<double>(ways.size()));
    const bool near = region.points > 0 || raised(ways, kNearlyTouching * whole.side).points > 0;
    if (!near || !(whole.points > 0)) return {};
    const double samples = std::min(whole.fineness(), pose_.row(layer_.pair.name + ".points"));
    const double share = 2 / std::sqrt(std::max(1.0, samples));
    const bool divided = layer_.quadrature == LayerDef::Quadrature::smooth;
    const double of_load = divided ? share / 4 + share * share / 2 : share,
                 of_area = divided ? share / 2 + share * share : share;
    return {of_load * whole.load, of_area * whole.area, share * whole.most};
  }

  /// The judge's own integrals with error bounds: by sampling, from twice as many samples; by using one surface for
  /// both; and by facets in place of a smooth surface.
  void compare(const Resultant& written, const std::string& name) {
    const int a = layer_.pair.surface_a, b = layer_.pair.surface_b;
    const bool triangles = layer_.quadrature == LayerDef::Quadrature::triangles;
    const bool mesh_a = pose_.subject->sides[at(a)].facets != nullptr,
               mesh_b = pose_.subject->sides[at(b)].facets != nullptr;
    const bool same = triangles && mesh_a && mesh_b;  // exactly the sum of the documentation
    Ways ways;
    Sums sum;
    double unilateral_stiffness = 0;
    if (triangles) {
      const int from = layer_.cast_from;
      if (!casts_.sampleable(from)) return pose_.out->skip("pressure of " + name + ": what casts has no ends");
      ways = {{from, from == a ? b : a}};
      sum.coarse = casts_.cast(region_, from, ways[0].second, 1);
      count_on_border(written.area, sum.coarse);
      sum.middle = same ? sum.coarse : casts_.cast(region_, from, ways[0].second, 2);
      sum.fine = same ? sum.coarse : casts_.cast(region_, from, ways[0].second, 3);
    } else {
      if (casts_.sampleable(a)) ways.emplace_back(a, b);
      if (casts_.sampleable(b)) ways.emplace_back(b, a);
      if (ways.empty()) return pose_.out->skip("pressure of " + name + ": neither surface has ends");
      sum = sums(ways);
      if (ways.size() == 1) unilateral_stiffness = sum.fine.lean;
    }
    const Resultant& fine = sum.fine;
    const bool smooth_mesh = !same && (mesh_a || mesh_b);
    const double least = kMinLoadShare * pose_.subject->force_scale;
    const double asked = layer_.tolerance * std::max(1.0, least / std::max(fine.load, kMinLoadShare * least));
    const double share = same ? 1e-7 : (smooth_mesh || triangles ? kFacetLoadError : 1e-3) + asked;
    const double n = fine.fineness();
    const Row row = same ? Row() : row_at_border(ways, fine);
    const double sampled = same || !(n > 0) ? 0 : kBorderSamples / n;
    const double border = same || !(n > 0) ? 0 : 2 / std::sqrt(n);  // half a row of samples around the border
    // Contact missed between few samples, as an increase in depth.
    const double missed = same ? 0 : kMissedDepth * layer_.thickness / (100 + n);
    const double beside = smooth_mesh ? beside_facets(ways, fine) : 0;
    const Resultant more = beside + missed > 0 ? raised(ways, beside + missed) : fine;
    const auto between = [&sum](auto what) {
      return sum.spread([&](const Resultant& one, const Resultant& other) { return what(one, other); });
    };
    const double off = between([](auto& p, auto& q) { return (p.force - q.force).norm(); }) +
                       (share + sampled + unilateral_stiffness) * fine.load + row.load +
                       std::max(0.0, more.load - fine.load);
    if (const double most = std::max(fine.load, written.force.norm()); most > least && off > kSaysLittle * most)
      pose_.out->skip("pressure of " + name + ", but for gross errors: too few samples and triangles for its contact");
    const double size = pose_.subject->size;
    pose_.out->expect("layer forces", "N", (written.force - fine.force).norm(), off + 1e-9, name);
    const Vec3 centre = fine.load > 0 ? Vec3(fine.force.cross(fine.moment) / fine.force.squaredNorm()) : Vec3::Zero();
    const Vec3 moved = (written.moment - centre.cross(written.force)) - (fine.moment - centre.cross(fine.force));
    pose_.out->expect("layer moments", "N m", moved.norm(),
                      off * size + between([&](auto& p, auto& q) {
                        return (p.moment - q.moment - centre.cross(p.force - q.force)).norm();
                      }) + 1e-9,
                      name);
    const double relative = same ? 1e-7 : 3 * (share + sampled + unilateral_stiffness);
    const double area_off = 2 * between([](auto& p, auto& q) { return std::abs(p.area - q.area); }) +
                            (relative + border) * fine.area + row.area + std::max(0.0, more.area - fine.area) + 1e-12;
    pose_.out->expect("layer areas", "mm^2", 1e6 * std::abs(written.area - fine.area), 1e6 * area_off, name);
    const double most_off = 2 * between([](auto& p, auto& q) { return std::abs(p.most - q.most); }) +
                            relative * fine.most + row.most + std::max(0.0, more.most - fine.most) + 1e-3;
    const double own_side = !triangles && ways.size() == 1 ? 0.25 * fine.depth : 0;  // the other half lies deeper
    const double moved_centre = own_side + between([](auto& p, auto& q) { return (p.mean() - q.mean()).norm(); });
    judge_rest(name, written, fine, same, off, most_off, moved_centre);
    pose_.out->expect("largest pressures", "MPa", 1e-6 * std::abs(written.most - fine.most), 1e-6 * most_off, name);
  }

  /// Columns that follow from others, and those that only an identical sum has.
  void judge_rest(const std::string& name, const Resultant& written, const Resultant& own, bool same, double off,
                  double most_off, double centre_off) {
    pose_.out->expect("layer sums fit together", "N", std::abs(pose_.row(name + ".force_N") - written.force.norm()),
                      1e-9 * (1 + written.force.norm()), name);
    // The largest pressure is that of the largest depth.
    const double depth = units::kMillimetre * pose_.row(name + ".max_depth_mm");
    pose_.out->expect("largest depths", "MPa", 1e-6 * std::abs(pressure_of(layer_, depth) - written.most),
                      1e-6 * (1e-9 * written.most + 1e-6 + (same ? 0 : most_off)), name);
    pose_.out->expect("largest strains", "1", std::abs(pose_.row(name + ".max_strain") - depth / layer_.thickness),
                      1e-9, name);
    if (!(own.load > 0) || !(written.area > 0)) return;
    const double mean = 1e6 * pose_.row(name + ".mean_pressure_MPa");
    pose_.out->expect("mean pressures", "MPa", 1e-6 * std::abs(mean - own.load / written.area),
                      1e-6 * (off / written.area + 1e-9 * mean), name);
    if (same)
      pose_.out->expect("triangles that carry", "1", std::abs(pose_.row(name + ".points") - own.points), 0, name);
    const double moved = off / own.load * pose_.subject->size + 2 * centre_off + 1e-9;
    const auto expect_centre = [&](const std::string& column, const Vec3& x) {
      Vec3 there;
      for (Eigen::Index i = 0; i < 3; ++i)
        there[i] = units::kMillimetre * pose_.row(fmt::format("{}.{}_mm", column, "xyz"[i]));
      pose_.out->expect("centres of pressure", "mm", to::kMillimetre * (there - x).norm(),
                        to::kMillimetre * (moved + 1e-12 * x.norm()), column);
    };
    const Vec3 centre = own.mean();
    if (region_ != nullptr) return expect_centre(name, centre);
    const Pose X_ab = pose_.poses[at(body(false))].inverse() * pose_.poses[at(body(true))];
    expect_centre(name + "." + scene_.surfaces[at(layer_.pair.surface_b)].name, centre);
    expect_centre(name + "." + scene_.surfaces[at(layer_.pair.surface_a)].name, X_ab * centre);
  }

  const PoseCase& pose_;
  const Scene& scene_;
  const LayerDef& layer_;
  PoseForces& forces_;
  const RegionDef* region_ = nullptr;  ///< null: the whole layer
  LayerCasts casts_;
};

}  // namespace

void check_layers(const PoseCase& pose, bool sum, PoseForces& forces) {
  for (const LayerDef& layer : pose.scene().layers) JudgedLayer(pose, layer, forces).judge(sum);
}

}  // namespace genu::judge
