#include "genu/judge/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

using Form = SurfaceDef::Shape;
constexpr double kPi = std::numbers::pi;

struct Height {
  double h = 0, du = 0, dv = 0;
};

/// sum c u^i v^j, term by term, from the powers of u and v.
Height height(const std::vector<SurfaceDef::Term>& terms, double u, double v) {
  constexpr std::size_t kPowers = 21;  // exponents up to 20
  std::array<double, kPowers> pu{1}, pv{1};
  for (std::size_t k = 1; k < kPowers; ++k) pu[k] = u * pu[k - 1], pv[k] = v * pv[k - 1];
  Height out;
  for (const auto& t : terms) {
    out.h += t.c * pu[at(t.i)] * pv[at(t.j)];
    if (t.i > 0) out.du += t.c * t.i * pu[at(t.i - 1)] * pv[at(t.j)];
    if (t.j > 0) out.dv += t.c * t.j * pu[at(t.i)] * pv[at(t.j - 1)];
  }
  return out;
}

/// theta in (centre - pi, centre + pi].
double angle_near(double theta, double centre) {
  return theta - 2 * kPi * std::ceil((theta - centre) / (2 * kPi) - 0.5);
}

}  // namespace

double Shape::value(const Vec3& p) const {
  const SurfaceDef& d = *def_;
  const double rho = std::hypot(p.x(), p.y());
  double f = 0;
  switch (d.shape) {
    case Form::plane:
      f = p.z();
      break;
    case Form::sphere:
      f = p.norm() - d.radius;
      break;
    case Form::ellipsoid:
      f = (p.cwiseQuotient(d.radii).norm() - 1) * d.radii.minCoeff();
      break;
    case Form::cylinder:
      f = rho - d.radius;
      break;
    case Form::torus:
      f = std::hypot(rho - d.major_radius, p.z()) - d.minor_radius;
      break;
    case Form::polynomial:
      f = p.z() - height(d.terms, p.x(), p.y()).h;
      break;
    case Form::cylindrical_polynomial:
      f = rho - height(d.terms, std::atan2(p.y(), p.x()), p.z()).h;
      break;
    case Form::mesh:
      break;
  }
  return d.inside ? -f : f;
}

Vec3 Shape::gradient(const Vec3& p) const {
  const SurfaceDef& d = *def_;
  const double rho = std::hypot(p.x(), p.y());
  const Vec3 out = rho > 0 ? Vec3(p.x() / rho, p.y() / rho, 0) : Vec3(Vec3::UnitX());
  Vec3 g = Vec3::UnitZ();
  switch (d.shape) {
    case Form::plane:
    case Form::mesh:
      break;
    case Form::sphere:
      g = p.normalized();
      break;
    case Form::ellipsoid: {
      const Vec3 s = p.cwiseQuotient(d.radii);
      g = d.radii.minCoeff() / s.norm() * s.cwiseQuotient(d.radii);
      break;
    }
    case Form::cylinder:
      g = out;
      break;
    case Form::torus: {
      const Vec3 from = p - d.major_radius * out;
      g = from.normalized();
      break;
    }
    case Form::polynomial: {
      const Height h = height(d.terms, p.x(), p.y());
      g = Vec3(-h.du, -h.dv, 1);
      break;
    }
    case Form::cylindrical_polynomial: {
      const Height h = height(d.terms, std::atan2(p.y(), p.x()), p.z());
      g = out - h.du / rho * Vec3(-out.y(), out.x(), 0) - h.dv * Vec3::UnitZ();
      break;
    }
  }
  return d.inside ? Vec3(-g) : g;
}

std::optional<Vec3> Shape::onto(Vec3 p) const {
  for (int i = 0; i < 60; ++i) {
    const Vec3 g = gradient(p);
    const double f = value(p);
    if (!(g.squaredNorm() > 0) || !std::isfinite(f)) return std::nullopt;
    p -= f / g.squaredNorm() * g;
    if (std::abs(f) < 1e-15) return p;
  }
  return std::abs(value(p)) < 1e-12 ? std::optional(p) : std::nullopt;
}

std::optional<Vec3> Shape::nearest(const Vec3& p) const {
  auto foot = onto(p);
  const Form form = def_->shape;
  if (form != Form::ellipsoid && form != Form::polynomial && form != Form::cylindrical_polynomial) return foot;
  // Steps along the surface toward the foot of p; half steps, because curvature may overshoot.
  for (int i = 0; foot && i < 60; ++i) {
    const Vec3 n = normal(*foot), off = p - *foot, along = off - n.dot(off) * n;
    if (along.norm() < 1e-12) break;
    foot = onto(*foot + 0.5 * along);
  }
  return foot;
}

