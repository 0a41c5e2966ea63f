// The text of a scene of any bytes: read, checked, planned; and the same text as a file of surfaces.
#include "fuzz/fuzz_checks.h"
#include "genu/model/step_plan.h"
#include "genu/scene/centre_bodies.h"
#include "genu/scene/reader.h"
#include "support/temporary_folder.h"

namespace genu::fuzz {

void read_as_scene(const std::string& text) {
  Diagnostics out;
  auto scene = parse_scene(text, "scene.toml", out);
  require_result_or_reason(scene.has_value(), out);
  if (!scene) return;
  const PlacedScene placed = place(*scene, choose_origins(*scene));
  require(placed.origins.size() == scene->bodies.size(), "each body has an origin");
  for (const JointDef& joint : scene->joints)
    for (const double value : joint.reference) require(std::isfinite(value), "a joint starts at numbers");
  require(plan_steps(*scene).size() == scene->steps.size(), "each step has a plan");
}

void read_as_surfaces(const std::string& text) {
  static const test::TemporaryFolder folder;
  Diagnostics out;
  const auto surfaces = read_surface_file(folder.write("surfaces.toml", text), out);
  require_result_or_reason(surfaces.has_value(), out);
}

}  // namespace genu::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  genu::fuzz::read_as_scene(text);
  genu::fuzz::read_as_surfaces(text);
  return 0;
}
