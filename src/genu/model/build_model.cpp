#include "genu/model/build_model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/model/build_layer.h"
#include "genu/model/tolerances.h"

namespace genu {
namespace {

/// Attachment points of a load on a body.
void add_points(const Load& load, int body, std::vector<Vec3>& ends) {
  if (load.kind == Load::Kind::cable)
    for (const LigamentPath::Point& point : load.path.points())
      if (point.body == body) ends.push_back(point.p);
  const bool toward = load.kind == Load::Kind::toward;
  if (load.body_a == body && (toward || !load.force.isZero())) ends.push_back(load.p_A);
  if (load.body_b == body && toward) ends.push_back(load.p_B);
}

/// Whether both models have the same surfaces in contact.
bool same_surfaces(const JointModel& a, const JointModel& b) {
  const auto alike = [](const auto& x, const auto& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](const auto& p, const auto& q) { return p.a == q.a && p.b == q.b; });
  };
  return alike(a.pairs, b.pairs) && alike(a.layers, b.layers);
}

/// `before` (may be null): a model whose surfaces need not be looked at again where they are the same.
JointModel::Scales choose_scales(const JointModel& model, const JointModel* before = nullptr) {
  JointModel::Scales scales;
  double square = 0;
  int count = 0;
  for (std::size_t body = 0; body < model.bodies.size(); ++body) {
    std::vector<Vec3> ends;
    for (const auto& l : model.ligaments) {
      const auto add = [&](const LigamentPath::Point& point) {
        if (at(point.body) == body) ends.push_back(point.p);
      };
      const auto& points = l.path.points();
      add(points.front());
      add(points.back());
      for (std::size_t k = 1; k + 1 < points.size(); ++k) add(points[k]);
    }
    for (const Bushing& b : model.bushings) {
      if (at(b.body_a) == body) ends.push_back(b.frame_a.p);
      if (at(b.body_b) == body) ends.push_back(b.frame_b.p);
    }
    for (const auto* loads : {&model.loads, &model.weights})
      for (const Load& l : *loads) add_points(l, static_cast<int>(body), ends);
    for (const auto& held : model.held) {
      if (held.coordinate.index != 3) continue;  // once per joint
      const auto& joint = model.joints[at(held.coordinate.joint)];
      const Vec3 own = own_origin(model, static_cast<int>(body));
      const JointValues& q = joint.reference;
      if (at(joint.parent) == body) ends.push_back(own + Vec3(q[3], q[4], q[5]));
      if (at(joint.child) == body) ends.push_back(own);
    }
    if (ends.size() < 2) continue;
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : ends) mean += p / static_cast<double>(ends.size());
    for (const Vec3& p : ends) square += (p - mean).squaredNorm(), ++count;
  }
  const double spread = count > 0 ? std::sqrt(square / count) : 0;
  if (spread > kLeastSpread) scales.length = spread;
  scales.size = scales.length;
  const auto grow = [&](const auto& pairs) {
    for (const auto& pair : pairs)
      for (const auto& surface : {pair.a, pair.b})
        if (!surface->is_unbounded()) scales.size = std::max(scales.size, box_diagonal(*surface, scales.length) / 2);
  };
  const bool known = before != nullptr && before->scales.length == scales.length &&
                     scales.length > kMinLengthShare * before->scales.size && same_surfaces(model, *before);
  if (known) {
    scales.size = before->scales.size;
  } else {
    grow(model.pairs);
    grow(model.layers);
  }
  // All attachments may coincide; the surfaces then give the size of the joint.
  scales.length = std::max(scales.length, kMinLengthShare * scales.size);

  double force = 0;
  for (const auto* loads : {&model.loads, &model.weights})
    for (const Load& load : *loads) force = std::max(force, load.largest_force(scales.length));
  for (const auto& l : model.ligaments) {
    const double slack = l.law.slack_length();
    const double stretched = slack > 0 ? (1 + kTypicalStrain) * slack : scales.length;
    const double value = std::abs(l.law.evaluate(stretched).force);
    if (std::isfinite(value)) force = std::max(force, value);
  }
  for (const auto& spring : model.joint_springs)
    force = std::max(force, kTypicalStrain * std::max(spring.stiffness, spring.stop) / scales.length);
  for (const Bushing& b : model.bushings) force = std::max(force, kTypicalStrain * b.largest_force(scales.length));
  scales.force = force > 0 ? force : 1.0;
  return scales;
}

