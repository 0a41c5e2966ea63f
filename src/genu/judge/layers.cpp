#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/judge/pose.h"
#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

/// A layer's resultant on the second surface's body, about its origin, in its axes.
struct Resultant {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  Vec3 centre = Vec3::Zero();  ///< mean of the places, weighted by load; during summation, times the load
  double area = 0, most = 0, load = 0, depth = 0;
  double points = 0, outside = 0;  ///< samples in contact, within the region and outside
  double side = 0;                 ///< m: longest side of the area that a sample in contact represents
  double lean = 0;                 ///< largest 1 - cosine of the angle between the normals of both surfaces
  Vec3 deepest = Vec3::Zero();     ///< place of the largest depth
  /// A triangle that carries load with its centre on the border of the region: by rounding on either side.
  struct OnBorder {
    Vec3 x, on_b;
    double pressure = 0, area = 0, depth = 0;
  };
  std::vector<OnBorder> on_border = {};

  void add(const OnBorder& t) { add(t.x, t.on_b, t.pressure, t.area, t.depth); }
  void add(const Vec3& x, const Vec3& on_b, double pressure, double area_of, double depth_there) {
    if (depth_there > depth) deepest = x;
    force += pressure * area_of * on_b;
    moment += x.cross(pressure * area_of * on_b);
    centre += pressure * area_of * x;
    load += pressure * area_of;
    area += area_of;
    most = std::max(most, pressure);
    depth = std::max(depth, depth_there);
    ++points;
  }
  /// Equivalent number of square samples as fine as the coarsest ones along their longer side.
  double fineness() const { return side > 0 ? std::min(points, area / (side * side)) : points; }
  Vec3 mean() const { return load > 0 ? Vec3(centre / load) : Vec3::Zero(); }
  /// Adds another one with weight `share`.
  void join(const Resultant& o, double share) {
    force += share * o.force;
    moment += share * o.moment;
    centre += share * o.centre;
    load += share * o.load;
    area += share * o.area;
    most = std::max(most, o.most);
    if (o.depth > depth) deepest = o.deepest;
    depth = std::max(depth, o.depth);
    points = points > 0 ? std::min(points, o.points) : o.points;
    side = std::max(side, o.side);
    outside += o.outside;
    lean = std::max(lean, o.lean);
  }
};

double pressure_of(const LayerDef& layer, double depth) {
  const double E = layer.modulus, nu = layer.poisson;
  const double M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  const double e = depth / layer.thickness;
  if (layer.law == LayerDef::Law::linear) return M * e;
  return e <= kTangentFrom ? -M * std::log(1 - e)
                           : -M * std::log(1 - kTangentFrom) + M * (e - kTangentFrom) / (1 - kTangentFrom);
}

class Layers {
 public:
  Layers(const PoseCase& pose, PoseForces& forces) : pose_(pose), scene_(pose.scene()), forces_(forces) {}

  void judge(const LayerDef& layer, bool sum) {
    layer_ = &layer;
    const std::string& name = layer.pair.name;
    const Resultant written = read(name);
    if (!written.force.allFinite() || !written.moment.allFinite()) {
      pose_.out->expect("layer forces", "N", std::nan(""), 0, name);
      return;
    }
    pose_.out->expect("layer sums fit together", "N", std::abs(pose_.row(name + ".force_N") - written.force.norm()),
                      1e-9 * (1 + written.force.norm()), name);
    add_force(written);
    if (layer.measured) return pose_.out->skip("pressure of " + name + ": its thickness is measured to a bone");
    if (layer.damping > 0) return pose_.out->skip("pressure of " + name + ": it is damped");
    if (!sum) return;
    casts_.clear();
    for (int region = -1; region < static_cast<int>(layer.pair.regions.size()); ++region) {
      region_ = region < 0 ? nullptr : &layer.pair.regions[at(region)];
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
    return scene_.surfaces[at(second ? layer_->pair.surface_b : layer_->pair.surface_a)].body;
  }

  void add_force(const Resultant& r) {
    const Pose& X = pose_.poses[at(body(true))];
    const Vec3 force = X.R * r.force, moment = X.R * r.moment;
    forces_.forces.push_back({body(true), X.p, force, moment});
    forces_.forces.push_back({body(false), X.p, -force, -moment});
  }

  /// The same for a triangle of this area: at the rim of a mesh its share over the mesh counts.
  Rim::Part part_of(const Side& other, const Vec3& x, const Vec3& n, double area, double most) const {
    const double depth = depth_of(other, x, n, most);
    const bool weighted =
        layer_->quadrature == LayerDef::Quadrature::triangles && layer_->rim == LayerDef::Rim::weighted;
    if (!weighted || !other.facets) return {depth > 0 ? 1.0 : 0.0, depth};
    const Rim::Part part = other.facets->rim().part({x, -n, std::sqrt(area / M_PI), most},
                                                    depth > 0 ? std::optional(depth) : std::nullopt);
    const bool carries =
        part.share > kLeastDiscShare && part.depth > 0 && (depth > 0 || !other.facets->enters(x, -n, part.depth));
    return carries ? part : Rim::Part();
  }

  /// Depth of overlap along the inward normal of a surface to the other; 0 without overlap.
  double depth_of(const Side& other, const Vec3& x, const Vec3& n, double most) const {
    if (other.facets) {
      const auto hit = other.facets->leaving(x, -n, most);
      return hit && other.facets->in_patch(x - hit->distance * n) ? hit->distance : 0;
    }
    const Shape& shape = *other.shape;
    if (shape.value(x) >= 0) return 0;
    // The first zero along the ray: by marching, then bisection.
    double low = 0, high = 0;
    for (const double step = most / 64; high < most && shape.value(x - high * n) < 0; high += step) low = high;
    if (shape.value(x - high * n) < 0) return 0;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (shape.value(x - middle * n) < 0 ? low : high) = middle;
    }
    return shape.in_patch(x - high * n) && high <= most ? high : 0;
  }

