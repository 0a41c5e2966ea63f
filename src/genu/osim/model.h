// A model of OpenSim 4 as data: what the file says of bodies, joints, paths and contact, in its own units (m, rad, N,
// kg, Pa), each with its place in the file. Nothing is computed here.
//
// Sockets of frames are paths from the model: "/bodyset/tibia_r", "/jointset/knee_r/femur_r_offset", "/ground"
// (frames.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "genu/core/pose.h"
#include "genu/core/source_location.h"
#include "genu/osim/function.h"

namespace genu::osim {

/// An element of the file that import.csv has a row for.
struct Item {
  std::string set;   ///< what it is part of: "forceset", "knee_r" for its coordinates
  std::string type;  ///< its tag: "Blankevoort1991Ligament"
  std::string name;
  SourceLocation where;
};

struct Body {
  std::string name;
  double mass = 0;
  Vec3 centre = Vec3::Zero();   ///< of mass, in the body
  Mat3 inertia = Mat3::Zero();  ///< about the centre of mass, axes of the body
  SourceLocation where;
};

/// PhysicalOffsetFrame: a frame fixed in another one.
struct OffsetFrame {
  std::string name;
  std::string path;    ///< its own: "/jointset/knee_r/femur_offset"
  std::string parent;  ///< path
  Pose X_parent_frame;
  SourceLocation where;
};

struct Coordinate {
  std::string name;
  double default_value = 0;  ///< prescribed: the value of its function at time 0
  bool locked = false;
  bool prescribed = false;  ///< by a function of time
  SourceLocation where;
};

/// One of the six axes of a joint: a rotation or translation by f(coordinate).
struct Axis {
  std::string coordinate;  ///< empty: by the constant f
  Vec3 direction = Vec3::UnitX();
  Function function;
  SourceLocation where;
};

/// Any joint as what CustomJoint is: X_parent_child = [R1 R2 R3, sum of translations], rotations about the child's own
/// axes one after the other, translations along the parent's.
struct Joint {
  std::string type, name;
  std::string parent, child;  ///< paths of its two frames
  std::vector<Coordinate> coordinates;
  std::array<Axis, 3> rotations, translations;
  SourceLocation where;

  const Coordinate* coordinate(const std::string& wanted) const;
};

/// CoordinateCouplerConstraint: dependent = f(independent).
struct Coupler {
  std::string name, independent, dependent;
  Function function;
  bool enforced = true;
  SourceLocation where;
};

struct WrapObject {
  enum class Kind { ellipsoid, cylinder, sphere, torus };
  Kind kind = Kind::sphere;
  std::string type, name;
  std::string frame;  ///< path of the body or frame that has it
  bool active = true;
  Pose X_body_wrap;
  std::string quadrant;       ///< "all", or the side it counts on: "x", "-y"
  Vec3 radii = Vec3::Zero();  ///< ellipsoid
  double radius = 0;          ///< cylinder, sphere; torus: of its tube
  double ring = 0;            ///< torus: from its centre to the middle of the tube
  double length = 0;          ///< cylinder
  SourceLocation where;
};

struct PathPoint {
  /// A point that moves with a coordinate.
  struct Moving {
    std::array<std::string, 3> coordinates;
    std::array<Function, 3> functions;
  };
  /// A point that counts in a range of a coordinate.
  struct Condition {
    std::string coordinate;
    double from = 0, to = 0;
  };
  std::string name, frame;
  Vec3 location = Vec3::Zero();
  std::optional<Moving> moving;
  std::optional<Condition> condition;
  SourceLocation where;
};

struct PathWrap {
  std::string object, method;
  int first = -1, last = -1;  ///< points between which it counts, from 1; -1: all
  SourceLocation where;
};

struct GeometryPath {
  std::vector<PathPoint> points;
  std::vector<PathWrap> wraps;
};

/// What pulls by its length: Blankevoort1991Ligament, PathSpring, PointToPointSpring.
struct Ligament {
  enum class Law { blankevoort, linear, spring };
  std::string type, name;
  bool applies = true;
  GeometryPath path;
  Law law = Law::blankevoort;
  double stiffness = 0;  ///< N per unit of strain; spring: N/m
  double slack_length = 0;
  double transition_strain = 0;
  double damping = 0;  ///< as the file has it; only for what is reported of it
  SourceLocation where;
};

struct Muscle {
  std::string type, name;
  bool applies = true;
  GeometryPath path;
  double max_isometric_force = 0;
  SourceLocation where;
};

/// Smith2018ContactMesh
struct ContactMesh {
  std::string name, frame;
  Pose X_frame_mesh;
  std::string file, back_file;
  double modulus = 0, poisson = 0, thickness = 0;
  bool measured = false;  ///< its thickness, to the mesh of back_file
  double least = 0, most = 0;
  Vec3 scale = Vec3::Ones();
  SourceLocation where, file_where, back_where;
};

/// Smith2018ArticularContactForce
struct ContactForce {
  std::string name;
  bool applies = true;
  std::string target, casting;  ///< sockets
  double least_depth = 0, most_depth = 0;
  bool logarithmic = false;
  bool lumped = true;
  SourceLocation where;
};

/// SpringGeneralizedForce: -stiffness (q - rest) - viscosity q'.
struct CoordinateSpring {
  std::string name, coordinate;
  bool applies = true;
  double stiffness = 0, rest = 0, viscosity = 0;
  SourceLocation where;
};

struct Model {
  std::string file, name;
  Vec3 gravity = Vec3::Zero();  ///< in the ground
  std::vector<Body> bodies;
  std::vector<OffsetFrame> frames;
  std::vector<Joint> joints;
  std::vector<Coupler> couplers;
  std::vector<WrapObject> wraps;
  std::vector<Ligament> ligaments;
  std::vector<Muscle> muscles;
  std::vector<ContactMesh> contact_meshes;
  std::vector<ContactForce> contact_forces;
  std::vector<CoordinateSpring> springs;
  std::vector<Item> items;  ///< every element of the file, in its order
};

/// The part of a socket behind its last slash.
std::string last_name(const std::string& socket);

}  // namespace genu::osim
