#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "genu/core/units.h"
#include "genu/law/laws.h"
#include "genu/scene/law_values.h"
#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"

namespace genu {

namespace {

/// The joint whose child is `body`, or -1.
int joint_above(const SceneTables& scene, int body) {
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    if (scene.joints[j].child == body) return static_cast<int>(j);
  }
  return -1;
}

/// True if going from parent to parent leads from `body` back to itself.
bool is_own_ancestor(const SceneTables& scene, int body) {
  int at = body;
  for (std::size_t steps = 0; steps <= scene.joints.size(); ++steps) {
    const int joint = joint_above(scene, at);
    if (joint < 0) return false;
    at = scene.joints[static_cast<std::size_t>(joint)].parent;
    if (at < 0) return false;
    if (at == body) return true;
  }
  return false;
}

/// Every moving body is the child of a joint, and parents lead to a fixed body. True if the tree is sound.
bool check_tree(ReadContext& context) {
  const Scene& scene = context.scene;
  bool ends_known = context.bodies_understood;
  for (const JointDef& joint : scene.joints) ends_known = ends_known && joint.parent >= 0 && joint.child >= 0;
  if (!ends_known) return false;  // each is reported already, and what follows from it would only confuse
  bool sound = true;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BodyDef& body = scene.bodies[b];
    const int above = joint_above(scene, static_cast<int>(b));
    sound = sound && body.fixed == (above < 0);
    if (above < 0 && !body.fixed) {
      context.error(body.where, Code::missing_key, "body." + body.name, {},
                    "a moving body must be the child of one joint");
    }
  }
  for (const JointDef& joint : scene.joints) {
    if (joint.parent == joint.child || !is_own_ancestor(scene, joint.child)) continue;
    context.error(joint.where, Code::conflict, "joint." + joint.name, {},
                  "parents go round in a circle: they must lead to a fixed body");
    return false;  // one report a scene: the other joints of the circle would say the same
  }
  for (const JointDef& joint : scene.joints) sound = sound && joint.parent != joint.child;
  return sound;
}

Pose reference_pose(const JointDef& joint) {
  Pose pose;
  for (std::size_t k = 0; k < 3; ++k) {
    pose.R = Mat3(pose.R * exp_rotation(joint.reference[k] * joint.rotations[k].axis));
    pose.p[static_cast<Eigen::Index>(k)] = joint.reference[3 + k];
  }
  return pose;
}

/// What is wrong with a ligament of more than one line, bodies at `poses`; empty if nothing is.
std::string path_rule_broken(const LigamentDef& ligament, const std::vector<Pose>& poses) {
  const std::vector<LigamentDef::End> points = ligament.path_points();
  const auto place = [&](std::size_t k) -> Vec3 { return poses[at(points[k].body)] * points[k].point; };
  const auto name = [&](std::size_t k) {
    return k == 0 ? "its first end" : k + 1 == points.size() ? "its last end" : fmt::format("via point {}", k);
  };
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    if ((place(k + 1) - place(k)).norm() <= kCoincidentDistance)
      return fmt::format("{} and {} coincide at the reference pose", name(k), name(k + 1));
  return {};
}

/// What is wrong with a ligament of this length (m) at the reference pose; empty if nothing is.
std::string length_rule_broken(const LigamentDef& ligament, double length) {
  const LawKind* law = find_law(ligament.law);
  if (law == nullptr) return {};
  // The direction of the force is undefined at zero length, except for a spring, which may have no force there.
  if (!law->both_ways) {
    return length > kCoincidentDistance
               ? std::string()
               : "the two ends coincide at the reference pose; only law \"spring\" may have zero length";
  }
  if (ligament.rest != LigamentDef::Rest::reference_force) return {};
  const auto slack = law->slack_length_for(law_values(*law, ligament), ligament.rest_value, length);
  if (!slack || *slack >= 0) return {};
  return fmt::format("reference_force asks for a slack length of {:g} mm, which must be >= 0 mm",
                     *slack / units::kMillimetre);
}

