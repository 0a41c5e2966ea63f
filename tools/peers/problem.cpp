#include "peers/problem.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "genu/contact/elastic_layer.h"
#include "genu/core/units.h"
#include "genu/model/build_model.h"
#include "genu/model/contact_field.h"
#include "genu/scene/reader.h"
#include "genu/study/run_scene.h"
#include "peers/plain_layer.h"

namespace genu::peers {
namespace {

Point point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// What in a scene the programs do not know; empty for a knee that all can solve.
std::string unknown_part(const Prepared& p) {
  const PlacedScene& s = p.scene;
  if (s.bodies.size() != 2 || s.joints.size() != 1) return "two bodies and a joint";
  const JointDef& joint = s.joints[0];
  if (joint.type != JointDef::Type::free || !s.bodies[static_cast<std::size_t>(joint.parent)].fixed)
    return "a free joint on a fixed body";
  for (int i = 0; i < 3; ++i)
    if (joint.rotations[static_cast<std::size_t>(i)].axis != Vec3::Unit(i)) return "rotations about x, y and z";
  if (!s.layers.empty() || !s.loads.empty() || s.gravity || s.dynamics) return "rigid contacts and ligaments alone";
  for (const ContactDef& c : s.contacts) {
    const SurfaceDef& a = s.surfaces[static_cast<std::size_t>(c.surface_a)];
    const SurfaceDef& b = s.surfaces[static_cast<std::size_t>(c.surface_b)];
    if (a.body != joint.child || b.body != joint.parent || b.shape != SurfaceDef::Shape::plane || b.inside)
      return "contacts of a condyle on a plane";
  }
  const auto quadratic = [&](const LigamentDef& l) {
    return l.law == "quadratic" && l.path_points().size() == 2 && l.from.body == joint.child &&
           l.to.body == joint.parent;
  };
  if (!std::all_of(s.ligaments.begin(), s.ligaments.end(), quadratic)) return "straight quadratic ligaments";
  const auto& steps = p.steps;
  if (steps.size() != 1 || steps[0].prescribed.size() != 1 || steps[0].prescribed[0].coordinate != QuantityRef(0, 0))
    return "one step that prescribes the first rotation";
  return {};
}

}  // namespace

std::optional<Knee> make_knee(const Prepared& prepared, Diagnostics& out) {
  if (const std::string part = unknown_part(prepared); !part.empty()) {
    out.error(Code::not_applicable, prepared.scene.file, "is no knee that can be compared, which has " + part);
    return std::nullopt;
  }
  const PlacedScene& scene = prepared.scene;
  const JointModel& model = prepared.model;
  const JointDef& joint = scene.joints[0];
  const Vec3 femur = scene.origins[static_cast<std::size_t>(joint.child)];
  const Vec3 tibia = scene.origins[static_cast<std::size_t>(joint.parent)];
  Knee knee;
  knee.start = joint.start.value_or(joint.reference);
  knee.length = model.scales.length;
  const StepPlan& step = prepared.steps[0];
  for (int k = 0; k <= step.increments; ++k)
    knee.flexions.push_back(step.target(static_cast<double>(k) / step.increments).prescribed[0].value);
  for (std::size_t k = 0; k < scene.ligaments.size(); ++k) {
    const LigamentDef& def = scene.ligaments[k];
    knee.springs.push_back({point(def.from.point + femur), point(def.to.point + tibia), def.number("stiffness"),
                            model.ligaments[k].law.slack_length()});
  }
  for (const ContactDef& contact : scene.contacts) {
    const Pose& plane = scene.surfaces[static_cast<std::size_t>(contact.surface_b)].placement;
    knee.pairs.push_back({scene.surfaces[static_cast<std::size_t>(contact.surface_a)].name + ".stl",
                          point(plane.p + tibia), point(plane.R.col(2))});
  }
  return knee;
}

namespace {

constexpr double kLayerThickness = 5e-3;  // m: of a linear law without lateral strain the stiffness alone matters
constexpr double kPlateau = 40e-3;        // m: a layer needs a plane with an end; no contact comes near it

/// The scene with the meshes in `folder` for its condyles.
std::optional<Scene> meshed_scene(const std::string& scene, const std::string& folder, Diagnostics& out) {
  auto meshed = read_scene(scene, out);
  if (!meshed) return std::nullopt;
  for (const ContactDef& contact : meshed->contacts) {
    SurfaceDef& condyle = meshed->surfaces[static_cast<std::size_t>(contact.surface_a)];
    condyle.shape = SurfaceDef::Shape::mesh;
    condyle.file = (std::filesystem::path(folder) / (condyle.name + ".stl")).string();
    condyle.file_unit = units::kMillimetre;
    condyle.placement = Pose{};
  }
  return meshed;
}

/// What the layers of a model do to the femur at a state: force, and moment about the origin of its file.
Vec6 wrench_of_layers(const JointModel& model, const State& state) {
  Vec6 wrench = Vec6::Zero();
  for (const JointModel::Layer& layer : model.layers) {
    const Pose& X = state.poses[static_cast<std::size_t>(layer.body_a)];
    ElasticLayer::Memory memory;
    LayerWrench pressed;
    layer.layer->evaluate(X, state.poses[static_cast<std::size_t>(layer.body_b)], memory, pressed);
    wrench += pressed.wrench.head<6>();
    wrench.tail<3>() -= (X.R * own_origin(model, layer.body_a)).cross(pressed.wrench.head<3>());
  }
  return wrench;
}

}  // namespace

std::optional<Prepared> prepare_knee(const std::string& scene, const std::string& folder, Diagnostics& out) {
  auto closed_forms = prepare(scene, out);
  if (!closed_forms || folder.empty()) return closed_forms;
  if (!make_knee(*closed_forms, out)) return std::nullopt;
  auto meshed = meshed_scene(scene, folder, out);
  if (!meshed) return std::nullopt;
  return prepare(std::move(*meshed), std::make_shared<MeshLibrary>(), out);
}

std::optional<Prepared> prepare_layers(const std::string& scene, const std::string& folder, const Layers& layers,
                                       Diagnostics& out) {
  const auto closed_forms = prepare(scene, out);
  if (!closed_forms || !make_knee(*closed_forms, out)) return std::nullopt;
  auto meshed = meshed_scene(scene, folder, out);
  if (!meshed) return std::nullopt;
  for (const ContactDef& contact : std::exchange(meshed->contacts, {})) {
    LayerDef layer;
    layer.pair = contact;
    layer.modulus = layers.stiffness * kLayerThickness;
    layer.thickness = layer.search_depth = kLayerThickness;
    layer.quadrature = LayerDef::Quadrature::triangles;
    layer.cast_from = contact.surface_a;
    meshed->layers.push_back(layer);
    SurfaceDef::Patch& patch = meshed->surfaces[static_cast<std::size_t>(contact.surface_b)].patch.emplace();
    patch.box[0] = patch.box[1] = std::pair(-kPlateau, kPlateau);
  }
  auto prepared = prepare(std::move(*meshed), std::make_shared<MeshLibrary>(), out);
  const LayerLaw law{LayerLaw::Kind::linear, layers.stiffness * kLayerThickness};
  if (prepared && layers.plain) make_layers_plain(prepared->model, law, kLayerThickness);
  return prepared;
}

FoundPath solve_path(const Prepared& prepared) {
  ContactField field(prepared.model);
  FoundPath found;
  const double before = processor_seconds();
  const Solution solution = solve(prepared, field, {});
  found.seconds = processor_seconds() - before;
  const JointDef& joint = prepared.scene.joints[0];
  for (const PoseRecord& record : solution.records) {
    const State& state = record.point.pose.state;
    FoundPose& pose = found.poses.emplace_back();
    pose.settled = record.point.solved();
    if (!pose.settled) continue;
    pose.coordinates = state.coordinates[0];
    Vec6 wrench = wrench_of_layers(prepared.model, state);
    for (const ActiveContact& c : state.contacts) {
      const Pose& X = state.poses[static_cast<std::size_t>(joint.child)];
      const Vec3 force = -c.force * (X.R * c.geometry.a.n);
      const Vec3 arm = X.R * (c.geometry.a.p - own_origin(prepared.model, joint.child));
      wrench += (Vec6() << force, arm.cross(force)).finished();
    }
    std::copy(wrench.begin(), wrench.end(), pose.contact.begin());
  }
  return found;
}

}  // namespace genu::peers
