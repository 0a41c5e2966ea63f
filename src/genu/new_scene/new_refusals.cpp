#include "genu/new_scene/new_refusals.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "genu/core/atomic_output.h"
#include "genu/landmarks/landmark_file.h"
#include "genu/new_scene/knee_picture.h"
#include "genu/scene/utf8.h"
#include "genu/scene/words.h"
#include "genu/study/knee_layout.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

/// A picture is never put in the place of what is none.
void refuse_picture(const NewScene& asked, Diagnostics& out) {
  const fs::path file = asked.picture;
  if (file.extension() != ".svg")
    out.add(error_at({}, Code::wrong_form, "--picture", with_quotes(printable(asked.picture)), "must end with .svg"));
  else if (asked.kind != NewScene::Kind::stl)
    out.add(error_at({}, Code::meshes_needed, "--picture", {}, "belongs to a scene of meshes: --femur F --tibia T"));
  else if (const auto kept = why_not_replaced(asked.picture, kKneePictureMark);
           kept && (asked.edit || file.parent_path().lexically_normal() != fs::path(asked.folder).lexically_normal()))
    out.error(kept->code, {}, kept->text);
}

}  // namespace

bool refuse_words(const NewScene& asked, Diagnostics& out) {
  const auto refuse_it = [&](Code code, const char* option, const std::string& found, const std::string& rule) {
    out.add(error_at({}, code, option, with_quotes(found), rule));
  };
  std::error_code ignored;
  const bool femur = !asked.femur.empty() || !asked.femur_any.empty();
  const bool tibia = !asked.tibia.empty() || !asked.tibia_any.empty();
  const bool meshes = femur || tibia || !asked.patella.empty() || !asked.patella_any.empty() || !asked.fibula.empty();
  if (asked.folder.empty()) out.error(Code::no_scene_name, {}, "the scene has no name: genu new NAME");
  // A scene is a text, and names these.
  std::vector<std::pair<const char*, std::string>> names = {{"NAME", asked.folder}, {"--landmarks", asked.landmarks}};
  for (const auto& [option, files] :
       {std::pair("--femur", &asked.femur), std::pair("--tibia", &asked.tibia), std::pair("--femur", &asked.femur_bone),
        std::pair("--tibia", &asked.tibia_bone), std::pair("--femur", &asked.femur_any),
        std::pair("--tibia", &asked.tibia_any), std::pair("--patella", &asked.patella),
        std::pair("--patella", &asked.patella_bone), std::pair("--patella", &asked.patella_any),
        std::pair("--fibula", &asked.fibula)})
    for (const std::string& path : files->paths) names.emplace_back(option, path);
  for (const auto& [what, name] : names)
    if (first_invalid_utf8(name) || std::any_of(name.begin(), name.end(), is_control))
      refuse_it(Code::not_utf8, what, printable(valid_utf8(name)),
                "must be a name of UTF-8 text without control characters: rename it");
  if (asked.edit && !fs::is_directory(asked.folder, ignored))
    out.error(Code::no_such_file, asked.folder,
              "is no folder of a scene: --edit writes one again that genu new has written");
  if (asked.edit && asked.kind != NewScene::Kind::stl)
    out.add(error_at({}, Code::meshes_needed, "--edit", {}, "belongs to a scene of meshes: --femur F --tibia T"));
  if (!asked.edit && fs::exists(fs::symlink_status(asked.folder, ignored)))
    out.error(Code::name_taken, asked.folder,
              "exists already, and genu new replaces nothing: choose another name, or --edit to write it again");
  if (asked.kind != NewScene::Kind::stl && meshes)
    refuse_it(Code::meshes_needed, "--kind", asked.kind == NewScene::Kind::motion ? "motion" : "analytic",
              "has no meshes: --femur and --tibia belong to --kind stl");
  if (asked.landmarks.empty() && (!asked.landmark_unit.empty() || asked.landmark_error > 0))
    out.add(error_at({}, Code::usage, asked.landmark_unit.empty() ? "--landmark-error" : "--landmark-units", {},
                     "belongs to --landmarks FILE"));
  if (asked.kind == NewScene::Kind::stl && !(femur && tibia))
    out.error(Code::meshes_needed, {},
              "a scene of kind stl needs two meshes in one frame: --femur femur.stl --tibia tibia.stl");
  for (const auto& [option, word] : {std::pair("--proximal", asked.proximal), std::pair("--anterior", asked.anterior)})
    if (!word.empty() && !axis_named(word))
      refuse_it(Code::unknown_name, option, word, "must be one of x, y, z, -x, -y, -z");
  if (!asked.picture.empty()) refuse_picture(asked, out);
  return out.has_errors();
}

void refuse_landmarks(const NewScene& asked, Diagnostics& out) {
  if (!asked.landmarks.empty()) static_cast<void>(read_landmarks(asked.landmarks, 1, out));
}

}  // namespace genu
