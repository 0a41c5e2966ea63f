// The rigid bodies of a scene: the bodies of a model that move on the joints asked for, everything else frozen.
//
// Forward kinematics of the whole file at one pose: X_ground_body = X_ground_parentframe X_joint(q) X_childframe_body.
// Bodies that no joint asked for separates are one rigid body, which has the frame that its joint moves.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/osim/frames.h"
#include "genu/osim/joint_kinds.h"
#include "genu/osim/model.h"

namespace genu::osim {

/// Values of coordinates by name, rad or m.
using CoordinateValues = std::map<std::string, double>;

/// Several bodies of the model as one of the scene.
struct RigidBody {
  int named_after = -1;  ///< index into Model::bodies, or their number: the ground
  bool fixed = false;
  std::vector<int> bodies;  ///< all of them
  double mass = 0;
  Vec3 centre = Vec3::Zero();   ///< of mass, in the rigid body
  Mat3 inertia = Mat3::Zero();  ///< about that centre, axes of the rigid body
};

class Skeleton {
 public:
  /// Moves the joints of these names alone, everything else as at `values` (defaults of the file where they name no
  /// coordinate). Without names: every joint with six free axes that does not hang on the ground. Empty, with errors in
  /// `out`, where a name is unknown or a joint cannot be one of a scene.
  static std::optional<Skeleton> build(const Model& model, const std::vector<std::string>& joints,
                                       const CoordinateValues& values, Diagnostics& out);

  const std::vector<RigidBody>& bodies() const { return bodies_; }
  const std::vector<MovingJoint>& joints() const { return joints_; }
  /// The value of a coordinate at the pose, rad or m.
  double value(const std::string& coordinate) const;
  /// Whether a coordinate belongs to a joint that moves.
  bool moves(const std::string& coordinate) const;
  /// Whether a coordinate is driven, through couplers, by one that moves.
  bool follows_what_moves(const std::string& coordinate) const;
  bool moves_joint(const std::string& joint) const;

  /// A frame of the model by its path.
  PlacedFrame frame(const std::string& path) const;
  /// Index into bodies() of the rigid body with that body of the model.
  int rigid_body(int body) const { return rigid_of_[at(body)]; }
  /// X_rigid_body.
  const Pose& in_rigid(int body) const { return in_rigid_[at(body)]; }
  /// A point or frame of the model in the rigid body that has it.
  Pose in_rigid(const PlacedFrame& placed) const { return in_rigid(placed.body) * placed.X_body_frame; }
  /// X_ground_rigid at the pose.
  Pose rigid_in_ground(int rigid) const;
  const std::string& body_name(int body) const;

 private:
  explicit Skeleton(const Model& model) : model_(&model) {}
  struct Link {
    PlacedFrame parent, child;
  };

  bool link_joints(Diagnostics& out);
  void settle_values(const CoordinateValues& values);
  double settled(const std::string& coordinate, const CoordinateValues& values) const;
  const Coupler* driver_of(const std::string& coordinate) const;
  bool choose_joints(const std::vector<std::string>& names, Diagnostics& out);
  bool place_bodies(Diagnostics& out);
  void unite_bodies();
  bool frame_rigid_bodies(Diagnostics& out);
  bool frame_joint(MovingJoint& moving, std::vector<bool>& framed, std::vector<Pose>& X_ground_rigid, Diagnostics& out);
  void add_masses();
  void refuse(Diagnostics& out, Code code, const SourceLocation& where, const std::string& key,
              const std::string& found, const std::string& rule) const;

  const Model* model_;
  CoordinateValues values_;
  std::vector<Link> links_;      ///< of each joint
  std::vector<int> order_;       ///< joints, each after the one that moves its parent
  std::vector<Pose> in_ground_;  ///< of each body, the ground last
  std::vector<RigidBody> bodies_;
  std::vector<MovingJoint> joints_;
  std::vector<int> rigid_of_;
  std::vector<Pose> in_rigid_;
};

/// Whether a coordinate is an angle: it turns an axis of its joint. OpenSim decides so too where it moves several.
bool is_angle(const Model& model, const std::string& coordinate);

/// X_parentframe_childframe of a joint.
Pose joint_pose(const Joint& joint, const CoordinateValues& values);

}  // namespace genu::osim
