// build/bin/bench_bodies: the time of a warm pose of 10, 20 and 40 bodies tied by bushings, in a chain and as pieces of
// two horseshoes on bone. It fails where the time for each body grows by more than kMostGrowth, or where a pose takes
// more than one substep.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>

#include <fmt/format.h>

#include "genu/model/build_model.h"
#include "genu/path/path.h"
#include "genu/scene/centre_bodies.h"
#include "genu/scene/reader.h"

namespace {

using namespace genu;

constexpr int kRows = 200, kRepeats = 7;
constexpr double kMostGrowth = 1.2;  // from 10 bodies to 40; beside other work on the same core times scatter

double seconds_of_this_thread() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

const char* const kHeader = R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
)";

std::string free_body(int i, const std::string& parent, const std::string& reference) {
  return fmt::format(
      "[body.b{0}]\n[joint.j{0}]\ntype = \"free\"\nparent = \"{1}\"\nchild = \"b{0}\"\n"
      "rotations = [\"a z\", \"b x\", \"c y\"]\ntranslations = [\"x\", \"y\", \"z\"]\nreference = {{ {2} }}\n",
      i, parent, reference);
}

std::string bushing(const std::string& name, const std::string& from, const std::string& to, double stiffness) {
  return fmt::format(
      "[bushing.{0}]\nfrom = {{ body = \"{1}\" }}\nto = {{ body = \"{2}\" }}\nstiffness = [{3}, {3}, {3}]\n"
      "rotation_stiffness = [1, 1, 1]\n",
      name, from, to, stiffness);
}

std::string loaded(const std::string& body, double force) {
  return fmt::format(
      "[load.pull]\nbody = \"{}\"\nforce = [0, {}, 0]\n[[step]]\nload = {{ pull = [0, 1] }}\nincrements = {}\n", body,
      force, kRows);
}

/// Turned by about 0.01 deg a joint and row at the held end.
std::string chain(int n) {
  std::string text = kHeader;
  for (int i = 1; i <= n; ++i) {
    const std::string before = i == 1 ? "ground" : fmt::format("b{}", i - 1);
    text += free_body(i, before, "x = 5");
    text += bushing(fmt::format("k{}", i), before, fmt::format("b{}", i), 500);
  }
  return text + loaded(fmt::format("b{}", n), 35.0 / n);
}

/// Two horseshoes of n / 2 pieces, each piece on a soft bushing to the ground and on stiff ones to its neighbours.
std::string pieces(int n) {
  std::string text = kHeader;
  const int half = n / 2;
  for (int i = 0; i < n; ++i) {
    const double angle = 1.5 * M_PI * (i % half) / half;
    text += free_body(i, "ground",
                      fmt::format("a = {}, x = {}, z = {}", 180 / M_PI * angle,
                                  (i < half ? -25 : 25) + 15 * std::cos(angle), 15 * std::sin(angle)));
    text += bushing(fmt::format("hold{}", i), "ground", fmt::format("b{}", i), 5);
    if (i % half > 0) text += bushing(fmt::format("hoop{}", i), fmt::format("b{}", i - 1), fmt::format("b{}", i), 300);
  }
  return text + loaded("b0", 40);
}

struct Measured {
  double seconds = 0;  ///< a row
  int substeps = 0;
  bool complete = false;
};

Measured measure(const std::string& text) {
  Diagnostics problems;
  const auto scene = parse_scene(text, "scene.toml", problems);
  if (!scene) return {};
  const auto model = build_model(place(*scene), {}, problems);
  if (!model) return {};
  Measured out;
  for (int k = 0; k < kRepeats; ++k) {
    ContactField field(*model);
    PathObserver observer;
    int solved = 0;
    observer.pose = [&](const PosePoint& point, LayerMemories*) {
      solved += point.solved() && point.stability.verdict == Stability::Verdict::stable ? 1 : 0;
    };
    const double before = seconds_of_this_thread();
    const PathResult result = follow_path(*model, field, plan_steps(*scene), {}, observer);
    const double taken = (seconds_of_this_thread() - before) / kRows;
    out.seconds = k == 0 ? taken : std::min(out.seconds, taken);
    out.substeps = result.substeps;
    out.complete = result.complete && solved == kRows + 1;
  }
  return out;
}

bool bench(const char* name, std::string (*scene)(int)) {
  bool good = true;
  double first = 0;
  for (const int n : {10, 20, 40}) {
    const Measured m = measure(scene(n));
    const double each = m.seconds / n;
    if (n == 10) first = each;
    fmt::print("{:6} of {} bodies {:8.1f} us a pose, {:6.2f} us a body ({:.2f}), {} substeps for {} rows{}\n", name, n,
               1e6 * m.seconds, 1e6 * each, each / first, m.substeps, kRows, m.complete ? "" : ", NOT all solved");
    good = good && m.complete && m.substeps <= kRows + 1 && each <= kMostGrowth * first;
  }
  return good;
}

}  // namespace

int main() {
  const bool linear = bench("chain", chain), as_pieces = bench("pieces", pieces);
  return linear && as_pieces ? 0 : 1;
}