  /// The integral cast by one surface over the region, with `fine` times as many samples along an edge, moved `raised`
  /// (m) outward.
  const Resultant& cast(int from, int to, int fine, double raised = 0) const {
    const auto [found, fresh] = casts_.try_emplace({from, to, fine, raised});
    if (fresh) found->second = cast_all(from, to, fine, raised);
    const std::size_t region =
        region_ == nullptr ? 0 : 1 + static_cast<std::size_t>(region_ - layer_->pair.regions.data());
    return found->second[region];
  }

  /// The same over the whole layer, and over each region.
  std::vector<Resultant> cast_all(int from, int to, int fine, double raised) const {
    const SurfaceDef &a = scene_.surfaces[at(from)], &b = scene_.surfaces[at(to)];
    const Side &casting = pose_.subject->sides[at(from)], &other = pose_.subject->sides[at(to)];
    const Pose X_Wb = pose_.poses[at(body(true))];
    const Pose X_casting = casting.facets ? pose_.poses[at(a.body)] : pose_.poses[at(a.body)] * a.placement;
    const Pose X_other = other.facets ? pose_.poses[at(b.body)] : pose_.poses[at(b.body)] * b.placement;
    const Pose X_oc = X_other.inverse() * X_casting, X_bc = X_Wb.inverse() * X_casting;
    const bool second = from == layer_->pair.surface_b;
    const double most = layer_->search_depth > 0 ? layer_->search_depth : layer_->thickness;
    const bool exact =
        casting.facets && other.facets && layer_->quadrature == LayerDef::Quadrature::triangles && raised == 0;
    std::vector<Resultant> sums(1 + layer_->pair.regions.size());
    const auto add = [&](const Vec3& on_surface, const Vec3& n, double area, double side) {
      const Vec3 p = on_surface + raised * n;
      const auto [share, depth] = part_of(other, X_oc * p, X_oc.R * n, area, most);
      if (!(depth > 0)) return;
      const Vec3 x = X_bc * p, on_b = X_bc.R * (second ? Vec3(-n) : n);
      const double lean = other.facets ? 0 : 1 + (X_oc.R * n).dot(other.shape->normal(X_oc * (p - depth * n)));
      const Resultant::OnBorder sample{x, on_b, pressure_of(*layer_, depth), share * area, depth};
      for (std::size_t r = 0; r < sums.size(); ++r) {
        const RegionDef* region = r == 0 ? nullptr : &layer_->pair.regions[r - 1];
        sums[r].lean = std::max(sums[r].lean, lean);
        if (exact && region != nullptr && lies_on_border(*region, x))
          sums[r].on_border.push_back(sample);
        else if (region != nullptr && !region->contains(x))
          ++sums[r].outside;
        else
          sums[r].side = std::max(sums[r].side, side), sums[r].add(sample);
      }
    };
    if (casting.facets) {
      each_triangle(
          *casting.facets, fine,
          [&](const Vec3& middle, const Vec3& n, double radius) {
            // The ball round the rays, and round what counts of the border before them (rim.h).
            const double half = 0.5 * (most + kBorderDepth * radius);
            const Vec3 between = middle - (0.5 * (most - kBorderDepth * radius) - raised) * n;
            return other.facets && other.facets->beyond(X_oc * between, half + 2 * radius);
          },
          add);
    } else {
      each_sample(
          from, fine,
          [&](const Sample& s) {
            const Vec3 p = X_oc * s.p;
            const double reach = 2 * s.side + std::abs(raised);
            return other.facets ? other.facets->beyond(p, most + reach)
                                : other.shape->value(p) > other.shape->steepness(p) * reach;
          },
          add);
    }
    return sums;
  }

