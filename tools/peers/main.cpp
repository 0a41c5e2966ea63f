// What tools/compare-peers asks of genu:
//   peers knee SCENE FILE             the knee for the other programs
//   peers solve SCENE FOLDER|- OUT    genu's own poses, with the meshes in FOLDER or in closed form
//   peers layers SCENE FOLDER OUT K [plain]  the same with layers of K N/mm3 on the meshes, or those of OpenSim-JAM
//   peers table SCENE REFERENCE ROWS  the table; a line of ROWS: software, contact, triangles and files of poses, with
//   tabs
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "peers/judge.h"

namespace genu::peers {
namespace {

int fail(const std::string& error) {
  if (error.empty()) return 0;
  fmt::print(stderr, "peers: {}\n", error);
  return 1;
}

/// Of one line of ROWS; what goes wrong is added to `error`.
Row read_row(const std::string& line, const Prepared& prepared, const FoundPath& reference, std::string& error) {
  Row row;
  std::istringstream cells(line);
  std::string triangles, file;
  std::getline(cells, row.software, '\t');
  std::getline(cells, row.contact, '\t');
  std::getline(cells, triangles, '\t');
  row.triangles = std::atoi(triangles.c_str());
  row.poses = judge(prepared, {}, reference);
  while (std::getline(cells, file, '\t')) {
    FoundPath found;
    error += read_path(file, found);
    row.seconds.push_back(found.seconds);
    row.poses = judge(prepared, found, reference);
  }
  return row;
}

int print_table(const Prepared& prepared, const std::string& reference_file, const std::string& rows_file) {
  FoundPath reference;
  std::string error = read_path(reference_file, reference), line;
  std::vector<Row> rows;
  std::ifstream in(rows_file);
  if (!in) error = rows_file + ": cannot be read";
  while (error.empty() && std::getline(in, line)) rows.push_back(read_row(line, prepared, reference, error));
  if (error.empty()) std::fputs(to_text(rows).c_str(), stdout);
  return fail(error);
}

int solve_layers(const std::string& scene, const std::string& folder, const std::string& out, const Layers& layers) {
  Diagnostics problems;
  const auto prepared = prepare_layers(scene, folder, layers, problems);
  for (const Diagnostic& d : problems.items()) fmt::print(stderr, "{}\n", to_string(d));
  return prepared ? fail(write_path(solve_path(*prepared), out)) : 2;
}

int run(const std::string& command, const std::string& scene, const std::string& second, const std::string& third) {
  Diagnostics problems;
  const auto prepared = prepare_knee(scene, command == "solve" && second != "-" ? second : "", problems);
  const auto knee = prepared ? make_knee(*prepared, problems) : std::nullopt;
  for (const Diagnostic& d : problems.items()) fmt::print(stderr, "{}\n", to_string(d));
  if (!knee) return 2;
  if (command == "knee") return fail(write_knee(*knee, second));
  if (command == "solve") return fail(write_path(solve_path(*prepared), third));
  return print_table(*prepared, second, third);
}

}  // namespace
}  // namespace genu::peers

int main(int argc, char** argv) {
  const std::string command = argc > 1 ? argv[1] : "";
  if ((command == "knee" && argc == 4) || ((command == "solve" || command == "table") && argc == 5))
    return genu::peers::run(command, argv[2], argv[3], argc > 4 ? argv[4] : "");
  const double stiffness = command == "layers" && argc > 5 ? 1e9 * std::atof(argv[5]) : 0;
  const bool plain = argc == 7 && std::string(argv[6]) == "plain";
  if (stiffness > 0 && (argc == 6 || plain))
    return genu::peers::solve_layers(argv[2], argv[3], argv[4], {stiffness, plain});
  std::fputs(
      "peers knee SCENE FILE | peers solve SCENE FOLDER|- OUT | peers layers SCENE FOLDER OUT K [plain] | peers table "
      "SCENE REFERENCE ROWS\n",
      stderr);
  return 2;
}
