#include "genu/judge/layer_casts.h"

#include <algorithm>
#include <cmath>

#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

/// Share of a square sample of this side about x, with normal n, that lies in the region.
double share_in(const RegionDef& region, const Vec3& x, const Vec3& n, double side) {
  using C = RegionDef::Comparison;
  Vec3 above = Vec3::Ones(), below = Vec3::Ones();  // shares beyond the conditions of each axis
  for (const auto& c : region.conditions) {
    const double width = side * std::sqrt(std::max(0.0, 1 - n[c.axis] * n[c.axis]));
    const bool upper = c.comparison == C::less || c.comparison == C::less_equal;
    const double inward = upper ? c.value - x[c.axis] : x[c.axis] - c.value;
    const double share = width > 0 ? std::clamp(0.5 + inward / width, 0.0, 1.0) : (inward >= 0 ? 1.0 : 0.0);
    double& least = upper ? below[c.axis] : above[c.axis];
    least = std::min(least, share);
  }
  return (above + below - Vec3::Ones()).cwiseMax(0).prod();
}

/// Leaves out triangles, all within `radius` (m) of their middle, where clear(middle, normal, radius).
template <typename Clear, typename Add>
void each_triangle(const Facets& facets, int fine, Clear clear, Add add) {
  for (int t = 0; t < static_cast<int>(facets.triangles().size()); ++t) {
    const Vec3& area = facets.area(t);
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
        add(t, p, size / (fine * fine), std::sqrt(2 * size) / fine);
      }
  }
}

}  // namespace

double pressure_of(const LayerDef& layer, double depth) {
  const double E = layer.modulus, nu = layer.poisson;
  const double M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  const double e = depth / layer.thickness;
  if (layer.law == LayerDef::Law::linear) return M * e;
  return e <= kTangentFrom ? -M * std::log(1 - e)
                           : -M * std::log(1 - kTangentFrom) + M * (e - kTangentFrom) / (1 - kTangentFrom);
}

bool LayerCasts::sampleable(int surface) const {
  const Side& side = pose_.subject->sides[at(surface)];
  return side.facets || side.shape->bounded();
}

/// What depth_of finds, for a triangle of this area: at the rim of a mesh its share over the mesh counts.
Rim::Part LayerCasts::part_of(const Side& other, const Vec3& x, const Vec3& n, double area, double most) const {
  const double depth = depth_of(other, x, n, most);
  const bool weighted = layer_.quadrature == LayerDef::Quadrature::triangles && layer_.rim == LayerDef::Rim::weighted;
  if (!weighted || !other.facets) return {depth > 0 ? 1.0 : 0.0, depth};
  const Rim::Part part =
      other.facets->rim().part({x, -n, std::sqrt(area / M_PI), most}, depth > 0 ? std::optional(depth) : std::nullopt);
  const bool carries =
      part.share > kLeastDiscShare && part.depth > 0 && (depth > 0 || !other.facets->enters(x, -n, part.depth));
  return carries ? part : Rim::Part();
}

/// The same where the other surface is of bent facets: the ray begins where it is inside of them for certain. In a part
/// of the body too thin for that it begins at x.
double LayerCasts::depth_under_bent(const Side& other, const Vec3& x, const Vec3& n, double most) {
  const double before = other.bent->most();
  double ahead = before, entered = 0;
  auto hit = other.facets->leaving(x + ahead * n, -n, most + ahead + before, &entered);
  if (!hit && entered < before) hit = other.facets->leaving(x, -n, most + before), ahead = 0;
  if (!hit) return 0;
  const Vec3 there = x + (ahead - hit->distance) * n;
  const BentFacets::Point point = other.bent->over(hit->triangle, there);
  const double steep = -n.dot(point.n);
  if (!(steep > kGrazingRay) || !other.facets->in_patch(there)) return 0;
  const double depth = hit->distance - ahead + point.off.dot(point.n) / steep;
  return depth <= most ? std::max(depth, 0.0) : 0;
}

