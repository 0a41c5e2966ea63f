// What a result is bound to beside its input.
#pragma once

#include <string>

namespace genu {

/// Of this program, of the libraries that it is linked with, and of the instructions that they choose from the
/// processor: where all are the same, the same input gives the same bytes.
std::string program_hash();

}  // namespace genu
