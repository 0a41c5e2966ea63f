// What a piece of work is bound to: the content of its scene and meshes (and the program: core/program_hash.h).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/core/input_files.h"
#include "genu/scene/scene.h"

namespace genu {

/// The scene's file and its meshes with their checksums (core/file_checksum.h), in the order of the scene; empty for a
/// file that cannot be read.
std::vector<std::pair<std::string, std::string>> input_hashes(const SceneTables& scene, InputFiles& files);

/// Of what --without and --set change in the scene.
std::string change_hash(const SceneTables& scene);

}  // namespace genu
