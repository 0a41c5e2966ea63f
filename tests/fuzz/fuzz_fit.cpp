// `genu fit` on an OFF file of any bytes, facing up: as a chart over a plane, round an axis, and as genu chooses. What
// it writes is a file that genu reads.
#include "fuzz/fuzz_checks.h"
#include "genu/assemble/fit_mesh.h"
#include "genu/scene/reader.h"
#include "support/temporary_folder.h"

namespace genu::fuzz {

void fit(const std::string& text) {
  static const test::TemporaryFolder folder;
  FitMeshRequest request;
  request.file = folder.write("mesh.off", text);
  request.facing = Vec3::UnitZ();
  for (const auto cylindrical : {std::optional<bool>(false), std::optional<bool>(true), std::optional<bool>()}) {
    request.cylindrical = cylindrical;
    Diagnostics out;
    const std::vector<NamedFit> fits = fit_mesh(request, out);
    require_result_or_reason(!fits.empty(), out);
    if (fits.empty()) continue;
    const auto read = read_surface_file(folder.write("surfaces.toml", surface_file(fits, "fuzz")), out);
    for (const Diagnostic& d : out.items()) std::fprintf(stderr, "%s\n", to_string(d).c_str());
    require(read && read->surfaces.size() == fits.size(), "what is written can be read");
  }
}

}  // namespace genu::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  genu::fuzz::fit(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
