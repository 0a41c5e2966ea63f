// build/bin/bench_candidates: what it costs to find where two surfaces are near, along the poses of paths: genu's tree
// of samples, which remembers what was clear, beside FCL's trees of boxes (OBBRSS) over the same surfaces' triangles,
// from the root and with a front list. FCL's answer is pairs of triangles near enough to hold a contact; genu's is
// samples with their gaps to the smooth surface, which FCL's pairs would still need. Prints a table (docs/measured.md).
// Fails where a sample that genu finds lies on no triangle of FCL's pairs. Scenes without their public data are left
// out. Takes 100 s.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/detail/traversal/collision/bvh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/traversal_recurse.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include "genu/assemble/prepare.h"
#include "genu/contact/proximity.h"
#include "genu/contact/tolerances.h"
#include "genu/mesh/nearest_point.h"
#include "genu/model/contact_field.h"
#include "genu/model/tolerances.h"
#include "genu/path/path.h"
#include "support/data.h"
#include "support/places.h"

namespace {

using namespace genu;

constexpr int kRounds = 3;
constexpr double kRenewed = 2;  // a front list that has grown so much is made again

double seconds_of_this_thread() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

using Boxes = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Boxes> boxes_of(const Mesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles) triangles.emplace_back(at(t[0]), at(t[1]), at(t[2]));
  auto boxes = std::make_shared<Boxes>();
  boxes->beginModel(static_cast<int>(triangles.size()), static_cast<int>(mesh.vertices.size()));
  boxes->addSubModel(mesh.vertices, triangles);
  boxes->endModel();
  return boxes;
}

/// All pairs of triangles whose boxes, those of the first wider by `room` (m), overlap.
class NearPairs final : public fcl::detail::BVHCollisionTraversalNode<fcl::OBBRSSd> {
 public:
  NearPairs(const Mesh& first, const Mesh& second, double room) : first_(boxes_of(first)), second_(boxes_of(second)) {
    for (int k = 0; k < first_->getNumBVs(); ++k) first_->getBV(k).bv.obb.extent.array() += room;
    model1 = first_.get();
    model2 = second_.get();
    marked_.assign(second.triangles.size(), false);
  }

  void find(const Pose& second_in_first, bool with_front) {
    for (const int t : found) marked_[at(t)] = false;
    found.clear();
    R_ = second_in_first.R;
    p_ = second_in_first.p;
    if (!with_front) return fcl::detail::collisionRecurse<double>(this, 0, 0, nullptr);
    if (!front_.empty() && front_.size() < kRenewed * static_cast<double>(fresh_))
      return fcl::detail::propagateBVHFrontListCollisionRecurse<double>(this, &front_);
    front_.clear();
    fcl::detail::collisionRecurse<double>(this, 0, 0, &front_);
    fresh_ = front_.size();
  }

  bool BVTesting(int b1, int b2) const override {
    return !fcl::overlap(R_, p_, first_->getBV(b1).bv.obb, second_->getBV(b2).bv.obb);
  }

  void leafTesting(int /*b1*/, int b2) const override {
    const int t = second_->getBV(b2).primitiveId();
    if (marked_[at(t)]) return;
    marked_[at(t)] = true;
    found.push_back(t);
  }

  bool canStop() const override { return false; }

  mutable std::vector<int> found;  ///< triangles of the second

 private:
  std::shared_ptr<Boxes> first_, second_;
  Mat3 R_ = Mat3::Identity();
  Vec3 p_ = Vec3::Zero();
  mutable std::vector<char> marked_;
  fcl::detail::BVHFrontList front_;
  std::size_t fresh_ = 0;
};

/// One pair of surfaces, at the relative poses of a path: of the sampled surface in the frame of the queried one.
struct Meeting {
  Proximity own;
  Mesh sampled, queried;
  std::vector<Pose> X_ab, X_qs;
  double window = 0, spacing = 0;
};

std::vector<Meeting> meetings(const Prepared& prepared) {
  const JointModel& model = prepared.model;
  ContactField field(model);
  std::vector<State> states;
  PathObserver observer;
  observer.pose = [&](const PosePoint& point, LayerMemories*) {
    if (point.solved()) states.push_back(point.pose.state);
  };
  follow_path(model, field, prepared.steps, {}, observer);
  std::vector<Meeting> out;
  for (const JointModel::Pair& pair : model.pairs) {
    const Vec3 centre = joint_centre(model);
    Proximity::Options options;
    options.spacing = field.spacing();
    options.reach = kSamplingReach * model.scales.length;
    options.centre_a = model.reference_poses[at(pair.body_a)].inverse() * centre;
    options.centre_b = model.reference_poses[at(pair.body_b)].inverse() * centre;
    Proximity own(*pair.a, *pair.b, options);
    const Mesh a = pair.a->triangles(options.spacing, options.centre_a, options.reach);
    const Mesh b = pair.b->triangles(options.spacing, options.centre_b, options.reach);
    const bool samples_b = own.samples_b();
    Meeting meeting{std::move(own), samples_b ? b : a, samples_b ? a : b, {}, {}, field.window(), field.spacing()};
    for (const State& s : states) {
      meeting.X_ab.push_back(s.poses[at(pair.body_a)].inverse() * s.poses[at(pair.body_b)]);
      meeting.X_qs.push_back(samples_b ? meeting.X_ab.back() : meeting.X_ab.back().inverse());
    }
    out.push_back(std::move(meeting));
  }
  return out;
}