/// The strain of a ligament of this length; 0 where its law says none, or the file does.
double strain_at(const LigamentDef& ligament, double length) {
  const LawKind* law = find_law(ligament.law);
  if (law == nullptr || law->both_ways) return 0;
  if (ligament.rest == LigamentDef::Rest::reference_strain)
    return ligament.rest_value > kMostStrain ? 0 : ligament.rest_value;  // one in percent is reported at its key
  const auto slack = ligament.rest == LigamentDef::Rest::slack_length
                         ? std::optional(ligament.rest_value)
                         : law->slack_length_for(law_values(*law, ligament), ligament.rest_value, length);
  return slack && *slack > 0 ? length / *slack - 1 : 0;
}

/// A stretch that tears ligaments is probably another unit, point or pose.
void warn_stretched(ReadContext& context, const LigamentDef& ligament, double length) {
  constexpr const char* kKeys[] = {"slack_length", "reference_strain", "reference_force"};
  const double strain = strain_at(ligament, length);
  if (!(strain > kMostReferenceStrain)) return;
  const bool in_length = ligament.rest == LigamentDef::Rest::slack_length;
  const double unit = in_length ? context.scene.length_unit : 1;
  std::string meant = "check its stiffness, its points and the joint's reference";
  if (in_length)
    meant = fmt::format("was about {:.4g} {} meant? Else check its points and the joint's reference", length / unit,
                        context.length_name);
  context.warning(ligament.rest_where, Code::unlikely,
                  "ligament." + ligament.name + "." + kKeys[static_cast<int>(ligament.rest)],
                  fmt::format("{:g}", ligament.rest_value / unit),
                  fmt::format("stretches it by {:.3g} % at the reference pose, where it is {:.4g} mm long; ligaments "
                              "fail at 10 to 30 %: {}",
                              100 * strain, to::kMillimetre * length, meant));
}

void check_lengths(ReadContext& context) {
  const Scene& scene = context.scene;
  const std::vector<Pose> poses = reference_poses(scene);
  for (const LigamentDef& ligament : scene.ligaments) {
    const std::vector<LigamentDef::End> points = ligament.path_points();
    if (std::any_of(points.begin(), points.end(), [](const auto& end) { return end.body < 0; })) continue;
    std::string broken = points.size() == 2 ? std::string() : path_rule_broken(ligament, poses);
    const double length = path_length(ligament, poses);
    // With wraps the length is known when the surfaces are built.
    if (broken.empty() && ligament.wraps.empty()) broken = length_rule_broken(ligament, length);
    if (broken.empty() && ligament.wraps.empty())
      warn_stretched(context, ligament, length);
    else if (!broken.empty())
      context.error(ligament.where, Code::out_of_range, "ligament." + ligament.name, {}, std::move(broken));
  }
}

/// A force toward a point needs a direction to begin with.
void check_directions(ReadContext& context) {
  const Scene& scene = context.scene;
  const std::vector<Pose> poses = reference_poses(scene);
  for (const LoadDef& load : scene.loads) {
    if (load.kind != LoadDef::Kind::toward || load.body < 0 || load.toward_body < 0) continue;
    const Vec3 from = poses[static_cast<std::size_t>(load.body)] * load.point;
    const Vec3 to = poses[static_cast<std::size_t>(load.toward_body)] * load.toward_point;
    if ((to - from).norm() > kCoincidentDistance) continue;
    context.error(load.where, Code::conflict, "load." + load.name, {},
                  "its two points coincide at the reference pose: the force has no direction");
  }
}

/// The names of the columns of results.csv, to refuse scenes in which two objects would share one.
class Columns {
 public:
  explicit Columns(ReadContext& context) : context_(context) {}

  void add(const std::string& object, SourceLocation where, const std::string& column) {
    const auto [at, is_new] = owner_.emplace(column, object);
    if (is_new || object == last_refused_) return;
    last_refused_ = object;  // one report an object
    context_.error(where, Code::duplicate, object, {},
                   fmt::format("its result column {} is also one of {}: rename one of the two", column, at->second));
  }

