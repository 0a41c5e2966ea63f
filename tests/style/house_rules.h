// The rules of the house that can be read off the includes: which room may use which, where third-party libraries may
// appear, and how long a file may be.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace genu::style {

struct SourceFile {
  std::string path;  ///< relative to the project's root, with slashes: "src/genu/core/pose.h"
  std::vector<std::string> lines;
};

/// Every .h and .cpp under these folders of the root, sorted by path.
std::vector<SourceFile> read_sources(const std::filesystem::path& root,
                                     const std::vector<std::string>& tops = {"src", "tools"});

/// Which rooms each room may include, by name.
using Rooms = std::map<std::string, std::set<std::string>>;

/// The lists genu_ROOM_uses of root/cmake/rooms.cmake, which the build links by.
Rooms read_rooms(const std::filesystem::path& root);

/// One line for each include that no list allows: "src/genu/equilibrium/newton.cpp:7: ...".
std::vector<std::string> wrong_arrows(const std::vector<SourceFile>& files, const Rooms& rooms);

/// One line for each room that uses itself by way of others.
std::vector<std::string> room_cycles(const Rooms& rooms);

/// One line for each cycle of units; a unit is a header with its source.
std::vector<std::string> unit_cycles(const std::vector<SourceFile>& files);

/// One line for each room with more than a tenth of the lines under src/genu.
std::vector<std::string> crowded_rooms(const std::vector<SourceFile>& files);

/// One line for each include of a guarded third-party library in a header or in a third .cpp.
std::vector<std::string> wandering_libraries(const std::vector<SourceFile>& files);

/// One line for each file longer than 400 lines.
std::vector<std::string> long_files(const std::vector<SourceFile>& files);

}  // namespace genu::style