std::vector<int> moving_indices(const JointModel& model) {
  std::vector<int> out;
  for (const JointModel::Body& body : model.bodies) out.push_back(body.moving);
  return out;
}

using Surfaces = std::vector<std::shared_ptr<const Surface>>;

/// A path in the scene: its points, its obstacles and where it is said.
struct PathText {
  std::string name;  ///< "ligament.MCL"
  const std::vector<PathEnd>& points;
  const std::vector<WrapDef>& wraps;
};

std::string point_name(std::size_t k, std::size_t count) {
  return k == 0 ? "its first end" : k + 1 == count ? "its last end" : fmt::format("its via point {}", k);
}

/// Says which points of a path lie inside its obstacles at the reference pose. True if none does.
bool check_inside(const JointModel& model, const LigamentPath& path, const PathText& text, const std::string& file,
                  Diagnostics& out) {
  bool good = true;
  for (const LigamentPath::Inside& inside : path.points_inside(model.reference_poses)) {
    const LigamentPath::Obstacle& o = path.obstacles()[inside.obstacle];
    if (o.ignore_inside) continue;
    good = false;
    const LigamentPath::Point& point = path.points()[inside.point];
    const Vec3 place = to::kMillimetre * (point.p + model.bodies[at(point.body)].centre);
    out.add(
        error_at({file, text.wraps[inside.obstacle].where}, Code::out_of_range, text.name + ".wrap", o.name,
                 fmt::format("{} ({:.4g}, {:.4g}, {:.4g} mm on {}) lies {:.3g} mm inside the surface: move it out, or "
                             "say inside = \"ignore\" to let the path pass through",
                             point_name(inside.point, path.points().size()), place.x(), place.y(), place.z(),
                             model.bodies[at(point.body)].name, to::kMillimetre * inside.depth)));
  }
  return good;
}

/// The path at the reference pose, its touches at the end of JointModel::reference_wraps.
std::optional<LigamentPath> path_on(const PlacedScene& scene, const Surfaces& surfaces, const PathText& text,
                                    JointModel& model, Diagnostics& out) {
  std::vector<LigamentPath::Point> points;
  for (const PathEnd& end : text.points) points.push_back({end.body, end.point});
  LigamentPath path(std::move(points));
  std::vector<LigamentPath::Obstacle> obstacles;
  for (const WrapDef& wrap : text.wraps) {
    const SurfaceDef& def = scene.surfaces[at(wrap.surface)];
    obstacles.push_back({def.name, def.body, surfaces[at(wrap.surface)], wrap.after, wrap.side, wrap.ignore_inside});
  }
  const bool wraps = !obstacles.empty();
  path.set_obstacles(std::move(obstacles), model.reference_wraps.size());
  path.move_with(moving_indices(model));
  if (!wraps) return path;
  model.reference_wraps.resize(model.reference_wraps.size() + text.wraps.size());
  if (!check_inside(model, path, text, scene.file, out)) return std::nullopt;
  if (path.find_touches(model.reference_poses, model.reference_wraps)) return path;
  out.add(error_at({scene.file, text.wraps.front().where}, Code::out_of_range, text.name + ".wrap", {},
                   "no shortest path round it is found at the reference pose: give the side, or check its points"));
  return std::nullopt;
}

void add_constraints_of(const JointDef& joint, int index, JointModel& model) {
  for (int i = 0; i < 6; ++i)
    if (!joint.leaves(i)) model.held.push_back({{index, i}, joint.reference[at(i)]});
  if (joint.stiffness > 0 || joint.limits) model.joint_springs.push_back(make_spring(joint, index));
  if (joint.damping > 0) model.joint_dampers.push_back({index, joint.damping});
}

