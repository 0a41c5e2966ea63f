#include "genu/study/laxity_loads.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "genu/core/units.h"
#include "genu/model/build_model.h"
#include "genu/scene/centre_bodies.h"
#include "genu/study/run_motion.h"
#include "genu/study/tolerances.h"

namespace genu {

const char* LaxityTest::name() const {
  constexpr const char* kNames[] = {"drawer", "varus-valgus", "rotation"};
  return kNames[static_cast<int>(kind)];
}

std::string LaxityTest::direction(bool positive) const {
  constexpr const char* kNames[][2] = {{"posterior", "anterior"}, {"valgus", "varus"}, {"external", "internal"}};
  return kNames[static_cast<int>(kind)][positive ? 1 : 0];
}

double LaxityTest::shown() const { return turns() ? to::kDegree : to::kMillimetre; }

double LaxityTest::displacement(const KneeMotion& motion) const {
  switch (kind) {
    case Kind::drawer:
      return motion.anterior;
    case Kind::varus:
      return motion.adduction;
    case Kind::rotation:
      break;
  }
  return -motion.external_rotation;
}

namespace {

/// Index of the one joint with anatomical axes; -1, said in `out`, without one.
int clinical_joint(const Scene& scene, Diagnostics& out) {
  int found = -1;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const JointDef& joint = scene.joints[j];
    if (!joint.grood_suntay || joint.grood_suntay->patella) continue;
    if (found >= 0) {
      out.add(error_at({scene.file, joint.where}, Code::conflict, "joint." + joint.name, {},
                       "is the second joint with grood_suntay: laxity is of one knee"));
      return -1;
    }
    found = static_cast<int>(j);
  }
  if (found < 0)
    out.error(Code::missing_key, scene.file,
              "no joint has grood_suntay, which says where anterior and proximal are: add to [joint.NAME] of the knee "
              "grood_suntay = { side = \"right\", femur = { body = \"femur\", proximal = \"y\", anterior = \"x\" }, "
              "tibia = { body = \"tibia\", proximal = \"y\", anterior = \"x\" } } (`genu explain grood_suntay`)");
  return found;
}

/// Whether the joint's rotations are those of Grood and Suntay: about the femur's flexion axis, the floating axis, the
/// tibia's long axis. Then `sign` is that of the second rotation, +1 for varus.
bool turns_as_clinicians(const JointDef& joint, const GroodSuntayDef& axes, double& sign) {
  const Vec3 e1 = axes.femur.anterior.cross(axes.femur.proximal), e3 = axes.tibia.proximal;
  const Vec3& a1 = joint.rotations[0].axis;
  const Vec3& a2 = joint.rotations[1].axis;
  const Vec3& a3 = joint.rotations[2].axis;
  if (joint.type != JointDef::Type::free || joint.parent != axes.femur.body) return false;
  if (a1.cross(e1).norm() > kSameAxis || a3.cross(e3).norm() > kSameAxis) return false;
  if (std::abs(a2.dot(a1)) > kSameAxis || std::abs(a2.dot(a3)) > kSameAxis) return false;
  sign = (a2.dot(e3.cross(e1)) > 0) == axes.right ? 1 : -1;
  return true;
}

/// Of flexion about the joint's first rotation; empty where that turns about another axis than the femur's flexion
/// axis.
std::optional<double> flexion_sign(const JointDef& joint, const GroodSuntayDef& axes) {
  const Vec3 flexion = axes.femur.proximal.cross(axes.femur.anterior);
  const Vec3& turned = joint.rotations[0].axis;
  if (joint.parent != axes.femur.body || turned.cross(flexion).norm() > kFlexionTilt) return std::nullopt;
  return turned.dot(flexion) > 0 ? 1 : -1;
}

/// Whether nothing can move the body.
bool is_held(const Scene& scene, int body) {
  if (scene.bodies[at(body)].fixed) return true;
  return std::any_of(scene.joints.begin(), scene.joints.end(), [&](const JointDef& joint) {
    return joint.child == body && joint.type == JointDef::Type::fixed && is_held(scene, joint.parent);
  });
}

/// Names of what the last step prescribes besides the first rotation of a joint.
std::vector<std::string> freed_by_test(const Prepared& prepared, int joint) {
  std::vector<std::string> names;
  if (prepared.steps.empty()) return names;
  for (const auto& p : prepared.steps.back().prescribed)
    if (!(p.coordinate == QuantityRef(joint, 0))) names.push_back(quantity_name(prepared.scene, p.coordinate));
  return names;
}

LoadDef on_tibia(const std::string& name, const GroodSuntayDef& axes) {
  LoadDef load;
  load.name = name;
  load.body = axes.tibia.body;
  load.point = axes.tibia.origin;
  load.frame = LoadDef::Frame::body;
  return load;
}

}  // namespace

