// genu mesh-check femur.stl tibia.stl
//   1. read each file and say everything there is to say about it, a line each with a number and a verdict
//   2. with --repair OUT: take out what is wrong, fill what is missing, write binary STL in the file's unit
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "commands.h"
#include "genu/core/diagnostics.h"
#include "genu/core/timer.h"
#include "genu/geometry/mesh_examination.h"
#include "genu/geometry/mesh_repair.h"
#include "genu/geometry/mesh_topology.h"
#include "genu/geometry/stl_writer.h"

namespace genu::cli {
namespace {

constexpr int kOk = 0, kFailed = 1, kRefused = 2, kFlawed = 3;

struct CheckOptions {
  std::vector<std::string> files;
  std::string unit, repaired;
};

void print_findings(const MeshExamination& examination) {
  for (const MeshFinding& f : examination.findings) {
    const std::string line = fmt::format("  {:<24}{:<34}{:<5}{}", f.question, f.number, to_string(f.verdict), f.why);
    fmt::print("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
  }
}

/// The unit that was said, else the one that makes it a knee's surface, else mm. `mesh` is in file units.
double unit_of(const Mesh& mesh, const std::string& said) {
  const std::string unit = said.empty() ? guess_unit(bounding_box(mesh).diagonal()) : said;
  return unit == "m" ? 1.0 : 1e-3;
}

int repair(const std::string& from, Mesh mesh, const MeshFileFacts& facts, double unit, const std::string& to) {
  std::error_code ignored;
  if (std::filesystem::equivalent(from, to, ignored)) {
    fmt::print(stderr, "{}: is the file that is mended: give --repair another name\n", to);
    return kRefused;
  }
  const RepairReport r = repair_mesh(mesh);
  if (!r.problem.empty()) {
    fmt::print(stderr, "{}: {}\n", from, r.problem);
    return kRefused;
  }
  if (const std::string error = write_stl(mesh, to, unit, "genu mesh-check --repair"); !error.empty()) {
    fmt::print(stderr, "{}\n", error);
    return kFailed;
  }
  fmt::print(
      "{}: {} triangles taken out, {} turned round, {} holes filled with {} triangles; no vertex that stays was "
      "moved\n",
      to, r.removed, r.turned, r.filled, r.new_triangles);
  if (r.left_open > 0) fmt::print("{}: {} holes could not be filled\n", to, r.left_open);
  MeshFileFacts mended{3 * mesh.triangles.size(), mesh.triangles.size(), {}, facts.rounding};
  mended.weld.joined = mended.vertices - mesh.vertices.size();
  const MeshExamination after = examine_mesh(mesh, mended, unit);
  print_findings(after);
  return after.bad() ? kFlawed : kOk;
}

int check_file(const std::string& file, const CheckOptions& options) {
  Diagnostics out;
  MeshFileFacts facts;
  const Timer timer;
  std::optional<Mesh> mesh = read_mesh(file, 1, out, &facts);
  std::vector<Diagnostic> said = out.items();
  // Read as metres: what is said of lengths there is said below, in the unit found out.
  if (mesh) std::erase_if(said, [](const Diagnostic& d) { return d.severity == Diagnostic::Severity::warning; });
  for (const Diagnostic& d : said) fmt::print(stderr, "{}\n", to_string(d));
  if (!mesh) return kRefused;
  const double unit = unit_of(*mesh, options.unit), seconds = timer.seconds();
  for (Vec3& v : mesh->vertices) v *= unit;
  facts.rounding *= unit;
  fmt::print("{}: read in {:.2f} s; units {}{}\n", printable(file), seconds, unit == 1 ? "m" : "mm",
             options.unit.empty() ? " (guessed from the size)" : "");
  const MeshExamination examination = examine_mesh(*mesh, facts, unit);
  print_findings(examination);
  if (!options.repaired.empty()) return repair(file, std::move(*mesh), facts, unit, options.repaired);
  return examination.bad() ? kFlawed : kOk;
}

int check_files(const CheckOptions& options) {
  if (!options.repaired.empty() && options.files.size() > 1) {
    fmt::print(stderr, "genu mesh-check: --repair mends one file at a time\n");
    return kRefused;
  }
  // What is refused counts most, then what could not be written, then flaws.
  int worst = kOk;
  for (const std::string& file : options.files) {
    const int code = check_file(file, options);
    const auto rank = [](int c) { return c == kRefused ? 3 : c == kFailed ? 2 : c == kFlawed ? 1 : 0; };
    if (rank(code) > rank(worst)) worst = code;
  }
  return worst;
}

}  // namespace

void add_mesh_check(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      app.add_subcommand("mesh-check", "Say what is wrong with mesh files, and mend them: genu mesh-check femur.stl");
  command->add_option("FILE", options->files, "STL, PLY, OBJ, OFF or VTP files")->required();
  command->add_option("--units", options->unit, "unit of the files; guessed from their size where it is not given")
      ->check(CLI::IsMember({"mm", "m"}));
  command->add_option("--repair", options->repaired,
                      "write the mended mesh there, as binary STL in the file's unit (needs CGAL)");
  command->footer(
      "Exit code 0: nothing bad; 3: contact near what is BAD cannot be trusted; 2: a file cannot be read.\n"
      "Example: genu mesh-check femur.stl --repair femur-mended.stl");
  command->callback([options, &exit_code] { exit_code = check_files(*options); });
}

}  // namespace genu::cli
