#include "genu/shape_fit/chart_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "genu/core/decompositions.h"
#include "genu/mesh/vertex_graph.h"
#include "genu/shape_fit/tolerances.h"
#include "genu/surface/polynomial_surface.h"

namespace genu {
namespace {

Mat3 axes_from(const Vec3& z, const Vec3& toward) {
  Mat3 R;
  R.col(2) = z.normalized();
  Vec3 x = toward - toward.dot(R.col(2)) * R.col(2);
  if (!(x.norm() > 1e-9 * toward.norm())) x = R.col(2).unitOrthogonal();
  R.col(0) = x.normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

Vec3 mean_normal(const std::vector<OrientedPoint>& points) {
  Vec3 sum = Vec3::Zero();
  for (const OrientedPoint& q : points) sum += q.area * q.n;
  return sum;
}

Vec3 area_centroid(const std::vector<OrientedPoint>& points) {
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (const OrientedPoint& q : points) sum += q.area * q.p, area += q.area;
  return area > 0 ? Vec3(sum / area) : Vec3::Zero();
}

/// A point of the axis along `z` of the circular cylinder through the points: |p|^2 = 2 c . p + const, least squares
/// (Kasa), which is linear.
Vec3 axis_point(const std::vector<OrientedPoint>& points, const Vec3& z) {
  const Mat3 R = axes_from(z, z.unitOrthogonal());
  const Vec3 middle = area_centroid(points);
  Mat3 A = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  for (const OrientedPoint& q : points) {
    const Vec3 d = R.transpose() * (q.p - middle), row(d.x(), d.y(), 1);
    A += q.area * row * row.transpose();
    b += q.area * d.head<2>().squaredNorm() * row;
  }
  // Scaled, so that lengths and the constant have a like say in the rank.
  const double scale = std::sqrt(std::max(A(0, 0), A(1, 1)) / std::max(A(2, 2), 1e-300));
  const Vec3 units(1 / scale, 1 / scale, 1);
  const Mat3 scaled = units.asDiagonal() * A * units.asDiagonal();
  const Vec3 solved = units.cwiseProduct(Vec3(scaled.fullPivLu().solve(Vec3(units.cwiseProduct(b)))));
  return middle + R * Vec3(0.5 * solved.x(), 0.5 * solved.y(), 0);
}

}  // namespace

Vec3 largest_positive(const Vec3& v) {
  Eigen::Index k = 0;
  v.cwiseAbs().maxCoeff(&k);
  return v[k] < 0 ? Vec3(-v) : v;
}

std::vector<OrientedPoint> oriented_points(const Mesh& mesh) {
  const VertexGraph graph = vertex_graph(mesh);
  std::vector<OrientedPoint> out;
  out.reserve(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    out.push_back({mesh.vertices[v], graph.normals[v], graph.areas[v]});
  return out;
}

bool wraps_round(const std::vector<OrientedPoint>& points) {
  const Vec3 mean = mean_normal(points).normalized();
  double area = 0, beyond = 0;
  for (const OrientedPoint& q : points) {
    area += q.area;
    if (!(q.n.dot(mean) > kConeMinCosine)) beyond += q.area;
  }
  return beyond > kOutsideConeShare * area;
}

Pose plane_frame(const std::vector<OrientedPoint>& points) {
  const Vec3 z = mean_normal(points);
  return {axes_from(z.norm() > 0 ? z : Vec3::UnitZ(), Vec3::UnitX()), area_centroid(points)};
}

std::vector<Vec3> normal_axes(const std::vector<OrientedPoint>& points) {
  Mat3 N = Mat3::Zero();
  for (const OrientedPoint& q : points) N += q.area * q.n * q.n.transpose();
  const Mat3 axes = symmetric_eigen(N).vectors;
  return {largest_positive(axes.col(0)), largest_positive(axes.col(1)), largest_positive(axes.col(2))};
}

Pose axis_frame(const std::vector<OrientedPoint>& points, const Vec3& axis) {
  const Vec3 z = axis.normalized(), on_axis = axis_point(points, z), middle = area_centroid(points);
  return {axes_from(z, middle - on_axis), on_axis + (middle - on_axis).dot(z) * z};
}

bool faces_inward(const SurfaceChart& chart, const std::vector<OrientedPoint>& points) {
  double outward = 0;
  for (const OrientedPoint& q : points) outward += q.area * q.n.dot(chart.upward(q.p));
  return outward < 0;
}

void align_with_zone(const Mesh& zone, SurfaceChart& chart) {
  Mat2 second = Mat2::Zero();
  Vec2 first = Vec2::Zero();
  double area = 0;
  for (const auto& t : zone.triangles) {
    std::array<Vec2, 3> c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = chart.to_own(zone.vertices[static_cast<std::size_t>(t[k])]).head<2>();
    const Vec2 a = c[1] - c[0], b = c[2] - c[0], sum = c[0] + c[1] + c[2];
    const double twice = a.x() * b.y() - a.y() * b.x();  // projected, signed
    area += twice / 2;
    first += twice / 6 * sum;
    second += twice / 24 *
              (c[0] * c[0].transpose() + c[1] * c[1].transpose() + c[2] * c[2].transpose() + sum * sum.transpose());
  }
  if (!(area > 0)) return;
  const Mat2 moments = second - first * first.transpose() / area;
  const Vec2 main = symmetric_eigen(moments).vectors.col(1);
  const Vec3 x = largest_positive(chart.X_BS.R * Vec3(main.x(), main.y(), 0));
  chart.X_BS.R = axes_from(chart.X_BS.R.col(2), x);
}

void centre_on(ChartBox& box, SurfaceChart& chart) {
  const double u = 0.5 * (box.u0 + box.u1), v = 0.5 * (box.v0 + box.v1);
  if (chart.cylindrical) {
    chart.X_BS.p += v * chart.X_BS.R.col(2);
    chart.X_BS.R = chart.X_BS.R * Eigen::AngleAxisd(u, Vec3::UnitZ()).toRotationMatrix();
  } else {
    chart.X_BS.p = chart.position({u, v, 0});
  }
  box = {box.u0 - u, box.u1 - u, box.v0 - v, box.v1 - v};
}

SurfaceChart level_chart(const SurfaceChart& chart, const std::vector<PolynomialTerm>& terms) {
  const PolynomialJet middle = Polynomial(terms)(0, 0);
  const Vec3 z = chart.X_BS.R * Vec3(-middle.x, -middle.y, 1);
  return {false, {axes_from(z, chart.X_BS.R.col(0)), chart.position({0, 0, middle.f})}};
}

double chart_difference(const SurfaceChart& a, const SurfaceChart& b, double length) {
  const double turned = log_rotation(a.X_BS.R.transpose() * b.X_BS.R).norm();
  return std::hypot(turned, (a.X_BS.p - b.X_BS.p).norm() / length);
}

}  // namespace genu
