// build/bin/bench_pose [--benchmark_out=FILE --benchmark_out_format=json]
//   1. the dense 17 x 17 solve of a pose with two contacts, as a yardstick for the machine
//   2. warm poses of Dortmans' knee, a degree apart, in parts: closed form, then meshes of 1e3 to 1e6 triangles
//   3. reading an STL file and building its surface, for a triangle
//   4. a table of the ratios
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <random>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <Eigen/LU>

#include "bench_knee.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/mesh_files/stl_writer.h"

namespace genu::bench {
namespace {

constexpr std::size_t kSizes[] = {1'000, 10'000, 100'000, 1'000'000};

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// 6 + M + 5 N with one prescribed coordinate and two contacts.
void dense_solve(benchmark::State& state) {
  using Matrix = Eigen::Matrix<double, 17, 17>;
  using Vector = Eigen::Matrix<double, 17, 1>;
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  Matrix A = Matrix::NullaryExpr([&] { return unit(generator); });
  const Vector b = Vector::NullaryExpr([&] { return unit(generator); });
  for (auto _ : state) {
    benchmark::DoNotOptimize(A);
    const Vector x = Eigen::PartialPivLU<Matrix>(A).solve(b);
    benchmark::DoNotOptimize(x);
  }
}

/// Only one knee is kept, so that a large one does not weigh on the next.
BenchKnee& knee(std::size_t triangles) {
  static std::size_t kept = SIZE_MAX;
  static std::unique_ptr<BenchKnee> one;
  if (kept != triangles) {
    one.reset();
    one = std::make_unique<BenchKnee>(triangles);
    kept = triangles;
  }
  return *one;
}

void note(benchmark::State& state, const BenchKnee& k) {
  if (k.triangles() == 0) return;
  state.counters["triangles"] = static_cast<double>(k.triangles());
  state.counters["build_us_per_triangle"] = 1e6 * k.build_seconds() / (2 * static_cast<double>(k.triangles()));
  state.counters["search_us_per_triangle"] = 1e6 * k.search_seconds() / (2 * static_cast<double>(k.triangles()));
  state.counters["peak_MB"] = peak_memory_mb();
}

/// Part of the work of the poses from 31 to 60 deg, a pose.
using Part = bool (BenchKnee::*)();
void part_of_pose(benchmark::State& state, std::size_t triangles, Part part) {
  BenchKnee& k = knee(triangles);
  if (!k.good()) return state.SkipWithError("the knee was not solved");
  note(state, k);
  while (state.KeepRunningBatch(BenchKnee::kPoses))
    if (!(k.*part)()) return state.SkipWithError("a degree was not solved in one step");
  if (part == &BenchKnee::solve) state.counters["iterations"] = k.iterations();
}

void read_stl(benchmark::State& state, std::size_t triangles) {
  const Mesh mesh = torus_mesh(0.015, 0.005, triangles);
  const std::string file =
      (std::filesystem::temp_directory_path() / fmt::format("genu-bench-{}.stl", getpid())).string();
  if (const std::string error = write_stl(mesh, file, 1e-3, "bench"); !error.empty())
    return state.SkipWithError(error.c_str());
  for (auto _ : state) {
    Diagnostics problems;
    if (!read_mesh(file, 1e-3, problems)) return state.SkipWithError("the file was not read");
  }
  std::filesystem::remove(file);
  state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
}

/// Remembers what was measured for the last table.
class Reporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      // Of repetitions, the median.
      failed_ = failed_ || run.error_occurred;
      if (run.error_occurred || (run.run_type == Run::RT_Aggregate && run.aggregate_name != "median")) continue;
      measured_[run.run_name.function_name] = run;
    }
  }

  bool failed() const { return failed_; }

  void print_ratios() const {
    const auto dense = measured_.find("dense_17x17");
    if (dense == measured_.end()) return;
    const double unit = microseconds(dense->second);
    fmt::print("\n{:<28} {:>12} {:>14} {:>16}\n", "", "us", "dense solves", "us a triangle");
    for (const auto& [name, run] : measured_) {
      const auto triangles = run.counters.find("triangles");
      const bool whole_mesh = name.starts_with("read_stl") && triangles != run.counters.end();
      fmt::print("{:<28} {:>12.2f} {:>14.1f} {:>16}\n", name, microseconds(run), microseconds(run) / unit,
                 whole_mesh ? fmt::format("{:.3f}", microseconds(run) / triangles->second.value) : "");
      const auto build = run.counters.find("build_us_per_triangle");
      if (build == run.counters.end()) continue;
      fmt::print("{:<28} {:>12} {:>14} {:>16.3f}\n", "  building the surface", "", "", build->second.value);
      fmt::print("{:<28} {:>12} {:>14} {:>16.3f}\n", "  preparing the search", "", "",
                 run.counters.at("search_us_per_triangle").value);
    }
  }

 private:
  static double microseconds(const Run& run) {
    return 1e6 * run.GetAdjustedRealTime() / benchmark::GetTimeUnitMultiplier(run.time_unit);
  }

  std::map<std::string, Run> measured_;
  bool failed_ = false;
};

}  // namespace
}  // namespace genu::bench

int main(int argc, char** argv) {
  using namespace genu::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RegisterBenchmark("dense_17x17", dense_solve)->Unit(benchmark::kMicrosecond);
  const auto add = [](const std::string& name, std::size_t triangles, Part part) {
    benchmark::RegisterBenchmark(name.c_str(), part_of_pose, triangles, part)->Unit(benchmark::kMicrosecond);
  };
  const auto add_all = [&](const std::string& name, std::size_t triangles) {
    add("solve_" + name, triangles, &BenchKnee::solve);
    add("certificate_" + name, triangles, &BenchKnee::certify);
    add("stability_" + name, triangles, &BenchKnee::judge_stability);
    add("pose_" + name, triangles, &BenchKnee::follow);
  };
  add_all("closed_form", 0);
  for (const std::size_t size : kSizes) {
    const std::string name = fmt::format("mesh_{:.0e}", static_cast<double>(size));
    add_all(name, size);
    benchmark::RegisterBenchmark(("read_stl_" + name).c_str(), read_stl, size)->Unit(benchmark::kMillisecond);
  }
  Reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  reporter.print_ratios();
  return reporter.failed() ? 1 : 0;
}
