// What a piece of work is bound to: the content of its scene and meshes, and the program that does it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/scene/scene.h"

namespace genu {

/// 128 bits of XXH3 as 32 hexadecimal digits: distinguishes contents that differ by accident or by an edit. Nobody is
/// kept from making two on purpose.
std::string content_hash(const std::string& bytes);

/// The same of a file; empty where it cannot be read.
std::string file_hash(const std::string& path);

/// The scene's file and its meshes with their hashes, in the order of the scene.
std::vector<std::pair<std::string, std::string>> input_hashes(const Scene& scene);

/// Of this program, of the libraries that it is linked with, and of the instructions that they choose from the
/// processor: where all are the same, the same input gives the same bytes.
std::string program_hash();

}  // namespace genu
