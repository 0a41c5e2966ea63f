// A joint ready to be solved: bodies, coordinates, ligaments, loads and surface pairs, all resolved to indices.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/model/bushing.h"
#include "genu/model/effect_meter.h"
#include "genu/model/inertia.h"
#include "genu/model/joint_coordinates.h"
#include "genu/model/joint_spring.h"
#include "genu/model/ligament_law.h"
#include "genu/model/ligament_path.h"
#include "genu/model/load.h"
#include "genu/scene/scene.h"
#include "genu/surface/surface.h"

namespace genu {

struct BoneUnder;
class ElasticLayer;

/// One for each of Scene::surfaces: in the frame of its body, or null.
using Bones = std::vector<std::shared_ptr<const BoneUnder>>;

struct JointModel {
  struct Body {
    std::string name;
    int moving = -1;  ///< index among the moving bodies, -1 for a fixed one
    /// m, in the body's frame of the file: origin of its pose and of all points on it
    Vec3 centre = Vec3::Zero();
  };
  struct Joint {
    std::string name;
    int parent, child;
    JointCoordinates coordinates;
    JointValues reference, start;
  };
  /// A coordinate that a revolute or fixed joint holds: a constraint of every pose, with a multiplier.
  struct Held {
    CoordinateRef coordinate;
    double value;  ///< rad or m
  };
  /// A coordinate, or linear combination, with a given course over time (in motion).
  struct Drive {
    QuantityRef quantity;
    LoadScale course;  ///< rad or m over s
  };
  /// The moment -damping * rate on the angle, in motion.
  struct JointDamper {
    int joint;
    double damping;  ///< N m s / rad
  };
  struct Ligament {
    std::string name;
    LigamentPath path;
    LigamentLaw law;
    double damping = 0;  ///< N s / m, in motion
  };
  struct Pair {
    std::string name;
    int body_a, body_b;
    std::shared_ptr<const Surface> a, b;
  };
  /// Two bodies that press elastic layers against each other. The index is that of Scene::layers.
  struct Layer {
    std::string name;
    int body_a, body_b;
    std::shared_ptr<const Surface> a, b;
    std::shared_ptr<const ElasticLayer> layer;
    double damping = 0;    ///< c, s/m, in motion (LayerMotion)
    double tolerance = 0;  ///< requested relative error of the force; 0: the quadrature is not refined
    int most_level = 0;
    double thinnest = 0, thickest = 0;  ///< m: of both layers together
    double search_depth = 0;            ///< m: reach of the rays
  };
  /// Characteristic length and force of the model. Every residual and unknown is scaled by them, so that forces,
  /// moments and lengths can share one norm.
  struct Scales {
    /// m: root mean square distance of force attachments (ligaments, joints) from their mean; at least 0.01 of `size`
    double length = 0.01;
    double size = 0.01;  ///< m: limit of motions in one step: length, or half of the largest surface if that is more
    /// N: the largest load or weight, or the force (moment / length) at 1 % strain (0.01 rad) of the stiffest ligament
    /// (joint)
    double force = 1;
  };

  std::vector<Body> bodies;
  int moving_count = 0;
  std::vector<Joint> joints;
  std::vector<Held> held;                  ///< joint by joint
  std::vector<JointSpring> joint_springs;  ///< of joints with a stiffness or limits
  std::vector<JointDamper> joint_dampers;  ///< these, drives and inertias: only in a scene with dynamics
  std::vector<Drive> drives;
  std::vector<Inertia> inertias;  ///< of each moving body
  std::vector<CombinationDef> combinations;
  std::vector<Ligament> ligaments;
  std::vector<Bushing> bushings;
  std::vector<Load> loads;
  std::vector<Load> weights;  ///< of moving bodies with mass, in a scene with gravity; not scaled by steps
  std::vector<Pair> pairs;    ///< rigid contacts; the index is that of Scene::contacts
  std::vector<Layer> layers;
  std::vector<Pose> reference_poses;  ///< of every body in the world
  Wraps reference_wraps;              ///< of every obstacle of a path, there: ligaments, then loads
  Scales scales;
  /// Counts evaluations if a run asks for it. Shared by copies of the model, not by threads.
  std::shared_ptr<EffectMeter> meter;
};

/// Calls add(coordinate, factor) for each term of a prescribed quantity.
template <typename Add>
void for_terms(const JointModel& model, const QuantityRef& quantity, Add add) {
  if (quantity.combination < 0) {
    add(quantity.first, 1.0);
    return;
  }
  for (const auto& term : model.combinations[static_cast<std::size_t>(quantity.combination)].terms)
    add(term.coordinate, term.factor);
}

/// Location of the joint in the world (m): mean of all ligament ends in the reference pose; the origin without
/// ligaments.
Vec3 joint_centre(const JointModel& model);

/// The value (rad or m) of a prescribable quantity, for the coordinates of every joint.
double quantity_value(const JointModel& model, const std::vector<JointValues>& coordinates,
                      const QuantityRef& quantity);

/// From the origin of a body's pose to its origin in the file, in the body (m): 0 unless centre_bodies() moved it.
inline Vec3 own_origin(const JointModel& model, int body) {
  return -model.bodies[static_cast<std::size_t>(body)].centre;
}

/// The pose of every body in the world for the coordinates of every joint; fixed bodies are at the origin.
std::vector<Pose> poses_from_coordinates(const JointModel& model, const std::vector<JointValues>& coordinates);

}  // namespace genu
