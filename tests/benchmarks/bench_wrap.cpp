// What a fibre that wraps costs beside a straight one: build/bin/bench_wrap. The table of docs/wrapping.md.
//
// A fibre from a fixed point to one on a body that turns about the obstacle by half a degree from pose to pose, to and
// fro. One evaluation is what Newton's method asks for at a pose: touches carried on from the last one, length, wrench
// and stiffness.
#include <ctime>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "genu/core/diagnostics.h"
#include "genu/model/ligament_path.h"
#include "genu/surface/analytic.h"
#include "genu/surface/blend_surface.h"

namespace {

using namespace genu;

constexpr int kPoses = 40;        // to and fro
constexpr double kTurn = 0.0087;  // rad from pose to pose: half a degree
constexpr double kEnough = 0.4;   // s

std::shared_ptr<const Surface> meshed(const Surface& shape, double edge) {
  Diagnostics out;
  auto blend = BlendSurface::build(shape.triangles(edge, Vec3::Zero(), 1), {}, "mesh", out);
  if (!blend) std::exit(1);
  return blend;
}

/// Poses of the world, of the obstacle's body and of the body of the far end, which turns.
std::vector<Pose> poses_at(int k) {
  const int to_and_fro = k % (2 * kPoses) < kPoses ? k % kPoses : kPoses - 1 - k % kPoses;
  return {Pose(), Pose(), {exp_rotation(Vec3(0.2, 0.3, 1).normalized() * kTurn * to_and_fro), Vec3::Zero()}};
}

struct Case {
  std::string name;
  LigamentPath path;
};

Case make_case(const std::string& name, std::shared_ptr<const Surface> surface) {
  Case out{name, LigamentPath({{0, Vec3(-0.03, 0.004, -0.002)}, {2, Vec3(0.034, -0.006, 0.003)}})};
  if (surface) out.path.set_obstacles({{"", 1, std::move(surface), 0, WrapSide(Vec3(0, 1, 0))}}, 0);
  out.path.move_with({-1, 0, 1});
  return out;
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// us of processor time for one evaluation.
double cost(const Case& c) {
  Wraps wraps(c.path.obstacles().size());
  for (WrapTouch& touch : wraps) touch.by_length = true;
  if (!c.path.find_touches(poses_at(0), wraps)) std::exit(1);
  for (WrapTouch& touch : wraps) touch.by_length = true;
  std::vector<std::vector<Pose>> poses;
  for (int k = 0; k < 2 * kPoses; ++k) poses.push_back(poses_at(k));
  VecX gradient, wrench = VecX::Zero(12);
  MatX stiffness = MatX::Zero(12, 12);
  double sum = 0;
  const double begun = processor_seconds();
  long count = 0;
  while (processor_seconds() < begun + kEnough)
    for (const std::vector<Pose>& pose : poses) {
      if (!wraps.empty() && !c.path.follow_touches(pose, wraps)) std::exit(1);
      sum += c.path.length(pose, wraps);
      wrench.setZero();
      stiffness.setZero();
      c.path.linearize(pose, {.force = 100, .stiffness = 1e5}, gradient, wrench, &stiffness, wraps);
      ++count;
    }
  if (!(sum > 0) || (!wraps.empty() && !wraps[0].touching)) std::exit(1);
  return 1e6 * (processor_seconds() - begun) / static_cast<double>(count);
}

}  // namespace

int main() {
  const auto ellipsoid = make_ellipsoid({}, Vec3(0.022, 0.018, 0.02), false);
  std::vector<Case> cases;
  cases.push_back(make_case("straight", nullptr));
  cases.push_back(make_case("sphere", make_sphere({}, 0.02, false)));
  cases.push_back(make_case("cylinder", make_cylinder({}, 0.02, false)));
  cases.push_back(make_case("ellipsoid", make_ellipsoid({}, Vec3(0.022, 0.018, 0.02), false)));
  cases.push_back(make_case("mesh of 2 500 triangles", meshed(*ellipsoid, 3e-3)));
  cases.push_back(make_case("mesh of 10 000 triangles", meshed(*ellipsoid, 1.4e-3)));
  const double straight = cost(cases[0]);
  fmt::print("| {:<26} | {:>7} | {:>6} |\n|{:-<28}|{:->9}|{:->8}|\n", "a fibre", "us", "ratio", "", ":", ":");
  for (const Case& c : cases) {
    const double us = cost(c);
    fmt::print("| {:<26} | {:>7.2f} | {:>6.1f} |\n", c.name, us, us / straight);
  }
}
