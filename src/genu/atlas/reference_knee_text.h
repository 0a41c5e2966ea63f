// The text of reference_knee.txt, compiled in.
#pragma once

#include <string>

namespace genu {

/// Written by cmake/text_source.cmake.
std::string reference_knee_text();

}  // namespace genu
