// build/bin/bench_many [POSES]: many independent warm poses of Dortmans' knee at 30 deg, each with springs of its own
// (stiffness and reference strain of each within 10 and 2 %, ends within 0.5 mm), on one core and on two: time a pose,
// parallel efficiency, memory. It fails if anything is allocated in the loop, or if one core and two differ in a bit.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <new>
#include <random>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "genu/assemble/prepare.h"
#include "genu/core/timer.h"
#include "genu/core/units.h"
#include "genu/equilibrium/active_set.h"
#include "genu/study/run_scene.h"
#include "support/places.h"

namespace {
thread_local bool counting = false;
std::atomic<long> allocations{0};
}  // namespace

// NOLINTBEGIN: what replaces the global ones has to look like this. Inlined, GCC would take free() for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (counting) ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
// NOLINTEND

namespace {

using namespace genu;

constexpr int kChunks = 64;  // results are summed chunk by chunk, in this order on any number of cores
constexpr int kBank = 97;    // laws of each spring to draw from

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

double resident_mb() {
  std::ifstream in("/proc/self/statm");
  long pages = 0, resident = 0;
  in >> pages >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// The knee at 30 deg, and laws for its springs.
struct Knee {
  Prepared prepared;
  Target target;
  State pose;
  std::vector<std::vector<LigamentLaw>> laws;  ///< for each spring

  bool prepare();
  bool draw_laws();
};

bool Knee::prepare() {
  Diagnostics problems;
  auto scene = genu::prepare(genu::test::source_folder() + "/meshes/dortmans1984/scene.toml", problems);
  if (!scene) return false;
  prepared = std::move(*scene);
  StepPlan plan;
  const double flexion = 30 * units::kDegree;
  plan.prescribed.push_back({prepared.steps[0].prescribed[0].coordinate, 0, flexion});
  target = plan.target(1);
  ContactField field(prepared.model);
  ActiveSetSolver solver(prepared.model, field, {});
  Balanced balanced;
  balanced.state = reference_state(prepared.model);
  balanced.last_number.assign(prepared.model.pairs.size(), 0);
  if (solver.settle_cold(balanced, plan.target(0)).status != PoseStatus::ok) return false;
  for (int k = 1; k <= 30; ++k)
    if (solver.settle(balanced, plan.target(k / 30.0)).status != PoseStatus::ok) return false;
  pose = balanced.state;
  return draw_laws();
}

bool Knee::draw_laws() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::string why;
  for (const LigamentDef& def : prepared.scene.ligaments) {
    laws.emplace_back();
    const double length = prepared.model.ligaments[laws.size() - 1].path.length(prepared.model.reference_poses);
    for (int k = 0; k < kBank; ++k) {
      LigamentDef drawn = def;
      drawn.numbers[0].value *= 1 + 0.1 * unit(random);
      if (drawn.rest == LigamentDef::Rest::reference_strain) drawn.rest_value += 0.02 * unit(random);
      auto law = make_law(drawn, length, why);
      if (!law) return false;
      laws.back().push_back(std::move(*law));
    }
  }
  return true;
}

/// One thread's own copy of what a pose is solved with.
class Worker {
 public:
  explicit Worker(const Knee& knee) : knee_(&knee), model_(knee.prepared.model), newton_(model_), state_(knee.pose) {
    model_.meter.reset();
  }

  /// Solves one chunk of `poses`; adds to `sum` what was found.
  void solve(int chunk, long poses, double& sum, long& solved) {
    const long first = poses * chunk / kChunks, last = poses * (chunk + 1) / kChunks;
    counting = true;
    for (long i = first; i < last; ++i) {
      choose_springs(static_cast<std::uint64_t>(i));
      state_ = knee_->pose;
      if (!newton_.solve(state_, knee_->target, options_).converged()) continue;
      bool pulls = false;
      for (const ActiveContact& contact : state_.contacts) pulls = pulls || contact.force < 0;
      if (pulls) continue;
      ++solved;
      sum += state_.poses.back().p.sum();
    }
    counting = false;
  }