std::optional<LaxityJoint> with_laxity_loads(const Prepared& prepared, Diagnostics& out) {
  LaxityJoint made{prepared, clinical_joint(prepared.source, out), {}, -1, 1, true};
  if (made.joint < 0 || refuse_motion(prepared, "laxity", out)) return std::nullopt;
  Scene& scene = made.prepared.source;
  const JointDef& joint = scene.joints[static_cast<std::size_t>(made.joint)];
  const GroodSuntayDef& axes = *joint.grood_suntay;
  if (scene.bodies[static_cast<std::size_t>(axes.tibia.body)].fixed || joint.type != JointDef::Type::free) {
    out.add(error_at({scene.file, joint.where}, Code::not_applicable, "joint." + joint.name, {},
                     "laxity needs a free joint whose tibia moves: fix the femur instead"));
    return std::nullopt;
  }
  if (!is_held(scene, axes.femur.body)) {
    const BodyDef& femur = scene.bodies[at(axes.femur.body)];
    out.add(error_at({scene.file, femur.where}, Code::not_applicable, "body." + femur.name, {},
                     "can move, and the loads of a laxity test would turn it as well: fix it, or hold it by joints of "
                     "type \"fixed\""));
    return std::nullopt;
  }
  made.freed = freed_by_test(prepared, made.joint);
  const auto sign_of_flexion = flexion_sign(joint, axes);
  if (!sign_of_flexion) {
    out.add(error_at({scene.file, joint.where}, Code::not_applicable, "joint." + joint.name, {},
                     "laxity prescribes flexion, and the first rotation of this joint, " + joint.rotations[0].name +
                         ", is not about the femur's flexion axis (grood_suntay: anterior x proximal): let the femur "
                         "be the parent and name flexion first"));
    return std::nullopt;
  }
  made.flexion_sign = *sign_of_flexion;
  if (!scene.steps.empty())
    for (const StepDef::Prescribed& p : scene.steps.back().prescribe)
      if (!p.drivers.empty()) {
        out.add(error_at({scene.file, scene.steps.back().where}, Code::not_applicable, "drive", {},
                         "laxity needs loads of known size, and the last step searches the factor of " +
                             scene.loads[at(p.drivers.front())].name + ": give it in `load`"));
        return std::nullopt;
      }
  const double side = axes.right ? 1 : -1;
  LoadDef drawer = on_tibia("laxity_drawer", axes), varus = on_tibia("laxity_varus", axes),
          rotation = on_tibia("laxity_rotation", axes), compression = on_tibia("laxity_compression", axes);
  drawer.force = axes.tibia.anterior;
  rotation.moment = side * axes.tibia.proximal;
  compression.force = axes.tibia.proximal;
  double sign = 1;
  made.floating = turns_as_clinicians(joint, axes, sign);
  if (made.floating) {
    varus.kind = LoadDef::Kind::coordinate;
    varus.coordinate = {made.joint, 1};
    varus.value = sign;
  } else {
    varus.moment = side * axes.tibia.anterior;
  }
  for (LoadDef* load : {&drawer, &varus, &rotation, &compression}) scene.loads.push_back(*load);
  const int first = static_cast<int>(prepared.source.loads.size());
  made.loads = {first, first + 1, first + 2};
  made.compression = first + 3;
  made.prepared.scene = place(scene, prepared.scene.origins);
  auto model = build_model(made.prepared.scene, made.prepared.surfaces, out, made.prepared.bones,
                           {&prepared.scene, &prepared.model});
  if (!model) return std::nullopt;
  model->meter = std::make_shared<EffectMeter>();
  made.prepared.model = std::move(*model);
  return made;
}

StepPlan laxity_step(const LaxityJoint& knee, double compression, double flexion, int load, double from, double to,
                     int increments) {
  const Prepared& p = knee.prepared;
  StepPlan plan;
  const double angle = knee.flexion_sign * flexion;
  plan.prescribed = {{QuantityRef(knee.joint, 0), angle, angle}};
  plan.increments = increments;
  const StepPlan* last = p.steps.empty() ? nullptr : &p.steps.back();
  plan.start_time = plan.end_time = last ? last->end_time : 0;
  plan.factors.assign(p.scene.loads.size(), {0, 0});
  for (std::size_t k = 0; last && k < last->factors.size(); ++k)
    plan.factors[k] = {last->factors[k].to, last->factors[k].to};
  plan.factors[at(knee.compression)] = {compression, compression};
  if (load >= 0) plan.factors[at(load)] = {from, to};
  return plan;
}

}  // namespace genu
