// genu mesh-check femur.stl tibia.stl
//   1. read each file and say everything there is to say about it, a line each with a number and a verdict
//   2. with --repair OUT: take out what is wrong, fill what is missing, write STL, PLY or OBJ in the file's unit, and
//      say the same of what was written; with --smooth H also move every vertex by up to H to even out steps and noise
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "advice.h"
#include "commands.h"
#include "genu/core/diagnostics.h"
#include "genu/core/length_units.h"
#include "genu/core/timer.h"
#include "genu/core/units.h"
#include "genu/mesh_care/mesh_examination.h"
#include "genu/mesh_care/mesh_repair.h"
#include "genu/mesh_care/mesh_smooth.h"
#include "genu/mesh_files/mesh_writer.h"
#include "print_error.h"

namespace genu::cli {
namespace {

constexpr char kRepaired[] = "genu mesh-check --repair";  // the title of what it writes

struct CheckOptions {
  std::vector<std::string> files;
  std::string unit, repaired;
  bool repairs = false;
  double smooth = 0;  ///< mm; 0: not at all
};

void print_findings(const MeshExamination& examination) {
  for (const MeshFinding& f : examination.findings) {
    const std::string line = fmt::format("  {:<24}{:<34}{:<5}{}", f.question, f.number, to_string(f.verdict), f.why);
    fmt::print("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
  }
}

/// Why the repaired mesh cannot be written to the file of --repair; none if it can.
std::optional<Fault> why_not_there(const std::string& from, const std::string& to) {
  if (to.empty()) return Fault{Code::usage, "genu mesh-check: --repair names no file"};
  if (std::string why = why_not_writable(to); !why.empty()) return Fault{Code::cannot_write, why};
  std::error_code ignored;
  if (std::filesystem::equivalent(from, to, ignored))
    return Fault{Code::would_lose_input, to + ": is the file to repair: give --repair another"};
  std::error_code code;
  if (std::filesystem::exists(std::filesystem::symlink_status(to, code)) && !has_title(to, kRepaired))
    return Fault{
        Code::would_overwrite,
        to + ": is there already and was not written by genu mesh-check: it will not be replaced; choose another name"};
  return {};
}

/// What was written, as whoever reads it gets it.
int check_written(const std::string& file, double unit) {
  Diagnostics problems;
  MeshFileFacts facts;
  const std::optional<Mesh> mesh = read_mesh(file, unit, problems, &facts);
  if (!mesh) return refuse(problems);
  const MeshExamination examination = examine_mesh(*mesh, facts, unit);
  print_findings(examination);
  return examination.bad() ? kNotAllOk : kOk;
}

void smooth(Mesh& mesh, double bound, const std::string& file) {
  const SmoothReport r = smooth_mesh(mesh, bound);
  fmt::print("{}: vertices moved by {:.3g} mm rms, {:.3g} mm at most; {} of {} held at the bound\n", printable(file),
             to::kMillimetre * r.rms, to::kMillimetre * r.largest, r.held, mesh.vertices.size());
  if (r.volume_before != 0)
    fmt::print("{}: volume {:.5g} cm3, {:+.2g} % of what it was\n", printable(file), 1e6 * r.volume_after,
               100 * (r.volume_after / r.volume_before - 1));
}

int repair(const std::string& from, Mesh mesh, double unit, const std::string& to, double smoothed) {
  const RepairReport r = repair_mesh(mesh);
  if (!r.problem.empty()) {
    print_error("{}: {}\n", printable(from), r.problem);
    return kRefused;
  }
  if (smoothed > 0) smooth(mesh, smoothed * units::kMillimetre, to);
  if (const std::string error = write_mesh(mesh, to, unit, kRepaired); !error.empty()) {
    print_error("{}\n", printable(error));
    return kFailed;
  }
  fmt::print("{}: {} triangles taken out, {} turned round, {} holes filled with {} triangles{}\n", printable(to),
             r.removed, r.turned, r.filled, r.new_triangles, smoothed > 0 ? "" : "; no vertex that stays was moved");
  if (r.left_open > 0) fmt::print("{}: {} holes could not be filled\n", printable(to), r.left_open);
  return check_written(to, unit);
}

int check_file(const std::string& file, const CheckOptions& options) {
  if (options.repairs)
    if (const auto why = why_not_there(file, options.repaired)) return refuse(why->code, why->text);
  Diagnostics problems;  // the warnings among them are said below, a line each
  MeshFileFacts facts;
  const Timer timer;
  double unit = metres_in(options.unit).value_or(1e-3);
  std::optional<Mesh> mesh = options.unit.empty() ? read_mesh_of_some_unit(file, unit, problems, &facts)
                                                  : read_mesh(file, unit, problems, &facts);
  if (!mesh) return refuse(problems);
  fmt::print("{}: read in {:.2f} s; units {}{}\n", printable(file), timer.seconds(), length_unit_name(unit),
             options.unit.empty() ? " (guessed from the size)" : "");
  const MeshExamination examination = examine_mesh(*mesh, facts, unit);
  print_findings(examination);
  if (options.repairs) return repair(file, std::move(*mesh), unit, options.repaired, options.smooth);
  return examination.bad() ? kNotAllOk : kOk;
}

int check_files(const CheckOptions& options) {
  if (options.repairs && options.files.size() > 1) {
    return refuse(Code::usage, "genu mesh-check: --repair takes one file at a time");
  }
  // What is refused counts most, then what could not be written, then flaws.
  int worst = kOk;
  for (const std::string& file : options.files) {
    const int code = check_file(file, options);
    const auto rank = [](int c) { return c == kRefused ? 3 : c == kFailed ? 2 : c == kNotAllOk ? 1 : 0; };
    if (rank(code) > rank(worst)) worst = code;
  }
  return worst;
}

}  // namespace

void add_mesh_check(CLI::App& command, int& exit_code) {
  auto options = std::make_shared<CheckOptions>();
  command.add_option("FILE", options->files, "STL, PLY, OBJ, OFF or VTP files")->required();
  command.add_option("--units", options->unit, "unit of the files; guessed from their size where it is not given")
      ->check(CLI::IsMember(length_unit_names()));
  auto* repaired = command.add_option("--repair", options->repaired,
                                      "write the repaired mesh there, as STL, PLY or OBJ by the ending of the name, "
                                      "in the file's unit (needs CGAL)");
  command
      .add_option("--smooth", options->smooth,
                  "with --repair: also even out steps and noise (Taubin 1995, the volume is kept); no vertex moves by "
                  "more than so many mm")
      ->check(CLI::Range(1e-6, 100.0))
      ->needs(repaired);
  command.footer(
      "Exit code 0: no bad flaw; 3: contact near a BAD place cannot be trusted; 2: a file cannot be read.\n"
      "Example: genu mesh-check femur.stl --repair femur-repaired.stl");
  advice().hint("mesh-check",
                "`genu mesh-check FILE --repair OUT` repairs what can be repaired; keep contact away from the rest "
                "with a surface's `patch`");
  command.callback([options, repaired, &exit_code] {
    options->repairs = repaired->count() > 0;
    exit_code = check_files(*options);
  });
}

}  // namespace genu::cli
