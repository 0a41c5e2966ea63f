#include <algorithm>

#include "genu/osim/model_draft.h"

namespace genu::osim {
namespace {

struct Spring {
  double stiffness = 0, rest = 0, viscosity = 0;
};

/// A load that is feedback of its own coordinate, to a target that stays.
bool is_spring(const LoadDef& l, Spring& spring) {
  if (l.kind != LoadDef::Kind::coordinate || !l.scale || l.scale->kind != ScaleDef::Kind::feedback) return false;
  if (!(l.scale->coordinate == l.coordinate) || l.in_time()) return false;
  const auto& target = l.scale->target;
  spring = {l.value * l.scale->gain, target && !target->table.empty() ? target->table.front().second : 0,
            l.value * l.scale->rate_gain};
  return true;
}

void write_spring(const std::string& name, const std::string& coordinate, const Spring& spring, XmlWriter& out) {
  out.open("SpringGeneralizedForce", name);
  out.text("coordinate", coordinate);
  out.number("stiffness", spring.stiffness);
  out.number("rest_length", spring.rest);
  out.number("viscosity", spring.viscosity);
  out.close("SpringGeneralizedForce");
}

}  // namespace

void write_other_loads(ModelDraft& draft, XmlWriter& out) {
  for (const LoadDef& l : draft.scene.loads) {
    if (l.kind == LoadDef::Kind::cable) continue;
    Spring spring;
    if (is_spring(l, spring)) {
      write_spring(l.name, draft.coordinate(l.coordinate), spring, out);
      draft.kept("load", l.name, "/forceset/" + l.name);
    } else {
      draft.left_out("load", l.name,
                     "WARNING: OpenSim takes loads from files of its tools (ExternalLoads), not from the model");
    }
  }
  for (const BushingDef& b : draft.scene.bushings)
    draft.left_out("bushing", b.name, "WARNING: a BushingForce of OpenSim measures rotation by other angles");
  for (int j = 0; at(j) < draft.scene.joints.size(); ++j) {
    const JointDef& joint = draft.scene.joints[at(j)];
    if (joint.type == JointDef::Type::revolute && joint.stiffness != 0)
      write_spring(joint.name + "_stiffness", draft.coordinate({j, 0}), {joint.stiffness, 0, joint.damping}, out);
  }
}

}  // namespace genu::osim
