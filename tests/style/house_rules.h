// The rules of the house that can be read off the includes: which layer may use which, where third-party libraries may
// appear, and how long a file may be.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace genu::style {

struct SourceFile {
  std::string path;  ///< relative to the project's root, with slashes: "src/genu/core/pose.h"
  std::vector<std::string> lines;
};

/// Every .h and .cpp under root/src and root/tools, sorted by path.
std::vector<SourceFile> read_sources(const std::filesystem::path& root);

/// One line for each include that goes against the order of the layers: "src/genu/solver/newton.cpp:7: ...".
std::vector<std::string> wrong_arrows(const std::vector<SourceFile>& files);

/// One line for each include of a guarded third-party library in a header or in a third .cpp.
std::vector<std::string> wandering_libraries(const std::vector<SourceFile>& files);

/// One line for each file longer than 400 lines.
std::vector<std::string> long_files(const std::vector<SourceFile>& files);

}  // namespace genu::style
