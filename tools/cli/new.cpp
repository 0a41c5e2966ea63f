// genu new knee --femur femur.stl --tibia tibia.stl
//   1. look at the meshes: their unit, which way is up, where they meet
//   2. write knee/knee.toml, commented, with what they do not say chosen and marked
//   3. solve it once, and say what came of that
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include "advice.h"
#include "commands.h"
#include "genu/core/file_text.h"
#include "genu/core/length_units.h"
#include "genu/new_scene/new_scene.h"
#include "help_pages.h"

namespace genu::cli {
namespace {

constexpr int kMostPieces = 100;

struct NewArguments {
  NewScene scene;
  std::string kind, side;
  std::vector<std::string> femur, tibia;  ///< what touches, or pieces of bone and cartilage
  std::vector<std::string> femur_cartilage, tibia_cartilage;
  std::vector<std::string> patella, patella_cartilage;
  double landmark_error = 0;  ///< mm
};

/// What was typed of meshes, where no mesh is asked for: nothing is passed over in silence.
bool says_more_than_it_uses(const CLI::App& command, const NewScene& asked, Diagnostics& out) {
  if (asked.kind == NewScene::Kind::stl) return false;
  for (const char* option : {"--femur", "--tibia", "--femur-cartilage", "--tibia-cartilage", "--patella",
                             "--patella-cartilage", "--fibula", "--units", "--side", "--proximal", "--anterior",
                             "--landmarks", "--landmark-units", "--landmark-error", "--picture"})
    if (command.count(option) > 0)
      out.add(error_at({}, Code::meshes_needed, option, {}, "belongs to a scene of meshes: --femur F --tibia T"));
  return out.has_errors();
}

int write_scene(const CLI::App& command, NewArguments arguments) {
  NewScene& asked = arguments.scene;
  const bool meshes = command.count("--femur") + command.count("--tibia") > 0;
  if (arguments.kind == "stl" || (arguments.kind.empty() && meshes)) asked.kind = NewScene::Kind::stl;
  if (arguments.kind == "motion") asked.kind = NewScene::Kind::motion;
  for (const HelpPage& scene : ready_scenes())
    if (scene.name == arguments.kind) {
      asked.kind = NewScene::Kind::given;
      asked.text = scene.text;
    }
  const auto take = [](const std::vector<std::string>& files, const std::vector<std::string>& cartilage,
                       PieceFiles& any, PieceFiles& touches, PieceFiles& bone) {
    touches.paths = cartilage;
    (cartilage.empty() ? any : bone).paths = files;
  };
  take(arguments.femur, arguments.femur_cartilage, asked.femur_any, asked.femur, asked.femur_bone);
  take(arguments.tibia, arguments.tibia_cartilage, asked.tibia_any, asked.tibia, asked.tibia_bone);
  take(arguments.patella, arguments.patella_cartilage, asked.patella_any, asked.patella, asked.patella_bone);
  asked.landmark_error = 1e-3 * arguments.landmark_error;
  if (!arguments.side.empty()) asked.left = arguments.side == "left";
  asked.cancelled = stop_on_interrupt();
  Diagnostics problems;
  if (says_more_than_it_uses(command, asked, problems)) return refuse(problems);
  const auto written = write_new_scene(asked, problems);
  print(problems, written && !written->written);
  if (!written) return kRefused;
  if (!written->written) return kFailed;
  fmt::print("written     {}\n", printable(written->file));
  for (const std::string& line : written->choices) fmt::print("{}\n", line);
  fmt::print("tried       {} of {} poses solved\n", written->poses_solved, written->poses_asked);
  if (!asked.picture.empty()) fmt::print("picture     {}\n", printable(asked.picture));
  for (const std::string& line : written->verdict) fmt::print("  {}\n", printable(line));
  fmt::print(
      "next        genu run {} --out {}\n", printable(shell_word(written->file)),
      printable(shell_word((std::filesystem::path("out") / std::filesystem::path(written->file).stem()).string())));
  return written->verdict.empty() ? kOk : kNotAllOk;
}

}  // namespace

void add_new(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<NewArguments>();
  NewScene& scene = arguments->scene;
  command.add_option("NAME", scene.folder, "new folder; the scene is NAME/NAME.toml")->required();
  std::vector<std::string> kinds = {"analytic", "stl", "motion"};
  for (const HelpPage& ready : ready_scenes()) kinds.push_back(ready.name);
  command
      .add_option(
          "--kind", arguments->kind,
          "analytic: a knee of formulas; stl: from meshes of a knee; motion: a shank that swings; hip, ankle, finger, "
          "jaw, total-knee: these joints of formulas. Where it is not given: stl with meshes, else analytic")
      ->check(CLI::IsMember(kinds));
  command
      .add_option("--femur", arguments->femur,
                  "meshes of the femur, its cartilage or both, each in one file or in pieces: STL, PLY, OBJ, OFF or "
                  "VTP. Their shape shows which are bone and which are cartilage; the first lines say so")
      ->expected(1, kMostPieces);
  command.add_option("--tibia", arguments->tibia, "the same of the tibia, in the same frame")->expected(1, kMostPieces);
  command
      .add_option("--femur-cartilage", arguments->femur_cartilage,
                  "meshes of the femur's cartilage; those of --femur are bone then, whatever their shape")
      ->expected(1, kMostPieces);
  command.add_option("--tibia-cartilage", arguments->tibia_cartilage, "the same of the tibia")
      ->expected(1, kMostPieces);
  command
      .add_option("--patella", arguments->patella,
                  "the same of the patella: a third body in contact with the femur, with its ligaments and the "
                  "quadriceps. Without it the knee has none")
      ->expected(1, kMostPieces);
  command
      .add_option("--patella-cartilage", arguments->patella_cartilage,
                  "meshes of the patella's cartilage; those of --patella are bone then")
      ->expected(1, kMostPieces);
  command
      .add_option(
          "--fibula", scene.fibula.paths,
          "mesh of the fibula, in one file or in pieces: the lateral collateral and the popliteofibular ligament "
          "insert on it, and it says which side is lateral")
      ->expected(1, kMostPieces);
  command.add_option("--units", scene.unit, "unit of the meshes; guessed from their size where it is not given")
      ->check(CLI::IsMember(length_unit_names()));
  command.add_option("--side", arguments->side, "which knee it is; by the shape of the bones where it is not given")
      ->check(CLI::IsMember({"right", "left"}))
      ->capture_default_str();
  command.add_option("--proximal", scene.proximal, "axis of the meshes toward the hip: x, y, z, -x, -y or -z");
  command.add_option("--anterior", scene.anterior, "axis of the meshes toward the front");
  command.add_option(
      "--landmarks", scene.landmarks,
      "points placed by a person, in the frame of the meshes: markups of 3D Slicer (.mrk.json, .fcsv), or "
      "a table (.csv) name,x,y,z. Names: ACL femur, ACL tibia, LCL fibula, medial epicondyle, hip "
      "centre, ... in usual spellings");
  command
      .add_option("--landmark-units", scene.landmark_unit,
                  "unit of a table of landmarks; that of the meshes where it is not given")
      ->check(CLI::IsMember(length_unit_names()));
  command
      .add_option("--landmark-error", arguments->landmark_error,
                  "mm: standard deviation of landmarks whose file states none; 2 where it is not given")
      ->check(CLI::Range(0.01, 100.0));
  command.add_option("--picture", scene.picture,
                     "an .svg to write: bones, ends of ligaments and their errors from six sides");
  command.add_flag(
      "--edit", scene.edit,
      "write the scene in NAME again, with better meshes or landmarks, and keep what you have changed in it. "
      "What genu wrote is in NAME.written.toml beside it");
  command.footer(
      "Nothing is ever replaced, but with --edit the scene that genu wrote. Exit code 0: the scene runs, 3: it is "
      "written but not every pose is ok.\n"
      "Example: genu new knee --femur femur.stl --tibia tibia.stl");
  advice().hint("new", "the scene is written: change what the lines above name, then `genu run` it");
  command.callback([arguments, &command, &exit_code] { exit_code = write_scene(command, *arguments); });
}

}  // namespace genu::cli
