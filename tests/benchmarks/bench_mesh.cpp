// Reads, welds and examines a binary STL of five million triangles (or as many as the first argument says), and prints
// how long each took and how much memory at most: build/bin/bench_mesh. Exit code 1 where it took more than 4 GB.
#include <cmath>
#include <cstdlib>
#include <string>

#include <fmt/format.h>
#include <sys/resource.h>

#include "genu/core/timer.h"
#include "genu/mesh_care/mesh_examination.h"
#include "genu/mesh_files/stl_writer.h"
#include "support/temporary_folder.h"

namespace {

constexpr double kMost = 4e9;  // bytes

/// A torus of about `triangles` triangles, as a grid.
genu::Mesh torus(double triangles) {
  const int nv = static_cast<int>(std::sqrt(triangles / 5)), nu = static_cast<int>(triangles / 2 / nv);
  genu::Mesh mesh;
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const double a = 2 * M_PI * i / nu, b = 2 * M_PI * j / nv, r = 0.03 + 0.012 * std::cos(b);
      mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), 0.012 * std::sin(b));
    }
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const int a = j * nu + i, b = j * nu + (i + 1) % nu, up = (j + 1) % nv * nu;
      mesh.triangles.push_back({a, b, up + (i + 1) % nu});
      mesh.triangles.push_back({a, up + (i + 1) % nu, up + i});
    }
  return mesh;
}

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace

int main(int argc, char** argv) {
  const double triangles = argc > 1 ? std::atof(argv[1]) : 5e6;
  const genu::test::TemporaryFolder folder;
  const std::string path = folder / "large.stl";
  if (const std::string error = write_stl(torus(triangles), path, 1e-3, "bench_mesh"); !error.empty()) {
    fmt::print(stderr, "{}\n", error);
    return 1;
  }
  genu::Diagnostics out;
  genu::MeshFileFacts facts;
  const genu::Timer timer;
  const auto mesh = genu::read_mesh(path, 1e-3, out, &facts);
  if (!mesh) return 1;
  const double read = timer.seconds(), after_reading = peak_bytes();
  const auto examination = genu::examine_mesh(*mesh, facts, 1e-3);
  fmt::print(
      "{} triangles, {} vertices: read and welded in {:.1f} s, at most {:.2f} GB; examined in {:.1f} s, at most "
      "{:.2f} GB; {}\n",
      facts.triangles, mesh->vertices.size(), read, 1e-9 * after_reading, timer.seconds() - read, 1e-9 * peak_bytes(),
      examination.bad() ? "BAD" : "nothing bad");
  return peak_bytes() < kMost && !examination.bad() ? 0 : 1;
}
