// A model of OpenSim of any bytes: read, its joints and bodies placed, written as a scene, and that scene read again.
#include "fuzz/fuzz_checks.h"
#include "genu/osim/import_scene.h"
#include "genu/osim/read_model.h"
#include "genu/scene/reader.h"

namespace genu::fuzz {

void import(const osim::Model& model, const std::vector<std::string>& joints) {
  Diagnostics out;
  const auto skeleton = osim::Skeleton::build(model, joints, {}, out);
  require_result_or_reason(skeleton.has_value(), out);
  if (!skeleton) return;
  const osim::ImportedScene scene = osim::import_scene(model, *skeleton, {});
  require(scene.kept + scene.frozen + scene.left_out == model.items.size(), "every element has one row");
  Diagnostics of_scene;
  const auto read = parse_scene(scene.text, "scene.toml", of_scene);
  require_result_or_reason(read.has_value(), of_scene);
  for (const Diagnostic& d : of_scene.items()) require(d.code != Code::not_toml, "a scene is TOML: " + to_string(d));
}

}  // namespace genu::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace genu;
  const std::string text(reinterpret_cast<const char*>(data), size);
  Diagnostics out;
  const auto model = osim::parse_model(text, "model.osim", out);
  fuzz::require_result_or_reason(model.has_value(), out);
  if (!model) return 0;
  fuzz::import(*model, {});
  for (const osim::Joint& joint : model->joints) fuzz::import(*model, {joint.name});
  return 0;
}
