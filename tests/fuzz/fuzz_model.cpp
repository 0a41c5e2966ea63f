// The text of a scene of any bytes, prepared as `genu check` does it: meshes read, surfaces and the model built. Only
// the search for contacts is left out: here it would take seconds a scene. Beside it lie ball.stl and cup.stl.
#include "fuzz/fuzz_checks.h"
#include "genu/assemble/prepare.h"
#include "genu/mesh_files/stl_writer.h"
#include "genu/model/state.h"
#include "genu/surface/analytic.h"
#include "support/temporary_folder.h"

namespace genu::fuzz {

const std::string& folder_with_meshes() {
  static const test::TemporaryFolder folder;
  static const std::string path = [&] {
    constexpr double kRadius = 0.01, kEdge = 0.004;  // m
    for (const bool inside : {false, true}) {
      const auto ball = make_sphere(Pose(), kRadius, inside);
      const Mesh mesh = ball->triangles(kEdge, Vec3::Zero(), 1);
      require(write_stl(mesh, folder / (inside ? "cup.stl" : "ball.stl"), 1e-3, {}).empty(), "meshes can be written");
    }
    return folder / "";
  }();
  return path;
}

void check(const std::string& text) {
  const std::string path = folder_with_meshes() + "scene.toml";
  std::ofstream(path, std::ios::binary) << text;
  Diagnostics out;
  const auto prepared = prepare(path, out);
  require_result_or_reason(prepared.has_value(), out);
  if (!prepared) return;
  for (const JointModel::Ligament& between : prepared->model.ligaments)
    require(between.path.from().p.allFinite() && between.path.to().p.allFinite(), "ligaments end somewhere");
  require(prepared->model.scales.length > 0 && prepared->model.scales.force > 0, "a joint has a size and a force");
  const State start = start_state(prepared->model);
  for (const Pose& pose : start.poses) require(pose.p.allFinite() && pose.R.allFinite(), "bodies stand somewhere");
}

}  // namespace genu::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  genu::fuzz::check(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
