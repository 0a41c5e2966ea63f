#include "genu/atlas/registration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "genu/atlas/tolerances.h"

namespace genu {
namespace {

enum class Kind { rigid, similarity, affine };

double median_of(std::vector<double> x) {
  if (x.empty()) return 0;
  const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
  std::nth_element(x.begin(), middle, x.end());
  return *middle;
}

/// Partners of mapped points, what they are asked to go to, and how much each counts.
struct Partners {
  std::vector<Vec3> foot;      ///< m: in the partner's tangent plane
  std::vector<Vec3> normal;    ///< of the partner
  std::vector<Vec3> at;        ///< m: the partner
  std::vector<double> misfit;  ///< m
  std::vector<double> weight;  ///< 0: without a partner
};

/// How far to the side a partner may be: less and less as a map gets better.
struct Reach {
  double first, last;  ///< m
  double at(int i, int times) const { return first + (last - first) * i / std::max(times - 1, 1); }
};

Partners partners_of(std::span<const Vec3> mapped, std::span<const Vec3> normals, const PointTree& target,
                     double reach) {
  Partners out;
  std::vector<double> with_partner;
  for (std::size_t i = 0; i < mapped.size(); ++i) {
    const FacingPoint& q = target.points()[at(target.nearest({mapped[i], normals[i]}))];
    const Vec3 gap = q.at - mapped[i];
    const double off = gap.dot(q.normal);
    out.at.push_back(q.at);
    out.normal.push_back(q.normal);
    out.foot.push_back(mapped[i] + off * q.normal);
    // Beside its partner as far as neighbours of a mesh are, a point is on the surface; further off it is past its end.
    const double aside = (gap - off * q.normal).norm(), turned = (normals[i] - q.normal).norm();
    out.misfit.push_back(std::hypot(off, std::max(0.0, aside - kMatched), std::max(0.0, turned - 1) * kTurnLength));
    out.weight.push_back(aside <= reach ? 1 : 0);
    if (aside <= reach) with_partner.push_back(out.misfit.back());
  }
  const double usual = std::max(kUsualMisfit * median_of(with_partner), kLeastMisfit);
  for (std::size_t i = 0; i < out.weight.size(); ++i)
    if (const double d = out.misfit[i]; d >= usual) out.weight[i] *= usual * usual / (d * d);
  return out;
}

/// The map of its kind with the least weighted sum of squared distances from `to`.
Affine fitted(std::span<const Vec3> from, std::span<const Vec3> to, std::span<const double> weight, Kind kind,
              bool reflects) {
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
  double sum = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    a += weight[i] * from[i];
    b += weight[i] * to[i];
    sum += weight[i];
  }
  a /= sum;
  b /= sum;
  Mat3 across = Mat3::Zero(), own = Mat3::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec3 x = from[i] - a;
    across += weight[i] * (to[i] - b) * x.transpose();
    own += weight[i] * x * x.transpose();
  }
  Affine map;
  if (kind == Kind::affine) {
    map.linear = own.ldlt().solve(across.transpose()).transpose();
  } else {
    const Eigen::JacobiSVD<Mat3> svd(across, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const bool turns = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0;
    const Vec3 signs(1, 1, turns == reflects ? 1 : -1);
    map.linear = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
    if (kind == Kind::similarity) map.linear *= svd.singularValues().dot(signs) / own.trace();
  }
  map.shift = b - map.linear * a;
  return map;
}

class Fit {
 public:
  Fit(std::span<const FacingPoint> points, const PointTree& target) : points_(points), target_(target) {
    for (const FacingPoint& p : points) at_.push_back(p.at);
  }

  /// Iterations of one kind of map; the partners that the last one found.
  Partners iterate(Affine& map, Kind kind, int times, const Reach& reach) const {
    const bool reflects = map.linear.determinant() < 0;
    Partners found = partners(map, reach.first);
    for (int i = 0; i < times; ++i) {
      if (std::count_if(found.weight.begin(), found.weight.end(), [](double w) { return w > 0; }) < kFewPartners) break;
      // Half to the partner, half to its plane: along a surface slowly, but never astray.
      std::vector<Vec3> to;
      for (std::size_t k = 0; k < points_.size(); ++k) to.emplace_back((found.foot[k] + found.at[k]) / 2);
      map = fitted(at_, to, found.weight, kind, reflects);
      found = partners(map, reach.at(i, times));
    }
    return found;
  }

  Partners partners(const Affine& map, double reach) const {
    std::vector<Vec3> mapped, normals;
    place(map, mapped, normals);
    return partners_of(mapped, normals, target_, reach);
  }

  void place(const Affine& map, std::vector<Vec3>& mapped, std::vector<Vec3>& normals) const {
    const Mat3 turn = map.linear.inverse().transpose();
    for (const FacingPoint& p : points_) {
      mapped.push_back(map(p.at));
      normals.push_back((turn * p.normal).normalized());
    }
  }

