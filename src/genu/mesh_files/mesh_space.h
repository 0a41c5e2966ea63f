// What a mesh file says of the frame of its numbers: 3D Slicer writes "SPACE=RAS" or "SPACE=LPS" into headers and
// comments. The two differ by half a turn about the long axis.
#pragma once

#include <string>
#include <string_view>

namespace genu {

/// "RAS", "LPS", ... in capitals: three letters, each of one direction of the body (R or L, A or P, S or I). Empty
/// where the file's beginning does not say.
std::string space_said(std::string_view bytes);

}  // namespace genu