 private:
  /// Those of pose i, whoever solves it.
  void choose_springs(std::uint64_t i) {
    std::uint64_t bits = i * 0x9e3779b97f4a7c15u + 1;
    const auto next = [&bits] {
      bits ^= bits << 13, bits ^= bits >> 7, bits ^= bits << 17;
      return bits;
    };
    const auto offset = [&] { return 0.5e-3 * (static_cast<double>(next() >> 11) * 0x1p-52 - 1); };
    for (std::size_t k = 0; k < model_.ligaments.size(); ++k) {
      JointModel::Ligament& spring = model_.ligaments[k];
      const LigamentPath& own = knee_->prepared.model.ligaments[k].path;
      spring.law = knee_->laws[k][next() % kBank];
      spring.path.set_point(0, own.from().p + Vec3(offset(), offset(), offset()));
      spring.path.set_point(1, own.to().p + Vec3(offset(), offset(), offset()));
    }
  }

  const Knee* knee_;
  JointModel model_;
  Newton newton_;
  NewtonOptions options_;
  State state_;
};

struct Outcome {
  double seconds = 0, sum = 0;
  long solved = 0;
};

Outcome run(const Knee& knee, int threads, long poses) {
  std::vector<std::unique_ptr<Worker>> workers;
  std::array<double, kChunks> sums{};
  std::array<long, kChunks> solved{};
  for (int t = 0; t < threads; ++t) {
    workers.push_back(std::make_unique<Worker>(knee));
    double warm = 0;
    long none = 0;
    workers.back()->solve(0, kChunks, warm, none);  // memory grows to its size once
  }
  allocations = 0;
  std::atomic<int> next{0};
  const Timer timer;
  std::vector<std::thread> team;
  for (int t = 0; t < threads; ++t)
    team.emplace_back([&, t] {
      for (int chunk = next++; chunk < kChunks; chunk = next++)
        workers[static_cast<std::size_t>(t)]->solve(chunk, poses, sums[static_cast<std::size_t>(chunk)],
                                                    solved[static_cast<std::size_t>(chunk)]);
    });
  for (std::thread& member : team) member.join();
  Outcome out;
  out.seconds = timer.seconds();
  for (const double sum : sums) out.sum += sum;
  for (const long count : solved) out.solved += count;
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  const long poses = argc > 1 ? std::max(static_cast<long>(kChunks), std::atol(argv[1])) : 1'000'000;
  Knee knee;
  if (!knee.prepare()) return fmt::print(stderr, "the knee was not solved\n"), 1;
  run(knee, 2, kChunks);
  const double before = resident_mb();
  const Outcome one = run(knee, 1, poses);
  const long on_one = allocations;
  const Outcome two = run(knee, 2, poses);
  const long on_two = allocations;
  const double grown = resident_mb() - before;
  fmt::print("{} poses, each with springs of its own; {} solved with contacts that press\n", poses, one.solved);
  fmt::print("one core     {:7.2f} s  {:6.2f} us a pose\n", one.seconds,
             1e6 * one.seconds / static_cast<double>(poses));
  fmt::print("two cores    {:7.2f} s  {:6.2f} us a pose, efficiency {:.2f}\n", two.seconds,
             1e6 * two.seconds / static_cast<double>(poses), one.seconds / (2 * two.seconds));
  fmt::print("allocations in the loops {} and {}, memory grown by {:.1f} MB\n", on_one, on_two, grown);
  const bool same = bits(one.sum) == bits(two.sum) && one.solved == two.solved;
  fmt::print("{}\n", same ? "the same on one core and on two, to the last bit" : "one core and two DIFFER");
  return same && on_one == 0 && on_two == 0 && one.solved > poses / 2 && grown < 5 ? 0 : 1;
}