  bool lies_on_border(const RegionDef& region, const Vec3& x) const {
    return std::any_of(region.conditions.begin(), region.conditions.end(), [&](const auto& c) {
      return std::abs(x[c.axis] - c.value) <= kRegionBorder * pose_.subject->size;
    });
  }

  /// Those on the border are counted as the area that is written asks.
  static void count_on_border(double written_area, Resultant& sum) {
    for (const Resultant::OnBorder& t : sum.on_border)
      if (std::abs(sum.area + t.area - written_area) < std::abs(sum.area - written_area)) sum.add(t);
  }

  /// Leaves out triangles, all within `radius` (m) of their middle, where clear(middle, normal, radius).
  template <typename Clear, typename Add>
  static void each_triangle(const Facets& facets, int fine, Clear clear, Add add) {
    for (int t = 0; t < static_cast<int>(facets.triangles().size()); ++t) {
      const Vec3 area = facets.area(t);
      const double size = area.norm();
      if (!(size > 0) || !facets.in_patch(facets.centroid(t))) continue;
      const auto& c = facets.triangles()[at(t)];
      double radius = 0;
      for (const int v : c) radius = std::max(radius, (facets.vertices()[at(v)] - facets.centroid(t)).norm());
      if (clear(facets.centroid(t), area / size, radius)) continue;
      const Vec3 &o = facets.vertices()[at(c[0])], one = facets.vertices()[at(c[1])] - o,
                 two = facets.vertices()[at(c[2])] - o;
      for (int i = 0; i < fine; ++i)
        for (int j = 0; j < 2 * (fine - i) - 1; ++j) {
          const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
          const int column = j / 2;
          const Vec3 p = o + ((i + third) * one + (column + third) * two) / fine;
          add(p, area / size, size / (fine * fine), std::sqrt(2 * size) / fine);
        }
    }
  }

