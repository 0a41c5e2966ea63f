#include "genu/new_scene/new_bones.h"

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
bool check_spaces(const NewBone& femur, const PieceFiles& femur_file, const NewBone& other,
                  const PieceFiles& other_file, Diagnostics& out) {
  if (femur.space.empty() || other.space.empty() || femur.space == other.space) return true;
  out.error(Code::layout, femur_file.text() + ", " + other_file.text(),
            fmt::format("are in two frames by their own headers, SPACE={} and SPACE={}: export both in one frame",
                        femur.space, other.space));
  return false;
}

}  // namespace

std::optional<NewBones> read_new_bones(const NewScene& asked, Diagnostics& out) {
  auto femur = read_new_bone(asked.femur, asked.unit, out), tibia = read_new_bone(asked.tibia, asked.unit, out);
  NewBones bones;
  for (const auto& [files, bone] :
       {std::pair(&asked.femur_bone, &bones.femur_bone), std::pair(&asked.tibia_bone, &bones.tibia_bone),
        std::pair(&asked.patella, &bones.patella), std::pair(&asked.patella_bone, &bones.patella_bone),
        std::pair(&asked.fibula, &bones.fibula)})
    if (!files->empty()) *bone = read_new_bone(*files, asked.unit, out);
  if (out.has_errors() || !femur || !tibia) return std::nullopt;
  if (!check_spaces(*femur, asked.femur, *tibia, asked.tibia, out) ||
      (bones.patella && !check_spaces(*femur, asked.femur, *bones.patella, asked.patella, out)) ||
      (bones.fibula && !check_spaces(*femur, asked.femur, *bones.fibula, asked.fibula, out)))
    return std::nullopt;
  bones.femur = std::move(*femur);
  bones.tibia = std::move(*tibia);
  return bones;
}

}  // namespace genu
