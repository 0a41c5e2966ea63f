// What every part of the reader sees: the scene being filled, the file's units, and where errors go.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/scene/scene.h"

namespace genu {

struct ReadContext {
  ReadContext(const std::string& path, Diagnostics& diagnostics, Scene& to_fill)
      : file(path), folder(std::filesystem::path(path).parent_path()), out(diagnostics), scene(to_fill) {}

  std::string file;                  ///< the scene file, as named by the user
  std::filesystem::path folder;      ///< where relative mesh files start
  std::vector<std::string> at_hand;  ///< mesh files, as they would be opened, that need not exist
  Diagnostics& out;
  Scene& scene;
  std::string length_name = "mm";  ///< the file's unit of length, for messages
  std::string angle_name = "deg";
  /// Joints whose six coordinates were all understood; for others nothing is said about unknown coordinates.
  std::vector<bool> joint_understood;
  std::vector<bool> combination_understood;  ///< with nothing wrong in it
  bool bodies_understood = true;             ///< false where a body could not be told fixed or moving
  int rigid_pairs = 0;
  std::vector<std::string> ligaments;  ///< all that the file names, disabled ones too
  bool in_motion = false;              ///< the scene has [dynamics]
  bool turns_said = false;             ///< an angle has got the warning that it is probably in deg

  /// As a mesh file of that name is opened.
  std::string file_called(const std::string& name) const {
    return (folder / std::filesystem::path(name)).lexically_normal().string();
  }

  void error(SourceLocation where, Code code, std::string key, std::string found, std::string rule) {
    out.add(error_at({file, where}, code, std::move(key), std::move(found), std::move(rule)));
  }
  void warning(SourceLocation where, Code code, std::string key, std::string found, std::string rule) {
    out.add(warning_at({file, where}, code, std::move(key), std::move(found), std::move(rule)));
  }
};

/// The names of bodies, joints, surfaces, ...: any of the scene's lists.
template <class Defs>
std::vector<std::string> names_of(const Defs& defs) {
  std::vector<std::string> names;
  for (const auto& def : defs) names.push_back(def.name);
  return names;
}

}  // namespace genu