  /// Leaves out pieces, all within their side of their middle, where clear(piece).
  template <typename Clear, typename Add>
  void each_sample(int surface, int fine, Clear clear, Add add) const {
    const std::vector<Sample>& pieces = pose_.subject->pieces[at(surface)];
    const Shape& shape = *pose_.subject->sides[at(surface)].shape;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      if (clear(pieces[k])) continue;
      if (fine == 1 && shape.in_patch(pieces[k].p))
        add(pieces[k].p, pieces[k].n, pieces[k].area, pieces[k].side);
      else if (fine > 1)
        for (const Sample& s : shape.samples_of(pose_.subject->sampled, static_cast<int>(k), fine))
          add(s.p, s.n, s.area, s.side);
    }
  }

  bool sampleable(int surface) const {
    const Side& side = pose_.subject->sides[at(surface)];
    return side.facets || side.shape->bounded();
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
      Resultant first = cast(from, to, fineness);
      while (first.points < kEnoughSamples && first.points > 0 && fineness < kFinestSampling)
        first = cast(from, to, fineness *= 2);
      out.coarse.join(first, share);
      out.middle.join(cast(from, to, fineness + (fineness + 1) / 2), share);
      out.fine.join(fineness > 1 ? cast(from, to, 2 * fineness) : cast(from, to, 3), share);
    }
    return out;
  }

  Resultant raised(const Ways& ways, double by) const {
    Resultant out;
    for (const auto& [from, to] : ways) out.join(cast(from, to, 2, by), 1.0 / static_cast<double>(ways.size()));
    return out;
  }

  /// m, both together: largest distance of the smooth surfaces of meshes from their triangles where contact is deepest,
  /// or where it would begin; half of the bounds, as for overlap.
  double beside_facets(const Ways& ways, const Resultant& sum) const {
    double edge = 0, out = 0;
    for (const int surface : {layer_->pair.surface_a, layer_->pair.surface_b})
      if (const auto& facets = pose_.subject->sides[at(surface)].facets) edge = std::max(edge, facets->edge());
    const Resultant nearest = sum.points > 0 ? sum : raised(ways, kNearlyTouching * edge);
    if (!(nearest.points > 0)) return 0;
    const Vec3 x = pose_.poses[at(body(true))] * nearest.deepest;
    for (const int surface : {layer_->pair.surface_a, layer_->pair.surface_b}) {
      const auto& facets = pose_.subject->sides[at(surface)].facets;
      if (!facets) continue;
      const Vec3 there = pose_.poses[at(scene_.surfaces[at(surface)].body)].inverse() * x;
      out += 0.5 * facets->lean(there, kLeanReach * facets->edge()).distance;
    }
    return out;
  }

  /// The judge's own integrals with error bounds: by sampling, from twice as many samples; by using one surface for
  /// both; and by facets in place of a smooth surface.
  void compare(const Resultant& written, const std::string& name) {
    const int a = layer_->pair.surface_a, b = layer_->pair.surface_b;
    const bool triangles = layer_->quadrature == LayerDef::Quadrature::triangles;
    const bool mesh_a = pose_.subject->sides[at(a)].facets != nullptr,
               mesh_b = pose_.subject->sides[at(b)].facets != nullptr;
    const bool same = triangles && mesh_a && mesh_b;  // exactly the sum of the documentation
    Ways ways;
    Sums sum;
    double unilateral_stiffness = 0;
    if (triangles) {
      const int from = layer_->cast_from;
      if (!sampleable(from)) return pose_.out->skip("pressure of " + name + ": what casts has no ends");
      ways = {{from, from == a ? b : a}};
      sum.coarse = cast(from, ways[0].second, 1);
      count_on_border(written.area, sum.coarse);
      sum.middle = same ? sum.coarse : cast(from, ways[0].second, 2);
      sum.fine = same ? sum.coarse : cast(from, ways[0].second, 3);
    } else {
      if (sampleable(a)) ways.emplace_back(a, b);
      if (sampleable(b)) ways.emplace_back(b, a);
      if (ways.empty()) return pose_.out->skip("pressure of " + name + ": neither surface has ends");
      sum = sums(ways);
      if (ways.size() == 1) unilateral_stiffness = sum.fine.lean;
    }
    const Resultant& fine = sum.fine;
    const bool smooth_mesh = !same && (mesh_a || mesh_b);
    const double least = kMinLoadShare * pose_.subject->force_scale;
    const double asked = layer_->tolerance * std::max(1.0, least / std::max(fine.load, kMinLoadShare * least));
    const double share = same ? 1e-7 : (smooth_mesh || triangles ? kFacetLoadError : 1e-3) + asked;
    const double n = fine.fineness();
    // A region's border through the contact: a row of samples, the solver's or the judge's, may lie on either side.
    const double cut =
        n > 0 && fine.outside > 0 && !same ? 2 / std::sqrt(std::max(1.0, std::min(n, written.points))) : 0;
    const double sampled = same || !(n > 0) ? 0 : kBorderSamples / n + cut;
    const double border = same || !(n > 0) ? 0 : 2 / std::sqrt(n);  // half a row of samples around the border
    // Contact missed between few samples, as an increase in depth.
    const double missed = same ? 0 : kMissedDepth * layer_->thickness / (100 + n);
    const double beside = smooth_mesh ? beside_facets(ways, fine) : 0;
    const Resultant more = beside + missed > 0 ? raised(ways, beside + missed) : fine;
    const auto between = [&sum](auto what) {
      return sum.spread([&](const Resultant& one, const Resultant& other) { return what(one, other); });
    };
    const double off = between([](auto& p, auto& q) { return (p.force - q.force).norm(); }) +
                       (share + sampled + unilateral_stiffness) * fine.load + std::max(0.0, more.load - fine.load);
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
                            (relative + border) * fine.area + std::max(0.0, more.area - fine.area) + 1e-12;
    pose_.out->expect("layer areas", "mm^2", 1e6 * std::abs(written.area - fine.area), 1e6 * area_off, name);
    const double most_off = 2 * between([](auto& p, auto& q) { return std::abs(p.most - q.most); }) +
                            relative * fine.most + std::max(0.0, more.most - fine.most) + 1e-3;
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
    pose_.out->expect("largest depths", "MPa", 1e-6 * std::abs(pressure_of(*layer_, depth) - written.most),
                      1e-6 * (1e-9 * written.most + 1e-6 + (same ? 0 : most_off)), name);
    pose_.out->expect("largest strains", "1", std::abs(pose_.row(name + ".max_strain") - depth / layer_->thickness),
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
    expect_centre(name + "." + scene_.surfaces[at(layer_->pair.surface_b)].name, centre);
    expect_centre(name + "." + scene_.surfaces[at(layer_->pair.surface_a)].name, X_ab * centre);
  }

  const PoseCase& pose_;
  const Scene& scene_;
  PoseForces& forces_;
  const LayerDef* layer_ = nullptr;
  const RegionDef* region_ = nullptr;  ///< null: the whole layer
  /// Of this layer at this pose: by surfaces (from, to), fineness and distance moved; for the whole and each region.
  mutable std::map<std::tuple<int, int, int, double>, std::vector<Resultant>> casts_;
};

}  // namespace

void check_layers(const PoseCase& pose, bool sum, PoseForces& forces) {
  Layers layers(pose, forces);
  for (const LayerDef& layer : pose.scene().layers) layers.judge(layer, sum);
}

}  // namespace genu::judge
