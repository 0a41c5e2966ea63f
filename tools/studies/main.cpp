// studies MESHES: solves the studies of the knees under MESHES (the project's meshes/) and writes their tables and
// charts into the knees' folders, and a picture of bones that were made from shapes.
// studies wrapping MESHES: the study of lenhart2015, whose meshes are not part of the project, alone.
// studies menisci MESHES: the same of smith2019.
// studies family MESHES SEEDS: searches the lost numbers of dortmans1984 from so many seeds, some minutes each.
// studies points DATA OUT: writes the points that the polynomials of wismans1980 are fitted to (tools/refit).
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include "studies/articular_points.h"
#include "studies/bones_picture.h"
#include "studies/cells_study.h"
#include "studies/dortmans_family.h"
#include "studies/dortmans_study.h"
#include "studies/driven_study.h"
#include "studies/laxity_study.h"
#include "studies/menisci_study.h"
#include "studies/wrapping_study.h"

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

int print_errors(const genu::Diagnostics& problems) {
  for (const genu::Diagnostic& d : problems.items()) fmt::print(stderr, "{}\n", to_string(d));
  return problems.has_errors() ? 2 : 0;
}

int write_family(const std::string& meshes, int seeds) {
  constexpr int kGenerations = 300;
  genu::Diagnostics problems;
  const std::string folder = meshes + "/dortmans1984";
  const Files family = genu::studies::searched_family(folder, seeds, kGenerations, problems);
  if (const int refused = print_errors(problems)) return refused;
  return write(folder, family) ? 0 : 1;
}

int write_points(const std::string& data, const std::string& out) {
  genu::Diagnostics problems;
  const Files points = genu::studies::articular_points(data, problems);
  if (const int refused = print_errors(problems)) return refused;
  return write(out, points) ? 0 : 1;
}

int write_wrapping(const std::string& meshes) {
  genu::Diagnostics problems;
  const std::string folder = meshes + "/lenhart2015";
  const auto study = genu::studies::solve_wrapping(folder, problems);
  if (const int refused = print_errors(problems)) return refused;
  return study && write(folder, genu::studies::wrapping_files(*study)) ? 0 : 1;
}

int write_menisci(const std::string& meshes) {
  genu::Diagnostics problems;
  const std::string folder = meshes + "/smith2019";
  const auto study = genu::studies::solve_menisci(folder, meshes + "/leskovar2019", problems);
  if (const int refused = print_errors(problems)) return refused;
  return study && write(folder, genu::studies::menisci_files(*study)) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::string(argv[1]) == "family") return write_family(argv[2], std::atoi(argv[3]));
  if (argc == 4 && std::string(argv[1]) == "points") return write_points(argv[2], argv[3]);
  if (argc == 3 && std::string(argv[1]) == "wrapping") return write_wrapping(argv[2]);
  if (argc == 3 && std::string(argv[1]) == "menisci") return write_menisci(argv[2]);
  if (argc != 2) {
    std::fputs(
        "studies MESHES: writes the tables and charts of dortmans1984 and wismans1980, a picture of leskovar2019\n"
        "studies wrapping MESHES: writes the table and chart of lenhart2015, whose meshes it needs\n"
        "studies menisci MESHES: the same of smith2019\n"
        "studies family MESHES SEEDS: searches the lost numbers of dortmans1984\n"
        "studies points DATA OUT: writes the points that the polynomials of wismans1980 are fitted to\n",
        stderr);
    return 2;
  }
  const std::string meshes = argv[1], dortmans = meshes + "/dortmans1984", wismans = meshes + "/wismans1980";
  const std::string leskovar = meshes + "/leskovar2019";
  genu::Diagnostics problems;
  const auto readings = genu::studies::solve_dortmans(dortmans, problems);
  const auto laxity = genu::studies::solve_laxity(wismans + "/scene.toml", problems);
  const Files family = genu::studies::family_files(dortmans, problems);
  const std::string polynomial = meshes + "/lenhart_polynomial";
  const auto cells = genu::studies::solve_cells(polynomial, problems);
  const auto driven = genu::studies::solve_driven(leskovar, problems);
  const Files bones = genu::studies::bones_files(leskovar, problems);
  if (print_errors(problems) != 0 || !laxity || !driven) return 2;
  const bool written = write(dortmans, genu::studies::dortmans_files(readings)) && write(dortmans, family) &&
                       write(polynomial, genu::studies::cells_files(cells)) &&
                       write(wismans, genu::studies::laxity_files(*laxity)) && write(leskovar, bones) &&
                       write(leskovar, genu::studies::driven_files(*driven));
  return written ? 0 : 1;
}
