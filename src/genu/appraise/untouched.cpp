#include "genu/appraise/untouched.h"

#include <algorithm>

namespace genu {

std::vector<std::string> untouched_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                             const ResultTable& poses) {
  std::vector<std::string> names;
  for (const ContactDef& contact : prepared.scene.contacts) names.push_back(contact.name);
  for (const LayerDef& layer : prepared.scene.layers) names.push_back(layer.pair.name);
  const bool solved = std::any_of(records.begin(), records.end(), [](const auto& r) { return r.point.solved(); });
  if (names.empty() || !solved) return {};
  for (const std::string& name : names)
    for (std::size_t row = 0; row < poses.rows(); ++row)
      if (poses.number(row, name + ".force_N") > 0) return {};
  return {
      "no contact bears any load at any pose. If surfaces should touch, check the frames of the meshes and that a "
      "load presses them together"};
}

bool needs_contact(const Prepared& prepared) {
  const auto& joints = prepared.scene.joints;
  return !prepared.scene.loads.empty() && std::any_of(joints.begin(), joints.end(), [](const JointDef& joint) {
    return joint.grood_suntay && !joint.grood_suntay->patella;
  });
}

}  // namespace genu
