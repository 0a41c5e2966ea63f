// The arrays of numbers in VTK's XML files, however they are written down.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "genu/mesh_files/mesh_notes.h"

namespace genu {

/// What the file as a whole says of its arrays.
struct VtpEncoding {
  bool swap = false;          ///< the bytes of numbers stand the other way round
  bool wide_header = false;   ///< counts of bytes are UInt64, not UInt32
  bool compressed = false;    ///< by zlib, in blocks
  std::string_view appended;  ///< what follows "_" in <AppendedData>
  bool appended_base64 = false;
};

/// One <DataArray>.
struct VtpArray {
  std::string type;        ///< "Float32", "Int64", ...
  std::string format;      ///< "ascii", "binary" or "appended"
  std::size_t offset = 0;  ///< into the appended data
  std::string_view text;   ///< between the tags
  std::size_t line = 1;    ///< of the file, where the tag stands
};

/// Appends the numbers to `out` (whole numbers are exact up to 2^53). Returns what is wrong, else an empty text.
[[nodiscard]] std::string read_vtp_array(const VtpArray& array, const VtpEncoding& encoding, std::vector<double>& out,
                                         MeshNotes& notes);

}  // namespace genu
