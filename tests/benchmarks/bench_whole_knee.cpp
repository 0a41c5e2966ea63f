// build/bin/bench_whole_knee: the time of the measured whole knee (meshes/lenhart2015_whole, layers, 91 poses from 0 to
// 90 deg) on one core, beside the sum of its parts: the tibia on the femur, where the pull of the patellar tendon is a
// load that turns with the tibia and follows a table over flexion, and the patella on the femur, while the tibia moves
// straight from its first to its last pose. The tibia must be where it is in the whole in every row, and the patella in
// the first and the last. It fails where that is not so, where a part is not solved, or where an evaluation of the
// whole costs more than kMostOfParts of the sum. A pose costs more: where a fibre of either part goes taut or touches
// bone, both parts are solved. Without the public knee data: exit code 77.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "genu/assemble/prepare.h"
#include "genu/core/units.h"
#include "genu/model/effect_meter.h"
#include "genu/model/unbalanced.h"
#include "genu/path/path.h"
#include "genu/scene/reader.h"
#include "support/data.h"
#include "support/places.h"

namespace {

using namespace genu;

constexpr int kRows = 91, kRounds = 7;
constexpr double kMostOfParts = 1.15;  // beside other work on the same core times scatter
constexpr double kSamePose = 1e-7;     // m, rad
constexpr int kSkipped = 77;

constexpr std::array<const char*, 6> kKnee = {"flexion", "adduction", "rotation", "x", "y", "z"};

double seconds_of_this_thread() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string knee_text() {
  std::ifstream in(genu::test::source_folder() + "/meshes/lenhart2015_whole/scene.toml");
  std::ostringstream out;
  out << in.rdbuf();
  std::string text = out.str();
  const std::string data = "../../../shared/data/";
  for (std::size_t at = 0; (at = text.find(data, at)) != std::string::npos;)
    text.replace(at, data.size(), genu::test::data_path(""));
  return text;
}

/// Without the tables whose headers begin so.
std::string without(std::string text, const std::vector<std::string>& headers) {
  for (const std::string& header : headers)
    for (std::size_t at = 0; (at = text.find("[" + header, at)) != std::string::npos;)
      text.insert(at = text.find('\n', at) + 1, "enabled = false\n");
  return text;
}

using Path = std::vector<State>;  // by row

/// One step, in which the tibia moves straight from its first to its last pose of the path.
std::string tibia_moved(const std::string& text, const Path& path) {
  std::string out = text.substr(0, text.find("[[step]]")) + "[[step]]\nincrements = 90\nprescribe = {";
  for (std::size_t i = 0; i < 6; ++i)
    out += fmt::format("{} \"knee.{}\" = [{:.17g}, {:.17g}]", i == 0 ? "" : ",", kKnee[i],
                       (i < 3 ? to::kDegree : to::kMillimetre) * path.front().coordinates[0][i],
                       (i < 3 ? to::kDegree : to::kMillimetre) * path.back().coordinates[0][i]);
  return out + " }\n";
}

struct Case {
  std::string name;
  Prepared prepared = {};
  Path path = {};
  double seconds = 0;  ///< of all poses
  PathResult result = {};
  std::int64_t evaluations = 0;  ///< of each layer

