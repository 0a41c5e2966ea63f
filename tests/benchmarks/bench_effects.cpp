// What each effect adds to the unknowns and to the time of a pose, on one knee (two tori on two planes, seven
// springs, meshes/dortmans1984, 0 to 70 deg): build/bin/bench_effects. The table of docs/measured.md.
#include <algorithm>
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
#include "genu/study/run_scene.h"
#include "support/places.h"

namespace {

using namespace genu;

constexpr int kRounds = 41;    // one of each variant in turn,
constexpr double kEnough = 2;  // s: but no more of one that takes so long

struct Variant {
  std::string name, unknowns, text;
  Prepared prepared = {};
  std::vector<double> times = {};  ///< s a row
  double spent = 0;                ///< s
};

std::string knee_text() {
  std::ifstream in(genu::test::source_folder() + "/meshes/dortmans1984/scene.toml");
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

std::string with(std::string text, const std::string& old, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += by.size())
    text.replace(at, old.size(), by);
  return text;
}

Prepared prepared(const Variant& variant) {
  Diagnostics out;
  std::optional<Prepared> p;
  if (auto scene = parse_scene(variant.text, variant.name, out))
    p = prepare(std::move(*scene), std::make_shared<MeshLibrary>(), out);
  for (const Diagnostic& d : out.items()) fmt::print(stderr, "{}\n", to_string(d));
  if (!p) std::exit(1);
  return std::move(*p);
}

void measure(Variant& variant) {
  const Timer timer;
  if (variant.prepared.scene.dynamics) {
    const Solution s = solve_motion(variant.prepared, {});
    variant.times.push_back(timer.seconds() / static_cast<double>(s.poses.rows()));
    variant.spent += timer.seconds();
    return;
  }
  ContactField field(variant.prepared.model);
  const Timer solving;
  const Solution s = solve(variant.prepared, field, {});
  if (s.summary.exit_code != kExitOk) fmt::print(stderr, "{}: not all poses are solved\n", variant.name);
  variant.times.push_back(solving.seconds() / s.summary.poses_asked);
  variant.spent += timer.seconds();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::vector<Variant> variants() {
  const std::string knee = knee_text(), body = "[body.femur]\n", rigid = "model = \"rigid\"";
  const std::string layer = "model = \"cartilage\"\nmodulus = 5\npoisson = 0.45\nthickness = 4\n";
  const std::string mass = body + "mass = 4\ncentre_of_mass = [0, 0, 60]\n";
  const std::string inertia = mass + "inertia = [0.05, 0.05, 0.01]\n";
  const std::string load = "[load.axial]\nbody = \"femur\"\nforce = [0, 0, -50]\n\n[[step]]";
  const std::string own = "7 springs, 2 rigid contacts, 1 coordinate held";
  std::vector<Variant> out{
      {own, "6 + 1 + 5 x 2 = 17", knee},
      {"+ a load on the femur", "0", with(knee, "[[step]]", load)},
      {"+ the same, scaled over flexion", "0",
       with(
           knee, "[[step]]",
           with(load, "\n\n[[step]]", "\nscale = { over = \"knee.flexion\", table = [[0, 0], [70, 1]] }\n\n[[step]]"))},
      {"+ weight of the femur", "0",
       with(with(knee, body, mass), "[body.tibia]", "gravity = [0, 0, -9.81]\n\n[body.tibia]")},
      {"+ rotation held too", "1 multiplier",
       with(knee, "\"knee.flexion\" = [0, 70]", "\"knee.flexion\" = [0, 70], \"knee.rotation\" = 0")},
      {"cartilage layers for the contacts, smooth", "-5 each", with(knee, rigid, layer)},
      {"motion: flexed to 70 deg in 2 s, a row each 0.028 s", "13 for the femur, over time",
       with(with(knee, body, inertia), knee.substr(knee.find("[[step]]")),
            "[dynamics]\nduration = 2\noutput_interval = 0.028\ntolerance = 1e-6\nstart = \"equilibrium\"\nprescribe = "
            "{ "
            "\"knee.flexion\" = { step = { to = 70, rise = 2 } } }\n")},
  };
  for (Variant& v : out) v.prepared = prepared(v);
  return out;
}

}  // namespace

int main() {
  std::vector<Variant> all = variants();
  for (int round = 0; round < kRounds; ++round)
    for (Variant& v : all)
      if (v.spent < kEnough) measure(v);
  const double own = median(all.front().times);
  fmt::print("| {:<52} | {:<27} | {:>9} | {:>6} |\n|{:-<54}|{:-<29}|{:->11}|{:->8}|\n", "the torus knee with",
             "unknowns", "us a pose", "ratio", "", "", ":", ":");
  for (const Variant& v : all)
    fmt::print("| {:<52} | {:<27} | {:>9.0f} | {:>6.2f} |\n", v.name, v.unknowns, 1e6 * median(v.times),
               median(v.times) / own);
}