/// m: depth of overlap along the inward normal of a surface to the other; 0 without overlap.
double LayerCasts::depth_of(const Side& other, const Vec3& x, const Vec3& n, double most) const {
  if (bent_of(other) != nullptr) return depth_under_bent(other, x, n, most);
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

bool LayerCasts::lies_on_border(const RegionDef& region, const Vec3& x) const {
  return std::any_of(region.conditions.begin(), region.conditions.end(), [&](const auto& c) {
    return std::abs(x[c.axis] - c.value) <= kRegionBorder * pose_.subject->size;
  });
}

/// Leaves out pieces, all within their side of their middle, where clear(piece).
template <typename Clear, typename Add>
void LayerCasts::each_sample(int surface, int fine, Clear clear, Add add) const {
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

const Resultant& LayerCasts::cast(const RegionDef* region, int from, int to, int fine, double raised) const {
  const auto [found, fresh] = casts_.try_emplace({from, to, fine, raised});
  if (fresh) found->second = cast_all(from, to, fine, raised);
  return found->second[region == nullptr ? 0 : 1 + static_cast<std::size_t>(region - layer_.pair.regions.data())];
}

/// The same over the whole layer, and over each region.
std::vector<Resultant> LayerCasts::cast_all(int from, int to, int fine, double raised) const {
  const SurfaceDef &a = pose_.scene().surfaces[at(from)], &b = pose_.scene().surfaces[at(to)];
  const Side &casting = pose_.subject->sides[at(from)], &other = pose_.subject->sides[at(to)];
  const Pose X_Wb = pose_.poses[at(pose_.scene().surfaces[at(layer_.pair.surface_b)].body)];
  const Pose X_casting = casting.facets ? pose_.poses[at(a.body)] : pose_.poses[at(a.body)] * a.placement;
  const Pose X_other = other.facets ? pose_.poses[at(b.body)] : pose_.poses[at(b.body)] * b.placement;
  const Pose X_oc = X_other.inverse() * X_casting, X_bc = X_Wb.inverse() * X_casting;
  const bool second = from == layer_.pair.surface_b;
  const double most = layer_.search_depth > 0 ? layer_.search_depth : layer_.thickness;
  const bool exact =
      casting.facets && other.facets && layer_.quadrature == LayerDef::Quadrature::triangles && raised == 0;
  std::vector<Resultant> sums(1 + layer_.pair.regions.size());
  const BentFacets *bent_casting = bent_of(casting), *bent_other = bent_of(other);
  const double bent =
      (bent_casting != nullptr ? bent_casting->most() : 0) + (bent_other != nullptr ? bent_other->most() : 0);
  const auto add = [&](const Vec3& on_surface, const Vec3& n, double area, double side) {
    const Vec3 p = on_surface + raised * n;
    const auto [share, depth] = part_of(other, X_oc * p, X_oc.R * n, area, most);
    if (!(depth > 0)) return;
    const Vec3 x = X_bc * p, on_b = X_bc.R * (second ? Vec3(-n) : n);
    const double lean = other.facets ? 0 : 1 + (X_oc.R * n).dot(other.shape->normal(X_oc * (p - depth * n)));
    const Resultant::OnBorder sample{x, on_b, pressure_of(layer_, depth), share * area, depth};
    const bool divided = layer_.quadrature == LayerDef::Quadrature::smooth;
    for (std::size_t r = 0; r < sums.size(); ++r) {
      const RegionDef* region = r == 0 ? nullptr : &layer_.pair.regions[r - 1];
      sums[r].lean = std::max(sums[r].lean, lean);
      if (exact && region != nullptr && lies_on_border(*region, x)) {
        sums[r].on_border.push_back(sample);
        continue;
      }
      const double within = region == nullptr ? 1
                            : divided         ? share_in(*region, x, on_b, side)
                                              : (region->contains(x) ? 1.0 : 0.0);
      if (within < 1) ++sums[r].outside;
      if (!(within > 0)) continue;
      sums[r].side = std::max(sums[r].side, side);
      sums[r].add({sample.x, sample.on_b, sample.pressure, within * sample.area, sample.depth});
    }
  };
  if (casting.facets) {
    each_triangle(
        *casting.facets, fine,
        [&](const Vec3& middle, const Vec3& n, double radius) {
          // The ball round the rays, and round what counts of the border before them (rim.h).
          const double half = 0.5 * (most + kBorderDepth * radius);
          const Vec3 between = middle - (0.5 * (most - kBorderDepth * radius) - raised) * n;
          return other.facets && other.facets->beyond(X_oc * between, half + 2 * radius + bent);
        },
        [&](int triangle, const Vec3& p, double area, double side) {
          if (bent_casting == nullptr) return add(p, casting.facets->area(triangle).normalized(), area, side);
          const BentFacets::Point over = bent_casting->over(triangle, p);
          add(p + over.off, over.n, area, side);
        });
  } else {
    each_sample(
        from, fine,
        [&](const Sample& s) {
          const Vec3 p = X_oc * s.p;
          const double reach = 2 * s.side + std::abs(raised);
          return other.facets ? other.facets->beyond(p, most + reach + bent)
                              : other.shape->value(p) > other.shape->steepness(p) * reach;
        },
        add);
  }
  return sums;
}

}  // namespace genu::judge
