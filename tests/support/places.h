// Where the source, the program and the public knee data are. The paths are compiled into places.cpp alone, so that the
// other objects are the same in every checkout and a compiler cache can share them.
#pragma once

#include <string>

namespace genu::test {

// The root of the source tree.
std::string source_folder();

// The built program `genu`.
std::string program();

// The public knee data, unless GENU_DATA in the environment names another folder.
std::string data_default();

}  // namespace genu::test
