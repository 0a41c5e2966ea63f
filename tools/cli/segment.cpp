// genu segment meniscus.stl --pieces 10 --out pieces
//   1. read the mesh, which must be closed and without bad flaws
//   2. cut it across its own curved centreline into pieces
//   3. write each as STL about its centroid, and NAME.toml: bodies, joints, surfaces and the bushings between them
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "commands.h"
#include "genu/core/atomic_output.h"
#include "genu/core/length_units.h"
#include "genu/core/units.h"
#include "genu/mesh_care/mesh_examination.h"
#include "genu/mesh_files/mesh_writer.h"
#include "genu/scene/words.h"
#include "genu/study/segments_text.h"
#include "print_error.h"

namespace genu::cli {
namespace {

const std::string kPieceTitle = "genu segment: ";  // of every mesh, by which it is known again
constexpr double kMegapascal = 1e6;

struct SegmentOptions {
  std::string file, unit, folder;
  int pieces = 10;
  double modulus = 100, shear = 0;  ///< MPa
  SegmentsText text{.name = "", .parent = "tibia", .density = 1100};
};

/// `what`: nothing for the closed piece, "_above" or "_below" for a side.
std::string piece_path(const SegmentOptions& options, int piece, const char* what) {
  return options.folder + "/" + piece_name(options.text.name, piece, options.pieces) + what + ".stl";
}

std::string scene_path(const SegmentOptions& options) { return options.folder + "/" + options.text.name + ".toml"; }

void check_segment_names(const SegmentOptions& options, Diagnostics& out) {
  std::vector<std::string> names{options.text.name, options.text.parent};
  for (const std::string& bone : {options.text.above, options.text.below})
    if (!bone.empty()) names.push_back(bone);
  for (const std::string& name : names)
    if (!is_name(name))
      out.error(Code::usage, "genu segment", "\"" + name + "\" is no name of a scene: letters, digits, _ and -");
}

/// Files that somebody else wrote are not replaced.
void check_segment_files(const SegmentOptions& options, Diagnostics& out) {
  for (int k = 0; k < options.pieces; ++k)
    for (const char* what : {"", "_above", "_below"}) {
      const std::string path = piece_path(options, k, what);
      std::error_code code;
      if (std::filesystem::exists(std::filesystem::symlink_status(path, code)) && !has_title(path, kPieceTitle))
        out.error(Code::would_overwrite, path,
                  "is there already and was not written by genu segment: it will not be replaced; choose another "
                  "folder");
    }
  if (const auto why = why_not_replaced(scene_path(options), kSegmentsTitle))
    out.error(why->code, options.folder, why->text);
}

std::optional<MeshSegments> cut_meniscus(const SegmentOptions& options, Diagnostics& problems) {
  double unit = metres_in(options.unit).value_or(units::kMillimetre);
  MeshFileFacts facts;
  const auto mesh = options.unit.empty() ? read_mesh_of_some_unit(options.file, unit, problems, &facts)
                                         : read_mesh(options.file, unit, problems, &facts);
  if (!mesh) return std::nullopt;
  for (const MeshFinding& f : examine_mesh(*mesh, facts, unit).findings)
    if (f.verdict == MeshFinding::Verdict::bad)
      problems.error(Code::mesh_flawed, options.file, f.question + ": " + f.number + " " + f.why);
  if (problems.has_errors()) return std::nullopt;
  MeshSegments segments = segment_mesh(*mesh, options.pieces);
  if (!segments.problem.empty()) {
    problems.error(Code::not_applicable, options.file, segments.problem);
    return std::nullopt;
  }
  return segments;
}

/// About the piece's centroid. Why it could not be written; empty where it was.
std::string write_about(const Vec3& centroid, Mesh mesh, const std::string& path) {
  for (Vec3& v : mesh.vertices) v -= centroid;
  return write_mesh(mesh, path, units::kMillimetre, kPieceTitle + std::filesystem::path(path).stem().string());
}

std::string write_pieces(const MeshSegments& segments, const SegmentOptions& options) {
  for (int k = 0; k < options.pieces; ++k) {
    const MeshPiece& piece = segments.pieces[at(k)];
    const std::string path = piece_path(options, k, "");
    std::string why = write_about(piece.centroid, piece.mesh, path);
    if (why.empty()) why = write_about(piece.centroid, piece.above, piece_path(options, k, "_above"));
    if (why.empty()) why = write_about(piece.centroid, piece.below, piece_path(options, k, "_below"));
    if (!why.empty()) return why;
    fmt::print("{}: {} triangles, {:.4g} mm3, {:.4g} g\n", printable(path), piece.mesh.triangles.size(),
               1e9 * piece.volume, 1e3 * options.text.density * piece.volume);
  }
  return write_file_atomically(scene_path(options), segments_text(segments, options.text));
}

int segment_meniscus(SegmentOptions& options) {
  options.text.modulus = kMegapascal * options.modulus;
  options.text.shear_modulus = options.shear > 0 ? kMegapascal * options.shear : options.text.modulus / 3;
  if (options.text.name.empty()) options.text.name = std::filesystem::path(options.file).stem().string();
  Diagnostics problems;
  check_segment_names(options, problems);
  if (problems.has_errors()) return refuse(problems);
  const auto segments = cut_meniscus(options, problems);
  if (!segments) return refuse(problems);
  std::error_code failure;
  std::filesystem::create_directories(options.folder, failure);
  if (failure) return refuse(Code::cannot_write, options.folder + ": cannot be made a folder: " + failure.message());
  check_segment_files(options, problems);
  if (problems.has_errors()) return refuse(problems);
  if (const std::string why = write_pieces(*segments, options); !why.empty()) {
    print_error("{}\n", printable(why));
    return kFailed;
  }
  double whole = 0;
  for (const MeshPiece& piece : segments->pieces) whole += piece.volume;
  fmt::print("{}: {} pieces of {:.4g} mm along the centreline, {:.5g} mm3 in all, {} bushings{}\n",
             printable(scene_path(options)), options.pieces, 1e3 * segments->pieces.front().length, 1e9 * whole,
             segments->sections.size(), segments->ring ? ", a ring" : "");
  return kOk;
}

}  // namespace

void add_segment(CLI::App& command, int& exit_code) {
  auto options = std::make_shared<SegmentOptions>();
  command
      .add_option("MESH", options->file,
                  "closed mesh of a meniscus, in the frame of --parent: STL, PLY, OBJ, OFF or VTP")
      ->required();
  command.add_option("--pieces", options->pieces, "how many, equally long along the centreline")
      ->check(CLI::Range(3, 200))
      ->capture_default_str();
  command.add_option("--units", options->unit, "unit of the file; guessed from its size where it is not given")
      ->check(CLI::IsMember(length_unit_names()));
  command.add_option("--name", options->text.name,
                     "of the meniscus: pieces are NAME_01, NAME_02, ...; the file's name where not given");
  command.add_option("--parent", options->text.parent, "body that the pieces' joints are in")->capture_default_str();
  command.add_option("--modulus", options->modulus, "E along the centreline, MPa")
      ->check(number_within(1e-6, 1e6))
      ->capture_default_str();
  command.add_option("--shear-modulus", options->shear, "G across it, MPa; a third of E where not given")
      ->check(number_within(1e-6, 1e6));
  command.add_option("--density", options->text.density, "kg/m3, for the masses")
      ->check(number_within(1, 1e5))
      ->capture_default_str();
  command.add_option(
      "--above", options->text.above,
      "surface of the scene that the pieces' upper sides touch; up is the axis, toward + of its largest part");
  command.add_option("--below", options->text.below, "that their lower sides touch");
  command.add_option("-o,--out", options->folder, "folder for the pieces and NAME.toml, made if need be")
      ->required()
      ->check(not_empty());
  command.footer(
      "Example: genu segment meniscus.stl --pieces 10 --above femur_cartilage --below tibia_cartilage --out pieces");
  command.callback([options, &exit_code] { exit_code = segment_meniscus(*options); });
}

}  // namespace genu::cli