  double each() const { return seconds / static_cast<double>(evaluations); }
};

Case make_case(const std::string& name, const std::string& text, const std::shared_ptr<MeshLibrary>& meshes) {
  Diagnostics out;
  std::optional<Prepared> p;
  if (auto scene = parse_scene(text, name, out)) p = prepare(std::move(*scene), meshes, out);
  if (!p)
    for (const Diagnostic& d : out.items()) fmt::print(stderr, "{}\n", to_string(d));
  if (!p) std::exit(1);
  return {name, std::move(*p)};
}

void measure(Case& c) {
  ContactField field(c.prepared.model);
  c.prepared.model.meter = std::make_shared<EffectMeter>();
  c.path.clear();
  PathObserver observer;
  observer.pose = [&](const PosePoint& point, LayerMemories*) {
    if (point.solved()) c.path.push_back(point.pose.state);
  };
  const double before = seconds_of_this_thread();
  c.result = follow_path(c.prepared.model, field, c.prepared.steps, {}, observer);
  const double taken = seconds_of_this_thread() - before;
  c.evaluations =
      c.prepared.model.meter->evaluations(Effect::layers) / static_cast<std::int64_t>(c.prepared.model.layers.size());
  c.seconds = c.seconds > 0 ? std::min(c.seconds, taken) : taken;
}

bool is_tendon(const std::string& ligament) { return ligament.starts_with("PT"); }

/// What the patellar tendon exerts on the tibia at poses of the whole knee: force and moment (N, N m) about the tibia's
/// origin, in its axes. `tendon`: a knee with no other force.
std::vector<Vec6> pulls(const JointModel& whole, const JointModel& tendon, const Path& path) {
  std::vector<Vec6> out;
  Linearization memory;
  for (const State& there : path) {
    State state = start_state(tendon);
    state.coordinates = there.coordinates;
    state.poses = poses_from_coordinates(tendon, there.coordinates);
    state.wraps.clear();
    std::size_t wrap = 0;
    for (const JointModel::Ligament& ligament : whole.ligaments)
      for (std::size_t k = 0; k < ligament.path.obstacles().size(); ++k, ++wrap)
        if (is_tendon(ligament.name)) state.wraps.push_back(there.wraps[wrap]);
    out.push_back(-unbalanced(tendon, state, {}, memory).wrenches[0]);
  }
  return out;
}

/// Loads on the tibia that are such pulls over flexion.
std::string as_loads(const std::vector<Vec6>& pulls, const Path& path) {
  std::string out;
  for (Eigen::Index i = 0; i < 6; ++i) {
    std::array<int, 3> direction{};
    direction[static_cast<std::size_t>(i % 3)] = 1;
    std::string table;
    for (std::size_t row = 0; row < path.size(); ++row)
      table += fmt::format("{}[{:.17g}, {:.17g}]", row > 0 ? ", " : "", to::kDegree * path[row].coordinates[0][0],
                           pulls[row][i]);
    out += fmt::format(
        "[load.tendon_{}]\nbody = \"tibia\"\nframe = \"body\"\n{} = [{}, {}, {}]\nscale = {{ over = \"knee.flexion\", "
        "table = [{}] }}\n",
        i, i < 3 ? "force" : "moment", direction[0], direction[1], direction[2], table);
  }
  return out;
}

/// The largest difference of coordinates of a joint of both, m or rad.
double difference(const State& a, const State& b, std::size_t joint_a, std::size_t joint_b) {
  double worst = 0;
  for (std::size_t i = 0; i < 6; ++i)
    worst = std::max(worst, std::abs(a.coordinates[joint_a][i] - b.coordinates[joint_b][i]));
  return worst;
}

}  // namespace

int main() {
  if (!std::filesystem::exists(genu::test::data_path("lenhart2015/ACLC01-R-patella-cart_shift.stl"))) return kSkipped;
  const tbb::global_control one_core(tbb::global_control::max_allowed_parallelism, 1);
  const auto meshes = std::make_shared<MeshLibrary>();
  const std::string text = knee_text();
  std::vector<Case> cases;
  cases.push_back(make_case("whole", text, meshes));
  measure(cases[0]);
  const Path path = cases[0].path;
  if (path.size() != kRows) return fmt::print("the whole: {} of {} poses are solved\n", path.size(), kRows), 1;
  const std::vector<std::string> of_tibia = {"contact.tibiofemoral", "ligament.MCL", "ligament.ACL", "ligament.PCL",
                                             "ligament.LCL",         "ligament.PFL", "ligament.pCAP"};
  const std::string patella = without(text, of_tibia);
  const Case tendon = make_case(
      "tendon", without(patella, {"contact.patellofemoral", "ligament.lPFL", "ligament.mPFL", "load."}), meshes);
  const std::string tibia = without(text, {"body.patella"});
  const std::size_t steps = tibia.find("[[step]]");
  const std::string loads = as_loads(pulls(cases[0].prepared.model, tendon.prepared.model, path), path);
  cases.push_back(make_case("tibia on femur", tibia.substr(0, steps) + loads + tibia.substr(steps), meshes));
  cases.push_back(make_case("patella on femur", tibia_moved(patella, path), meshes));
  for (int round = 0; round < kRounds; ++round)
    for (Case& c : cases) measure(c);
  bool good = true;
  for (const Case& c : cases) {
    fmt::print("{:<18} {:6.3f} s for {} poses, {:4} evaluations of {:3.0f} us, {:3} substeps\n", c.name, c.seconds,
               c.path.size(), c.evaluations, 1e6 * c.each(), c.result.substeps);
    good = good && c.path.size() == kRows;
  }
  if (!good) return 1;
  double tibia_off = 0;
  for (std::size_t row = 0; row < path.size(); ++row)
    tibia_off = std::max(tibia_off, difference(cases[1].path[row], path[row], 0, 0));
  const double patella_off = std::max(difference(cases[2].path.front(), path.front(), 1, 1),
                                      difference(cases[2].path.back(), path.back(), 1, 1));
  fmt::print("poses within {:.1e} m and rad (tibia) and {:.1e} (patella) of the whole's\n", tibia_off, patella_off);
  const double of_pose = cases[0].seconds / (cases[1].seconds + cases[2].seconds),
               of_evaluation = cases[0].each() / (cases[1].each() + cases[2].each());
  fmt::print("the whole over the sum of its parts: {:.2f} an evaluation, {:.2f} a pose\n", of_evaluation, of_pose);
  return std::max(tibia_off, patella_off) <= kSamePose && of_evaluation <= kMostOfParts ? 0 : 1;
}