bool make_loads(const PlacedScene& scene, const Surfaces& surfaces, JointModel& model, Diagnostics& out) {
  bool good = true;
  for (const LoadDef& def : scene.loads) {
    std::string why;
    if (auto load = make_load(scene, def, why)) {
      if (def.kind == LoadDef::Kind::cable) {
        const auto path = path_on(scene, surfaces, {"load." + def.name, def.points, def.wraps}, model, out);
        good = good && path;
        if (!path) continue;
        load->path = *path;
      }
      model.loads.push_back(std::move(*load));
      continue;
    }
    good = false;
    out.add(error_at({scene.file, def.where}, Code::out_of_range, "load." + def.name + ".scale", {}, why));
  }
  for (std::size_t i = 0; scene.dynamics && i < scene.dynamics->prescribe.size(); ++i) {
    const DynamicsDef::Drive& def = scene.dynamics->prescribe[i];
    std::string why;
    if (auto course = LoadScale::make(def.course, why)) {
      model.drives.push_back({def.quantity, std::move(*course)});
      continue;
    }
    good = false;
    out.add(error_at({scene.file, def.where}, Code::out_of_range,
                     "dynamics.prescribe." + quantity_name(scene, def.quantity), {}, why));
  }
  for (std::size_t i = 0; scene.gravity && i < scene.bodies.size(); ++i)
    if (scene.bodies[i].has_weight()) model.weights.push_back(make_weight(scene, scene.bodies[i], static_cast<int>(i)));
  return good;
}

}  // namespace

void add_ligament(JointModel& model, JointModel::Ligament ligament) {
  ligament.path.move_with(moving_indices(model));
  model.ligaments.push_back(std::move(ligament));
  model.scales = choose_scales(model);
}

std::optional<JointModel> build_model(const PlacedScene& scene,
                                      const std::vector<std::shared_ptr<const Surface>>& surfaces, Diagnostics& out,
                                      const Bones& bones, const BuiltBefore& before) {
  JointModel model;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BodyDef& body = scene.bodies[b];
    model.bodies.push_back({body.name, body.fixed ? -1 : model.moving_count++, scene.origins[b]});
  }
  for (const BodyDef& body : scene.bodies)
    if (scene.dynamics && !body.fixed) model.inertias.push_back({body.mass, body.centre_of_mass, body.inertia});
  std::vector<JointValues> reference;
  for (const JointDef& joint : scene.joints) {
    const JointCoordinates coordinates(joint, scene.origins[at(joint.parent)], scene.origins[at(joint.child)]);
    model.joints.push_back(
        {joint.name, joint.parent, joint.child, coordinates, joint.reference, joint.start.value_or(joint.reference)});
    reference.push_back(joint.reference);
    add_constraints_of(joint, static_cast<int>(model.joints.size()) - 1, model);
  }
  model.combinations = scene.combinations;
  model.reference_poses = poses_from_coordinates(model, reference);

  bool good = true;
  for (const LigamentDef& def : scene.ligaments) {
    std::string why;
    const std::vector<PathEnd> points = def.path_points();
    const auto path = path_on(scene, surfaces, {"ligament." + def.name, points, def.wraps}, model, out);
    good = good && path;
    if (!path) continue;
    const auto law = make_law(def, path->length(model.reference_poses, model.reference_wraps), why);
    if (!law) {
      good = false;
      out.add(error_at({scene.file, def.where}, Code::out_of_range, "ligament." + def.name, {}, why));
      continue;
    }
    model.ligaments.push_back({def.name, *path, *law, def.damping});
  }
  for (const BushingDef& def : scene.bushings) model.bushings.push_back(make_bushing(def));
  good = make_loads(scene, surfaces, model, out) && good;
  for (const ContactDef& contact : scene.contacts) {
    const SurfaceDef& a = scene.surfaces[at(contact.surface_a)];
    const SurfaceDef& b = scene.surfaces[at(contact.surface_b)];
    model.pairs.push_back(
        {contact.name, a.body, b.body, surfaces[at(contact.surface_a)], surfaces[at(contact.surface_b)]});
  }
  for (const LayerDef& layer : scene.layers) {
    const int a = layer.pair.surface_a, b = layer.pair.surface_b;
    model.layers.push_back({layer.pair.name, scene.surfaces[at(a)].body, scene.surfaces[at(b)].body, surfaces[at(a)],
                            surfaces[at(b)], nullptr});
  }
  if (!good) return std::nullopt;
  model.scales = choose_scales(model, before.model);
  for (std::size_t k = 0; k < scene.layers.size(); ++k)
    good = (share_layer(scene, before, model, k) || build_layer(scene, bones, model, k, out)) && good;
  if (!good) return std::nullopt;
  return model;
}

}  // namespace genu