 private:
  ReadContext& context_;
  std::map<std::string, std::string> owner_;
  std::string last_refused_;
};

void add_joint(const JointDef& joint, Columns& columns) {
  const std::string object = "joint." + joint.name;
  for (int k = 0; k < 6; ++k) {
    if (!joint.leaves(k)) continue;
    const auto i = static_cast<std::size_t>(k);
    columns.add(object, joint.where,
                joint.name + "." + (k < 3 ? joint.rotations[i].name + "_deg" : joint.translations[i - 3] + "_mm"));
  }
}

void add_contact(const Scene& scene, const ContactDef& contact, Columns& columns) {
  const std::string object = "contact." + contact.name;
  for (const char* quantity : {".force_N", ".gap_mm"}) columns.add(object, contact.where, contact.name + quantity);
  for (const int surface : {contact.surface_a, contact.surface_b}) {
    if (surface < 0 || contact.surface_a == contact.surface_b) continue;
    const std::string& name = scene.surfaces[static_cast<std::size_t>(surface)].name;
    columns.add(object, contact.where, contact.name + "." + name + ".x_mm");
  }
  for (const RegionDef& region : contact.regions) {
    columns.add(object, contact.where, contact.name + "." + region.name + ".x_mm");
  }
}

void check_columns(ReadContext& context) {
  const Scene& scene = context.scene;
  Columns columns(context);
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    if (context.joint_understood[j]) add_joint(scene.joints[j], columns);
  }
  for (std::size_t k = 0; k < scene.combinations.size(); ++k) {
    const CombinationDef& c = scene.combinations[k];
    if (!context.combination_understood[k]) continue;
    columns.add("combination." + c.name, c.where, c.name + (c.terms[0].coordinate.index < 3 ? "_deg" : "_mm"));
  }
  for (const ContactDef& contact : scene.contacts) add_contact(scene, contact, columns);
  for (const LayerDef& layer : scene.layers) add_contact(scene, layer.pair, columns);
  for (const LigamentDef& ligament : scene.ligaments) {
    for (const char* quantity : {".length_mm", ".strain", ".force_N"}) {
      columns.add("ligament." + ligament.name, ligament.where, ligament.name + quantity);
    }
  }
  for (const BundleDef& bundle : scene.bundles)
    for (const char* quantity : {".strain", ".force_N"})
      columns.add("bundle." + bundle.name, bundle.where, bundle.name + quantity);
  for (const BushingDef& bushing : scene.bushings)
    for (const char* quantity : {".x_mm", ".force_x_N"})
      columns.add("bushing." + bushing.name, bushing.where, bushing.name + quantity);
  for (const CompartmentDef& c : scene.compartments) columns.add("compartment." + c.name, c.where, c.name + ".force_N");
  for (const LoadDef& load : scene.loads)
    if (load.kind == LoadDef::Kind::cable) columns.add("load." + load.name, load.where, load.name + ".length_mm");
}

}  // namespace

std::vector<Pose> reference_poses(const SceneTables& scene) {
  std::vector<Pose> poses(scene.bodies.size());
  for (std::size_t b = 0; b < poses.size(); ++b) {
    Pose pose;  // X_ancestor_body, from the body up to a fixed one
    for (int j = joint_above(scene, static_cast<int>(b)); j >= 0;) {
      const JointDef& joint = scene.joints[static_cast<std::size_t>(j)];
      pose = reference_pose(joint) * pose;
      j = joint_above(scene, joint.parent);
    }
    poses[b] = pose;
  }
  return poses;
}

void check_scene(ReadContext& context) {
  check_thickness_used(context);
  check_columns(context);
  if (!check_tree(context)) return;
  place_bushings(context.scene);
  check_lengths(context);
  check_directions(context);
}

}  // namespace genu
