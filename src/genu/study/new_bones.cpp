#include "genu/study/new_bones.h"

#include <fmt/format.h>

#include "genu/core/length_units.h"
#include "genu/mesh/mesh_check.h"
#include "genu/mesh_files/mesh_reader.h"

namespace genu {
namespace {

std::optional<NewBone> read_new_bone(const PieceFiles& file, const std::string& unit, Diagnostics& out) {
  NewBone bone;
  bone.unit = metres_in(unit).value_or(bone.unit);
  MeshFileFacts facts;
  auto mesh =
      unit.empty() ? read_mesh_of_some_unit(file, bone.unit, out, &facts) : read_mesh(file, bone.unit, out, &facts);
  bone.space = facts.space;
  if (!mesh) return std::nullopt;
  check_scale(check_mesh(*mesh), file.text(), length_unit_name(bone.unit), out);
  if (out.has_errors()) return std::nullopt;
  bone.mesh = std::move(*mesh);
  return bone;
}

/// Two frames in two files are seldom meant: between RAS and LPS one of the bones stands back to front.
bool check_spaces(const NewBone& femur, const NewBone& tibia, const NewScene& asked, Diagnostics& out) {
  if (femur.space.empty() || tibia.space.empty() || femur.space == tibia.space) return true;
  out.error(Code::layout, asked.femur.text() + ", " + asked.tibia.text(),
            fmt::format("are in two frames by their own headers, SPACE={} and SPACE={}: export both in one frame",
                        femur.space, tibia.space));
  return false;
}

}  // namespace

std::optional<NewBones> read_new_bones(const NewScene& asked, Diagnostics& out) {
  auto femur = read_new_bone(asked.femur, asked.unit, out), tibia = read_new_bone(asked.tibia, asked.unit, out);
  std::optional<NewBone> femur_bone, tibia_bone;
  if (!asked.femur_bone.empty()) femur_bone = read_new_bone(asked.femur_bone, asked.unit, out);
  if (!asked.tibia_bone.empty()) tibia_bone = read_new_bone(asked.tibia_bone, asked.unit, out);
  if (out.has_errors() || !femur || !tibia) return std::nullopt;
  if (!check_spaces(*femur, *tibia, asked, out)) return std::nullopt;
  return NewBones{std::move(*femur), std::move(*tibia), std::move(femur_bone), std::move(tibia_bone)};
}

}  // namespace genu
