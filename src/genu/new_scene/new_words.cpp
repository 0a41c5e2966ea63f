#include "genu/new_scene/new_words.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "genu/core/length_units.h"
#include "genu/new_scene/new_numbers.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

/// The file as a scene in `folder` names it.
std::string seen_from(const std::string& file, const std::string& folder) {
  std::error_code failed;
  const fs::path from = fs::weakly_canonical(fs::absolute(folder, failed), failed),
                 to = fs::weakly_canonical(fs::absolute(file, failed), failed);
  const fs::path relative = to.lexically_relative(from);
  return '"' + toml_string_of((relative.empty() ? to : relative).string()) + '"';
}

}  // namespace

std::string names_seen_from(const PieceFiles& files, const std::string& folder) {
  std::string out;
  for (const std::string& file : files.paths) out += (out.empty() ? "" : ", ") + seen_from(file, folder);
  return files.several() ? "[" + out + "]" : out;
}

std::string thickness_text(const PieceFiles& files, const std::string& folder, const std::optional<NewBone>& bone) {
  if (!bone) return "";
  return fmt::format("\nthickness = {{ bone = {}, units = \"{}\" }}", names_seen_from(files, folder),
                     length_unit_name(bone->unit));
}

std::string toml_string_of(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if ((static_cast<unsigned char>(c) < 0x20 || c == 0x7f))
      out += fmt::format("\\u{:04x}", c);
    else
      out += c;
  return out;
}

Words words_of_knee(const NewScene& asked, const KneeLayout& knee, const KneeFrames& frames, bool left,
                    const NewBones& bones, const KneeLandmarks& landmarks) {
  Words w = clinical_words(landmarks, knee, frames, left);
  const bool guessed = asked.unit.empty();
  const std::string side = left ? "left" : "right";
  const Vec3 lateral = left ? Vec3(-knee.right) : knee.right;
  w["side"] = side;
  w["proximal"] = axis_word(knee.proximal);
  w["anterior"] = axis_word(knee.anterior);
  w["proximal_how"] = asked.proximal.empty() ? " (from the tibia to the femur)" : " (as you said)";
  w["anterior_how"] = asked.anterior.empty()
                          ? " (GUESSED: away from the notch between the condyles; `genu new --anterior` decides)"
                          : " (as you said)";
  w["width"] = tenths(knee.width);
  w["depth"] = tenths(knee.depth);
  w["cartilage_note"] =
      asked.femur_bone.empty() ? "Of bones without cartilage the layer stands for it, but begins at the bone." : "";
  Eigen::Index up = 0;
  knee.proximal.cwiseAbs().maxCoeff(&up);
  w["reference"] = fmt::format("{} = {}", "xyz"[up], tenths(knee.gap * knee.proximal[up]));
  w["reference_note"] = "The tibia moved until the meshes touch";
  w["centre"] = point_text(knee.centre);
  w["femur_file"] = names_seen_from(asked.femur, asked.folder);
  w["tibia_file"] = names_seen_from(asked.tibia, asked.folder);
  w["femur_unit"] = length_unit_name(bones.femur.unit);
  w["tibia_unit"] = length_unit_name(bones.tibia.unit);
  w["femur_thickness"] = thickness_text(asked.femur_bone, asked.folder, bones.femur_bone);
  w["tibia_thickness"] = thickness_text(asked.tibia_bone, asked.folder, bones.tibia_bone);
  const bool measured = !asked.femur_bone.empty();
  w["thickness"] = measured ? "" : "thickness = 6                  # CHOSEN: mm, of both layers together\n";
  w["layer"] = measured ? "10 MPa, as thick as it lies on the bones" : "6 mm and 10 MPa in all";
  w["femur_unit_how"] = w["tibia_unit_how"] = guessed ? "                   # GUESSED from its size" : "";
  Eigen::Index sideways = 0;
  lateral.cwiseAbs().maxCoeff(&sideways);
  const char axis = "xyz"[sideways];
  const std::string middle = tenths(knee.centre[sideways]);
  const std::string below = fmt::format("{} < {}", axis, middle), above = fmt::format("{} >= {}", axis, middle);
  w["medial"] = lateral[sideways] > 0 ? below : above;
  w["lateral"] = lateral[sideways] > 0 ? above : below;
  const Vec3 press = 100 * frames.tibia_proximal;
  w["compression"] = fmt::format("[{:.4g}, {:.4g}, {:.4g}]", press.x() + 0.0, press.y() + 0.0, press.z() + 0.0);
  return w;
}

void ask_for_flexion(Words& words, int degrees, bool tried_further) {
  words["flexion"] = fmt::format("{}", degrees);
  words["increments"] = fmt::format("{}", std::max(degrees, 1));
  words["flexion_note"] =
      tried_further ? fmt::format(": beyond {} deg the trial found no pose; better ligaments lead further", degrees)
                    : "";
}

}  // namespace genu
