// Motions of scenes given as text.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/assemble/prepare.h"
#include "genu/model/build_model.h"
#include "genu/scene/centre_bodies.h"
#include "genu/scene/reader.h"
#include "genu/study/run_motion.h"
#include "support/judged.h"

namespace genu::test {

inline constexpr double kG = 9.81;  // m/s^2
inline constexpr double kPerDegree = std::numbers::pi / 180;

inline Prepared prepared_motion(const Scene& scene) {
  Diagnostics out;
  auto p = prepare(scene, std::make_shared<MeshLibrary>(), out);
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  return p ? std::move(*p) : Prepared{};
}

inline Scene motion_scene(const std::string& text) {
  Diagnostics out;
  auto scene = parse_scene(text, "scene.toml", out);
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  return scene.value_or(Scene{});
}

/// The motion of a scene, which must come to its end with every row on its constraints.
inline Solution motion_of(const Scene& scene) {
  if (!scene.dynamics) return {};
  Solution s = solve_motion(prepared_motion(scene), {});
  EXPECT_EQ(s.summary.exit_code, kExitOk) << (s.summary.verdict.empty() ? "" : s.summary.verdict.front());
  EXPECT_LT(s.summary.motion->worst_residual, 1e-10) << "of the constraints, over the scale of length";
  expect_judged_ok(scene, s.poses);
  return s;
}
inline Solution motion_of(const std::string& text) { return motion_of(motion_scene(text)); }

inline const std::string kGround = R"(format = 1
units = { length = "m", angle = "rad" }
[body.ground]
fixed = true
)";

/// A stool of 3 kg on round feet of 20 mm (middles in its own frame, m) over a floor, surfaces foot0 ..., contacts c0
/// ...
inline std::string stool(const Vec3& centre, const Vec3& inertia, const std::string& reference,
                         const std::vector<Vec3>& feet) {
  std::string text = "format = 1\nunits = { length = \"m\", angle = \"rad\" }\n" +
                     fmt::format("gravity = [0, 0, {}]\n", -kG) + "[body.ground]\nfixed = true\n" +
                     fmt::format("[body.stool]\nmass = 3\ncentre_of_mass = [{}, {}, {}]\ninertia = [{}, {}, {}]\n",
                                 centre.x(), centre.y(), centre.z(), inertia.x(), inertia.y(), inertia.z()) +
                     R"([joint.free]
type = "free"
parent = "ground"
child = "stool"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
reference = { )" + reference +
                     " }\n[surface.floor]\nbody = \"ground\"\nshape = \"plane\"\n";
  for (std::size_t i = 0; i < feet.size(); ++i)
    text += fmt::format(
        "[surface.foot{0}]\nbody = \"stool\"\nshape = \"sphere\"\nradius = 0.02\norigin = [{1}, {2}, {3}]\n"
        "[contact.c{0}]\nsurfaces = [\"foot{0}\", \"floor\"]\nmodel = \"rigid\"\n",
        i, feet[i].x(), feet[i].y(), feet[i].z());
  return text;
}

inline std::string dynamics(double duration, double interval, double tolerance, const std::string& rates = "") {
  return fmt::format("[dynamics]\nduration = {}\noutput_interval = {}\ntolerance = {}\n", duration, interval,
                     tolerance) +
         (rates.empty() ? "" : "start_rates = { " + rates + " }\n");
}

/// The amplitude am(u, k) of Jacobi's elliptic functions, continuous in u, by Gauss' arithmetic-geometric mean
/// (Abramowitz and Stegun 16.4).
inline double amplitude(double u, double k) {
  double a[16] = {1}, c[16] = {k}, b = std::sqrt(1 - k * k);
  int n = 0;
  for (; n < 15 && std::abs(c[n]) > 1e-17; ++n) {
    a[n + 1] = (a[n] + b) / 2;
    c[n + 1] = (a[n] - b) / 2;
    b = std::sqrt(a[n] * b);
  }
  double phi = std::ldexp(a[n] * u, n);
  for (; n > 0; --n) phi = (phi + std::asin(c[n] * std::sin(phi) / a[n])) / 2;
  return phi;
}

}  // namespace genu::test
