// studies MESHES: solves the studies of the knees under MESHES (the project's meshes/) and writes their tables and
// charts into the knees' folders.
#include <cstdio>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include "studies/dortmans_study.h"
#include "studies/laxity_study.h"

namespace {

using genu::studies::Files;

bool write(const std::string& folder, const Files& files) {
  for (const auto& [name, text] : files) {
    const std::string path = folder + "/" + name;
    std::ofstream out(path, std::ios::binary);
    out << text;
    out.close();
    if (!out) {
      fmt::print(stderr, "studies: {} cannot be written\n", path);
      return false;
    }
    fmt::print("{}\n", path);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("studies MESHES: writes the tables and charts of meshes/dortmans1984 and meshes/wismans1980\n", stderr);
    return 2;
  }
  const std::string meshes = argv[1], dortmans = meshes + "/dortmans1984", wismans = meshes + "/wismans1980";
  genu::Diagnostics problems;
  const auto readings = genu::studies::solve_dortmans(dortmans, problems);
  const auto laxity = genu::studies::solve_laxity(wismans + "/scene.toml", problems);
  for (const genu::Diagnostic& d : problems.items()) fmt::print(stderr, "{}\n", to_string(d));
  if (problems.has_errors() || !laxity) return 2;
  const bool written =
      write(dortmans, genu::studies::dortmans_files(readings)) && write(wismans, genu::studies::laxity_files(*laxity));
  return written ? 0 : 1;
}