enum Way { samples, fresh_boxes, front_boxes, ways };

/// s a path, each way.
using Seconds = std::array<double, ways>;

template <typename Look>
double along(const std::vector<Pose>& path, Look look) {
  const double before = seconds_of_this_thread();
  for (const Pose& X : path) look(X);
  return seconds_of_this_thread() - before;
}

/// Whether every sample that is near lies on a triangle of FCL's, to within a spacing.
bool all_found(const Meeting& m, const NearPairs& fcl, const std::vector<NearSample>& near) {
  return std::all_of(near.begin(), near.end(), [&](const NearSample& sample) {
    return std::any_of(fcl.found.begin(), fcl.found.end(), [&](int t) {
      const auto& v = m.sampled.triangles[at(t)];
      const Vec3 foot = nearest_on_triangle(sample.point, m.sampled.vertices[at(v[0])], m.sampled.vertices[at(v[1])],
                                            m.sampled.vertices[at(v[2])]);
      return (foot - sample.point).norm() < m.spacing;
    });
  });
}

bool measure(Meeting& m, Seconds& seconds) {
  const double room = m.window + 2 * kShallowOverlap * m.spacing;  // facets deviate from the smooth surfaces
  NearPairs boxes(m.queried, m.sampled, room);
  std::vector<NearSample> near;
  bool good = true;
  std::size_t samples_near = 0;
  m.own.forget();
  for (std::size_t k = 0; k < m.X_ab.size(); ++k) {
    m.own.near_samples(m.X_ab[k], m.window, near);
    boxes.find(m.X_qs[k], true);
    good = good && all_found(m, boxes, near);
    samples_near += near.size();
  }
  good = good && samples_near > 0;
  Seconds best;
  best.fill(1e9);
  for (int round = 0; round < kRounds; ++round) {
    m.own.forget();
    best[samples] =
        std::min(best[samples], along(m.X_ab, [&](const Pose& X) { m.own.near_samples(X, m.window, near); }));
    best[fresh_boxes] = std::min(best[fresh_boxes], along(m.X_qs, [&](const Pose& X) { boxes.find(X, false); }));
    NearPairs with_front(m.queried, m.sampled, room);
    best[front_boxes] = std::min(best[front_boxes], along(m.X_qs, [&](const Pose& X) { with_front.find(X, true); }));
  }
  for (std::size_t w = 0; w < seconds.size(); ++w) seconds[w] += best[w];
  return good;
}

struct Case {
  const char *name, *file;
  const char* data;  ///< a file that it needs; empty: none
};

/// Whether it was measured well, or needs data that is not there.
bool row(const Case& scene) {
  if (*scene.data != 0 && !std::filesystem::exists(genu::test::data_path(scene.data))) {
    fmt::print("| {} | left out: its data is not there | | | | |\n", scene.name);
    return true;
  }
  Diagnostics out;
  const auto prepared = prepare(genu::test::source_folder() + "/meshes/" + scene.file, out);
  if (!prepared) {
    for (const Diagnostic& d : out.items()) fmt::print(stderr, "{}\n", to_string(d));
    return false;
  }
  Seconds seconds{};
  bool good = true;
  std::size_t triangles = 0, poses = 0;
  for (Meeting& meeting : meetings(*prepared)) {
    good = measure(meeting, seconds) && good;
    triangles += meeting.sampled.triangles.size() + meeting.queried.triangles.size();
    poses = meeting.X_ab.size();
  }
  good = good && poses > 0;
  const auto each = [&](Way way) { return 1e6 * seconds[way] / static_cast<double>(poses); };
  fmt::print("| {} | {} | {:.0f} | {:.0f} | {:.0f} | {:.1f} |{}\n", scene.name, triangles, each(samples),
             each(fresh_boxes), each(front_boxes), std::min(each(fresh_boxes), each(front_boxes)) / each(samples),
             good ? "" : " NO POSE, NO SAMPLE OR ONE MISSED");
  std::fflush(stdout);
  return good;
}

}  // namespace

/// `bench_candidates NAME`: the scenes with this in their names.
int main(int count, char** arguments) {
  const std::string asked = count > 1 ? arguments[1] : "";
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  fmt::print("| candidates, us a pose | triangles | samples, with their gaps | boxes | boxes, front list | ratio |\n");
  fmt::print("|---|---:|---:|---:|---:|---:|\n");
  bool good = true, any = false;
  for (const Case& scene : {Case{"simplified knee, closed forms", "dortmans1984/scene.toml", ""},
                            Case{"knee of polynomials", "lenhart_polynomial/scene.toml", ""},
                            Case{"Wismans' knee, laxity tests", "wismans1980/scene.toml", ""},
                            Case{"measured knee", "lenhart2015/scene.toml", "lenhart2015"},
                            Case{"shape-model knee", "clouthier2019/mean-rigid.toml", "ssm"},
                            Case{"measured knee with patella", "lenhart2015_whole/scene-rigid.toml", "lenhart2015"}}) {
    if (std::string(scene.name).find(asked) == std::string::npos) continue;
    any = true;
    good = row(scene) && good;
  }
  return good && any ? 0 : 1;
}