double Shape::beyond_patch(const Vec3& p) const {
  if (!def_->patch) return 0;
  double beyond = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (const auto& range = def_->patch->box[i]) {
      const double x = p[static_cast<Eigen::Index>(i)];
      beyond = std::max({beyond, range->first - x, x - range->second});
    }
  if (const auto& range = def_->patch->theta) {
    const double theta = angle_near(std::atan2(p.y(), p.x()), (range->first + range->second) / 2);
    beyond = std::max(beyond, std::max(range->first - theta, theta - range->second) * std::hypot(p.x(), p.y()));
  }
  return beyond;
}

bool Shape::in_patch(const Vec3& p) const { return beyond_patch(p) <= 1e-9; }

bool Shape::bounded() const {
  const auto limits = [&](std::size_t axis) { return def_->patch && def_->patch->box[axis]; };
  switch (def_->shape) {
    case Form::plane:
    case Form::polynomial:
      return limits(0) && limits(1);
    case Form::cylinder:
    case Form::cylindrical_polynomial:
      return limits(2);
    case Form::sphere:
    case Form::ellipsoid:
    case Form::torus:
    case Form::mesh:
      break;
  }
  return true;
}

double Shape::steepness(const Vec3& p) const {
  const bool polynomial = def_->shape == Form::polynomial || def_->shape == Form::cylindrical_polynomial;
  return polynomial ? kSteeperNearby * (1 + gradient(p).norm()) : 1;
}

Shape::Parameters Shape::parameters() const {
  const SurfaceDef& d = *def_;
  const auto range = [&](std::size_t axis) { return *d.patch->box[axis]; };
  Parameters r{-kPi, kPi, -kPi / 2, kPi / 2};
  if (d.shape == Form::torus) r.v0 = -kPi, r.v1 = kPi;
  if (d.shape == Form::plane || d.shape == Form::polynomial)
    r = {range(0).first, range(0).second, range(1).first, range(1).second};
  if (d.shape == Form::cylinder || d.shape == Form::cylindrical_polynomial)
    r.v0 = range(2).first, r.v1 = range(2).second;
  if (d.patch && d.patch->theta) r.u0 = d.patch->theta->first, r.u1 = d.patch->theta->second;
  return r;
}

Vec3 Shape::point(double u, double v) const {
  const SurfaceDef& d = *def_;
  const Vec3 out(std::cos(u), std::sin(u), 0);
  switch (d.shape) {
    case Form::sphere:
      return d.radius * Vec3(std::cos(v) * out + std::sin(v) * Vec3::UnitZ());
    case Form::ellipsoid:
      return d.radii.cwiseProduct(Vec3(std::cos(v) * out + std::sin(v) * Vec3::UnitZ()));
    case Form::torus:
      return (d.major_radius + d.minor_radius * std::cos(v)) * out + d.minor_radius * std::sin(v) * Vec3::UnitZ();
    case Form::cylinder:
      return d.radius * out + v * Vec3::UnitZ();
    case Form::cylindrical_polynomial:
      return height(d.terms, u, v).h * out + v * Vec3::UnitZ();
    case Form::polynomial:
      return {u, v, height(d.terms, u, v).h};
    case Form::plane:
    case Form::mesh:
      break;
  }
  return {u, v, 0};
}

/// The piece (i, j) of n x n; its area from its midlines.
Sample Shape::piece(const Parameters& r, int n, int i, int j) const {
  const double du = (r.u1 - r.u0) / n, dv = (r.v1 - r.v0) / n;
  const double u = r.u0 + (i + 0.5) * du, v = r.v0 + (j + 0.5) * dv;
  const Vec3 along_u = point(u + du / 2, v) - point(u - du / 2, v);
  const Vec3 along_v = point(u, v + dv / 2) - point(u, v - dv / 2);
  const Vec3 p = point(u, v);
  return {p, normal(p), along_u.cross(along_v).norm(), std::max(along_u.norm(), along_v.norm())};
}

std::vector<Sample> Shape::pieces(int n) const {
  const Parameters r = parameters();
  std::vector<Sample> out;
  out.reserve(at(n) * at(n));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) out.push_back(piece(r, n, i, j));
  return out;
}

std::vector<Sample> Shape::samples(int n) const {
  std::vector<Sample> out = pieces(n);
  std::erase_if(out, [this](const Sample& s) { return !in_patch(s.p); });
  return out;
}

std::vector<Sample> Shape::samples_of(int n, int index, int fine) const {
  const Parameters r = parameters();
  std::vector<Sample> out;
  for (int i = 0; i < fine; ++i)
    for (int j = 0; j < fine; ++j) {
      const Sample s = piece(r, n * fine, index / n * fine + i, index % n * fine + j);
      if (in_patch(s.p)) out.push_back(s);
    }
  return out;
}

}  // namespace genu::judge
