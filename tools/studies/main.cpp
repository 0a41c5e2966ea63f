// studies MESHES: solves the studies of the knees under MESHES (the project's meshes/) and writes their tables and
// charts into the knees' folders, and a picture of bones that were made from shapes.
#include <cstdio>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include "studies/bones_picture.h"
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
    std::fputs(
        "studies MESHES: writes the tables and charts of dortmans1984 and wismans1980, a picture of leskovar2019\n",
        stderr);
    return 2;
  }
  const std::string meshes = argv[1], dortmans = meshes + "/dortmans1984", wismans = meshes + "/wismans1980";
  const std::string leskovar = meshes + "/leskovar2019";
  genu::Diagnostics problems;
  const auto readings = genu::studies::solve_dortmans(dortmans, problems);
  const auto laxity = genu::studies::solve_laxity(wismans + "/scene.toml", problems);
  const Files bones = genu::studies::bones_files(leskovar, problems);
  for (const genu::Diagnostic& d : problems.items()) fmt::print(stderr, "{}\n", to_string(d));
  if (problems.has_errors() || !laxity) return 2;
  const bool written = write(dortmans, genu::studies::dortmans_files(readings)) &&
                       write(wismans, genu::studies::laxity_files(*laxity)) && write(leskovar, bones);
  return written ? 0 : 1;
}
