#include "genu/store/input_hash.h"

#include "genu/core/file_checksum.h"

namespace genu {

std::vector<std::pair<std::string, std::string>> input_hashes(const SceneTables& scene, InputFiles& files) {
  std::vector<std::pair<std::string, std::string>> hashes;
  const auto add = [&](const std::string& file) {
    const auto checksum = files.checksum(file);
    hashes.emplace_back(file, checksum ? checksum->xxh128 : std::string());
  };
  add(scene.file);
  for (const std::string& file : mesh_files(scene)) add(file);
  return hashes;
}

std::string change_hash(const SceneTables& scene) {
  std::string changes;
  for (const SceneEdit& edit : scene.changed.edits) changes += edit.key + "=" + edit.text + "\n";
  return checksum(changes).xxh128;
}

}  // namespace genu
