// How long motion over time takes: build/bin/bench_motion.
//   1. 10 s of the knee of meshes/leskovar2019 to 1e-6 of its largest angle, beside four planar equations of state
//   written
//      by hand on bare CVODE, each with the loosest tolerance (and the better method) that gets there
//   2. a step of a torus knee with two rigid contacts (meshes/dortmans1984), and with the same knee held up without any
// Exit code 1 where the two do not agree.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "genu/assemble/prepare.h"
#include "genu/core/timer.h"
#include "genu/model/build_model.h"
#include "genu/scene/centre_bodies.h"
#include "genu/scene/reader.h"
#include "genu/study/run_motion.h"
#include "planar_knee.h"
#include "support/places.h"

namespace {

using namespace genu;

constexpr double kEnd = 10, kAccuracy = 1e-6;  // s; of the largest angle
constexpr double kLargestAngle = 0.82;         // rad: 47 deg
constexpr int kRounds = 7;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

template <typename Work>
double seconds(Work work) {
  std::vector<double> times;
  for (int i = 0; i < kRounds; ++i) {
    const Timer timer;
    work();
    times.push_back(timer.seconds());
  }
  return median(times);
}

std::string text_of(const std::string& file) {
  std::ifstream in(genu::test::source_folder() + "/meshes/" + file);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

Prepared prepared(const std::string& text) {
  Diagnostics out;
  auto p = prepare(parse_scene(text, "scene.toml", out).value_or(Scene{}), std::make_shared<MeshLibrary>(), out);
  for (const Diagnostic& d : out.items()) fmt::print(stderr, "{}\n", to_string(d));
  return p ? std::move(*p) : Prepared{};
}

struct Moved {
  MotionPoint end;
  MotionResult result;
};

Moved moved(const JointModel& model, const MotionPlan& plan) {
  Moved out;
  MotionObserver observer;
  observer.point = [&](const MotionPoint& point) { out.end = point; };
  out.result = follow_motion(model, plan, observer);
  return out;
}

/// The loosest tolerance of a decade's thirds with which `angle` is accurate enough.
template <typename Angle>
double loosest(double exact, Angle angle) {
  for (double exponent = -3; exponent > -13; exponent -= 1.0 / 3)
    if (std::abs(angle(std::pow(10, exponent)) - exact) < kAccuracy * kLargestAngle) return std::pow(10, exponent);
  return 1e-13;
}

bool three_bones() {
  const Prepared p = prepared(text_of("leskovar2019/scene.toml"));
  const auto plan = [](double tolerance) {
    MotionPlan out;
    out.duration = out.output_interval = kEnd;
    out.tolerance = tolerance;
    return out;
  };
  const double exact = planar::run(kEnd, 1e-13, CV_ADAMS).angle;
  const double ours = loosest(exact, [&](double t) { return moved(p.model, plan(t)).end.state.coordinates[0][0]; });
  const Moved last = moved(p.model, plan(ours));
  const double time = seconds([&] { moved(p.model, plan(ours)); });
  double best = 1e9;
  long steps = 0;
  for (const int method : {CV_ADAMS, CV_BDF}) {
    const double tolerance = loosest(exact, [&](double t) { return planar::run(kEnd, t, method).angle; });
    const double bare = seconds([&] { planar::run(kEnd, tolerance, method); });
    if (bare < best) steps = planar::run(kEnd, tolerance, method).steps;
    best = std::min(best, bare);
  }
  fmt::print("{:<44}{:>10}{:>12}{:>10}\n", "10 s of three bones, to 1e-6", "steps", "time [ms]", "ratio");
  fmt::print("{:<44}{:>10}{:>12.2f}{:>10.1f}\n", "four planar equations by hand, bare CVODE", steps, 1e3 * best, 1.0);
  fmt::print("{:<44}{:>10}{:>12.2f}{:>10.1f}\n\n", fmt::format("genu (tolerance {:.1e})", ours),
             last.result.counts.steps, 1e3 * time, time / best);
  return std::abs(last.end.state.coordinates[0][0] - exact) < kAccuracy * kLargestAngle;
}

void contact() {
  std::string text = text_of("dortmans1984/scene.toml");
  text = text.substr(0, text.find("[[step]]"));
  const std::string body = "[body.femur]\n";
  text.insert(text.find(body) + body.size(), "mass = 4\ncentre_of_mass = [0, 0, 60]\ninertia = [0.05, 0.05, 0.01]\n");
  text +=
      "[dynamics]\nduration = 2\noutput_interval = 2\ntolerance = 1e-7\nprescribe = { \"knee.flexion\" = { step = { to "
      "= 50, rise = 2 } }";
  const Prepared touching = prepared(text + " }\nstart = \"equilibrium\"\n");
  std::string apart_text = text + ", \"knee.z\" = 25 }\n";
  for (std::size_t at; (at = apart_text.find("[contact.")) != std::string::npos;)
    apart_text.erase(at, apart_text.find("[", apart_text.find("model", at)) - at);
  const Prepared apart = prepared(apart_text);
  fmt::print("{:<44}{:>10}{:>14}{:>10}\n", "a torus knee bent to 50 deg in 2 s", "steps", "us a step", "ratio");
  double without = 0;
  for (const Prepared* p : {&apart, &touching}) {
    const MotionPlan plan = plan_motion(*p->scene.dynamics);
    const Moved once = moved(p->model, plan);
    const double each = seconds([&] { moved(p->model, plan); }) / static_cast<double>(once.result.counts.steps);
    if (p == &apart) without = each;
    fmt::print("{:<44}{:>10}{:>14.1f}{:>10.1f}\n",
               p == &apart ? "no contacts, its height prescribed" : "two rigid contacts", once.result.counts.steps,
               1e6 * each, each / without);
  }
}

}  // namespace

int main() {
  const bool agree = three_bones();
  contact();
  return agree ? 0 : 1;
}