 private:
  std::span<const FacingPoint> points_;
  std::vector<Vec3> at_;
  const PointTree& target_;
};

/// g(|x - c|).
double bell(const Vec3& x, const Vec3& c, double reach) {
  return std::exp(-(x - c).squaredNorm() / (2 * reach * reach));
}

/// Every so many of the points, so that about `count` stay.
std::vector<Vec3> some_of(std::span<const Vec3> points, std::size_t count) {
  std::vector<Vec3> out;
  count = std::min(count, points.size());
  for (std::size_t k = 0; k < count; ++k) out.push_back(points[k * points.size() / count]);
  return out;
}

MatX bells(std::span<const Vec3> at, std::span<const Vec3> places, double reach) {
  MatX g(at.size(), places.size());
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t k = 0; k < places.size(); ++k)
      g(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = bell(at[i], places[k], reach);
  return g;
}

/// The smooth field on top of the affine map: `found` are the partners where it ends.
void bend(Registration& out, std::span<const Vec3> start, const PointTree& target) {
  BoneMap& map = out.map;
  map.reach = kFieldReach;
  map.places = some_of(start, kFieldPlaces);
  const MatX g = bells(start, map.places, map.reach),
             stiff = kFieldSmoothness * bells(map.places, map.places, map.reach);
  const auto n = static_cast<Eigen::Index>(start.size());
  MatX w = MatX::Zero(static_cast<Eigen::Index>(map.places.size()), 3);
  for (int i = 0; i < kMapIterations / 2; ++i) {
    const Partners found = partners_of(out.mapped, out.normals, target, kPartnerAside);
    MatX to(n, 3);
    VecX weight(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      to.row(k) = (found.foot[static_cast<std::size_t>(k)] - start[static_cast<std::size_t>(k)]).transpose();
      weight[k] = found.weight[static_cast<std::size_t>(k)];
    }
    const MatX weighted = weight.asDiagonal() * g;
    // Places nearer to one another than their reach make it singular but for what is added.
    MatX normal = g.transpose() * weighted + stiff;
    normal.diagonal().array() += 1e-9 * normal.diagonal().maxCoeff();
    w = normal.ldlt().solve(weighted.transpose() * to);
    const MatX moved = g * w;
    for (Eigen::Index k = 0; k < n; ++k)
      out.mapped[static_cast<std::size_t>(k)] = start[static_cast<std::size_t>(k)] + moved.row(k).transpose();
  }
  for (Eigen::Index k = 0; k < w.rows(); ++k) map.weights.emplace_back(w.row(k).transpose());
}

}  // namespace

Vec3 BoneMap::operator()(const Vec3& p) const {
  const Vec3 a = affine(p);
  Vec3 y = a;
  for (std::size_t k = 0; k < places.size(); ++k) y += bell(a, places[k], reach) * weights[k];
  return y;
}

double explained(const Registration& found, const PointTree& target) {
  std::vector<FacingPoint> mapped;
  for (std::size_t i = 0; i < found.mapped.size(); ++i) mapped.push_back({found.mapped[i], found.normals[i]});
  const PointTree tree(std::move(mapped));
  const std::vector<FacingPoint>& points = target.points();
  const std::size_t count = std::min(kAskedTargets, points.size());
  if (tree.points().empty() || count == 0) return 0;
  std::size_t near = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const FacingPoint& p = points[k * points.size() / count];
    if ((tree.points()[at(tree.nearest(p))].at - p.at).norm() <= kPartnerAside) ++near;
  }
  return static_cast<double>(near) / static_cast<double>(count);
}

Affine similarity(std::span<const Vec3> from, std::span<const Vec3> to, bool reflects) {
  return fitted(from, to, std::vector<double>(from.size(), 1), Kind::similarity, reflects);
}

Registration register_points(std::span<const FacingPoint> points, const PointTree& target,
                             std::span<const Affine> starts) {
  Registration out;
  if (points.empty() || target.points().empty() || starts.empty()) return out;
  const Fit fit(points, target);
  double least = std::numeric_limits<double>::infinity();
  for (Affine start : starts) {
    const Partners found = fit.iterate(start, Kind::similarity, kStartIterations, {kStartAside, kStartAside / 2});
    const double misfit = median_of(found.misfit);
    if (misfit < least) {
      least = misfit;
      out.map.affine = start;
    }
  }
  fit.iterate(out.map.affine, Kind::rigid, kMapIterations, {kStartAside / 2, kPartnerAside});
  for (const Kind kind : {Kind::similarity, Kind::affine})
    fit.iterate(out.map.affine, kind, kMapIterations, {kPartnerAside, kPartnerAside});
  fit.place(out.map.affine, out.mapped, out.normals);
  const std::vector<Vec3> start = out.mapped;
  bend(out, start, target);
  out.misfits = partners_of(out.mapped, out.normals, target, kPartnerAside).misfit;
  out.median = median_of(out.misfits);
  const auto matched = std::count_if(out.misfits.begin(), out.misfits.end(), [](double d) { return d < kMatched; });
  out.matched = static_cast<double>(matched) / static_cast<double>(points.size());
  return out;
}

}  // namespace genu
