// VTP files of any bytes.
#include "fuzz/mesh_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return genu::fuzz::mesh_file(data, size, ".vtp");
}
