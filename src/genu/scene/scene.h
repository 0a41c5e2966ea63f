// A scene as data: what a scene file says, checked, in SI units. See docs/scene-reference.md for the file format.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "genu/core/pose.h"
#include "genu/core/types.h"
#include "genu/scene/solid_def.h"

namespace genu {

struct BodyDef {
  /// A closed mesh full of a material.
  struct Solid {
    std::string file;      ///< path as opened
    double file_unit = 1;  ///< m per unit of the file
    Pose placement;        ///< X_body_mesh
    double density = 0;    ///< kg/m^3
    SourceLocation where, file_where;
  };
  std::string name;
  bool fixed = false;
  /// Where mass, centre of mass and inertia come from: they are 0 as read, and known once its mesh is
  /// (assemble/read_solids.h).
  std::optional<Solid> solid;
  double mass = 0;                     ///< kg; 0 has no weight
  Vec3 centre_of_mass = Vec3::Zero();  ///< m, in the body
  Mat3 inertia = Mat3::Zero();         ///< kg m^2, about the centre of mass, axes of the body; only with dynamics
  SourceLocation where;
};

/// The anatomical axes of a knee for the description of Grood and Suntay (model/grood_suntay.h). Unit vectors, anterior
/// perpendicular to proximal.
struct GroodSuntayDef {
  struct Bone {
    int body = -1;
    Vec3 proximal = Vec3::UnitZ();
    Vec3 anterior = Vec3::UnitY();
    Vec3 origin = Vec3::Zero();  ///< m
  };
  bool right = true;  ///< a right knee
  Bone femur, tibia;
};

/// The six coordinates of `child` in `parent`: R_parent_child = R1 R2 R3 (successive rotations about the child's own
/// axes); x = child's origin in the parent's axes. A free joint names all six and constrains nothing. A revolute joint
/// leaves the first rotation, `angle` about its axis, a fixed joint none: they hold the others at `reference`, and
/// these have no names.
struct JointDef {
  enum class Type { free, revolute, fixed };
  struct Rotation {
    std::string name;
    Vec3 axis = Vec3::UnitX();  ///< signed unit axis: "flexion -z" is (0, 0, -1)
  };
  std::string name;
  int parent = -1;  ///< index into Scene::bodies
  int child = -1;
  std::array<Rotation, 3> rotations;
  std::array<std::string, 3> translations;
  std::array<double, 6> reference{};  ///< rotations (rad), then translations (m): the pose reference_strain means
  std::optional<std::array<double, 6>> start;  ///< the same: where the search for equilibrium begins, if not there
  Type type = Type::free;
  double stiffness = 0;  ///< revolute: N m / rad, at rest at angle 0
  double damping = 0;    ///< revolute: N m s / rad; only with dynamics
  struct Limits {
    double lower = -std::numeric_limits<double>::infinity();  ///< rad
    double upper = std::numeric_limits<double>::infinity();
    double stiffness = 0;  ///< N m / rad, of what lies beyond
  };
  std::optional<Limits> limits;  ///< revolute
  std::optional<GroodSuntayDef> grood_suntay;
  SourceLocation where;

  /// Whether coordinate i (0..2 rotations, 3..5 translations) may change.
  bool leaves(int i) const { return type == Type::free || (type == Type::revolute && i == 0); }
};

struct SurfaceDef {
  enum class Shape { plane, sphere, ellipsoid, cylinder, torus, polynomial, cylindrical_polynomial, mesh };
  struct Term {
    int i = 0, j = 0;  ///< z = sum c x^i y^j, or r = sum c theta^i z^j
    double c = 0;      ///< SI
  };
  /// Where contact is meant, in the surface's own frame: what is left empty is not limited.
  struct Patch {
    using Range = std::optional<std::pair<double, double>>;  ///< first < second
    std::array<Range, 3> box;                                ///< x, y, z, m
    Range theta;                                             ///< about z from x toward y, rad
    SourceLocation where;
  };
  /// Of the cartilage on the surface: a number, or what lies between it and the mesh of a bone.
  struct Thickness {
    bool measured = false;
    double constant = 0;    ///< m, where it is not measured
    std::string bone;       ///< mesh: path as opened
    double bone_unit = 1;   ///< m per unit of that file
    double least = 0.5e-3;  ///< m: what is thinner counts as this thick
    double most = 10e-3;    ///< m: how far the bone is looked for
    SourceLocation where, bone_where;
  };
  std::string name;
  int body = -1;
  Shape shape = Shape::plane;
  Pose placement;                    ///< X_body_surface
  bool inside = false;               ///< the outward side turned round (a socket)
  double radius = 0;                 ///< sphere, cylinder: m
  Vec3 radii = Vec3::Zero();         ///< ellipsoid: m
  double major_radius = 0;           ///< torus: m
  double minor_radius = 0;           ///< torus: m
  std::vector<Term> terms;           ///< polynomial
  std::string file;                  ///< mesh: path as opened (already relative to the scene's folder)
  double file_unit = 1;              ///< mesh: m per unit of the file
  std::optional<double> fit_radius;  ///< mesh: m
  std::optional<int> degree;         ///< mesh: 2 to 4
  std::optional<Patch> patch;
  std::optional<Thickness> thickness;  ///< where the surface has one of its own
  SourceLocation where;
  SourceLocation file_where;
  SourceLocation fit_radius_where;  ///< where one is given
};

/// A half space or an intersection of some, in the frame of the second surface's body: "z < 0", "z >= 0 and x < 5".
struct RegionDef {
  enum class Comparison { less, less_equal, greater, greater_equal };
  struct Condition {
    int axis = 0;  ///< 0 x, 1 y, 2 z
    Comparison comparison = Comparison::less;
    double value = 0;  ///< m
    bool operator==(const Condition&) const = default;
  };
  std::string name;
  std::vector<Condition> conditions;
  bool contains(const Vec3& p) const;
  bool operator==(const RegionDef&) const = default;
};

struct ContactDef {
  std::string name;
  int surface_a = -1;  ///< index into Scene::surfaces
  int surface_b = -1;
  std::vector<RegionDef> regions;
  SourceLocation where;

  bool operator==(const ContactDef&) const = default;
};

/// An elastic layer between two surfaces: cartilage on rigid bones (contact/layer_law.h).
struct LayerDef {
  enum class Law { linear, logarithmic };
  enum class Quadrature { triangles, smooth };
  ContactDef pair;
  double modulus = 0;     ///< Young's, Pa
  double poisson = 0;     ///< in [0, 0.5)
  double thickness = 0;   ///< m, of both layers together, without what is measured on a surface
  bool measured = false;  ///< on one of the surfaces at least
  Law law = Law::linear;
  Quadrature quadrature = Quadrature::smooth;
  double tolerance = 1e-4;  ///< smooth: relative error of the force
  int cast_from = -1;       ///< triangles: index into Scene::surfaces
  double damping = 0;       ///< c, s/m: the pressure is p (1 + c d'); only with dynamics
  double search_depth = 0;  ///< m: how far rays look; 0: as deep as the layers are thick, where that is measured

  bool operator==(const LayerDef&) const = default;
};

struct LigamentDef {
  enum class Rest { slack_length, reference_strain, reference_force };
  struct End {
    int body = -1;
    Vec3 point = Vec3::Zero();  ///< m, in the body
  };
  struct Number {
    std::string key;
    double value = 0;  ///< SI
  };
  std::string name;
  End from, to;
  std::vector<End> via;                           ///< on the way from `from` to `to`
  std::string law = "quadratic";                  ///< its word in the file (law/laws.h)
  std::vector<Number> numbers;                    ///< of the law, in the order of its table
  std::vector<std::pair<double, double>> points;  ///< (strain, N), of a law with points
  Rest rest = Rest::slack_length;
  double rest_value = 0;  ///< m, strain, or N
  double damping = 0;     ///< N s / m along its whole length; only with dynamics
  SourceLocation where;

  /// All points of its path, from end to end.
  std::vector<End> path_points() const;
  /// Calls f(end) for both ends, then for the points between.
  template <typename Self, typename F>
  static void for_each_end(Self& self, const F& f) {
    f(self.from);
    f(self.to);
    for (auto& end : self.via) f(end);
  }
  /// A number of the law by its key; 0 for a law without it.
  double number(std::string_view key) const;
};

/// One of a joint's six coordinates: 0..2 rotations, 3..5 translations.
struct CoordinateRef {
  int joint = -1;
  int index = 0;
  bool operator==(const CoordinateRef&) const = default;
};

/// sum of factor * coordinate, over coordinates of any joints; all are rotations or all are translations.
struct CombinationDef {
  struct Term {
    CoordinateRef coordinate;
    double factor = 1;
  };
  std::string name;
  std::vector<Term> terms;
  SourceLocation where;
};

/// What a step can prescribe: a coordinate, or a combination of some.
struct QuantityRef {
  CoordinateRef first;   ///< the coordinate, or the first one of the combination: the quantity has its unit
  int combination = -1;  ///< index into Scene::combinations, -1 for a coordinate

  QuantityRef() = default;
  QuantityRef(CoordinateRef coordinate, int combination_index = -1)
      : first(coordinate), combination(combination_index) {}
  QuantityRef(int joint, int index) : first{joint, index} {}
  bool is_rotation() const { return first.index < 3; }
  bool operator==(const QuantityRef&) const = default;
};

/// What multiplies a load besides its factor in a step; or the course of a coordinate that is driven.
struct ScaleDef {
  enum class Kind { over_coordinate, over_time, sine, step };
  Kind kind = Kind::over_time;
  CoordinateRef coordinate;                      ///< over_coordinate
  std::vector<std::pair<double, double>> table;  ///< (rad, m or s, factor), the first strictly increasing
  double amplitude = 0;                          ///< sine
  double frequency = 0;                          ///< sine: Hz
  double start = 0;                              ///< sine, step: s
  double offset = 0;                             ///< sine: about which it swings, and before its start
  double from = 0, to = 1;                       ///< step
  double rise = 0;                               ///< step: s, from one value to the other
};

struct LoadDef {
  enum class Kind { wrench, toward, coordinate };
  enum class Frame { world, body };
  std::string name;
  Kind kind = Kind::wrench;
  int body = -1;                     ///< wrench, toward
  Vec3 force = Vec3::Zero();         ///< wrench: N
  Vec3 moment = Vec3::Zero();        ///< wrench: N m
  Vec3 point = Vec3::Zero();         ///< wrench, toward: m, in the body
  Frame frame = Frame::world;        ///< wrench
  int toward_body = -1;              ///< toward: the body pulled to, and pulled on as much
  Vec3 toward_point = Vec3::Zero();  ///< m, in that body
  double value = 0;                  ///< toward: N; coordinate: N m or N
  CoordinateRef coordinate;          ///< coordinate: where the generalised moment or force acts
  std::optional<ScaleDef> scale;
  SourceLocation where;

  /// Whether it changes with time by itself.
  bool in_time() const { return scale && scale->kind != ScaleDef::Kind::over_coordinate; }
};

struct StepDef {
  struct Prescribed {
    QuantityRef coordinate;
    double from = 0, to = 0;  ///< rad or m
  };
  struct Factor {
    int load = -1;
    double from = 1, to = 1;
  };
  std::vector<Prescribed> prescribe;
  std::vector<Factor> factors;  ///< loads not named keep the factor 1
  int increments = 1;
  double duration = 1;      ///< s
  bool arc_length = false;  ///< what the step changes may turn back on its way
  SourceLocation where;
};

/// How exactly the poses of steps are solved.
struct SolverDef {
  double tolerance = 1e-12;  ///< largest residual: forces over the force scale, lengths over the length scale, rad
};

/// Motion over time in the place of steps from one equilibrium to the next.
struct DynamicsDef {
  struct Rate {
    CoordinateRef coordinate;
    double value = 0;  ///< rad/s or m/s
  };
  double duration = 1;         ///< s
  double output_interval = 1;  ///< s
  double tolerance = 1e-9;     ///< of lengths over the joint's size, angles in rad, speeds the same a second
  std::vector<Rate> start_rates;
  struct Drive {
    QuantityRef quantity;
    ScaleDef course;  ///< rad or m over s: over_time, sine or step
    SourceLocation where;
  };
  std::vector<Drive> prescribe;
  bool from_equilibrium = false;  ///< begins where it balances under the loads at time 0, not at the joints' start
  SourceLocation where;
};

/// What a scene says, wherever its points are measured from.
struct SceneTables {
  std::string file;
  std::string title;
  double length_unit = 1;       ///< m per unit of length in the file
  double angle_unit = 1;        ///< rad per unit of angle in the file
  std::optional<Vec3> gravity;  ///< m/s^2, in the world
  std::vector<BodyDef> bodies;
  std::vector<JointDef> joints;
  std::vector<CombinationDef> combinations;
  std::vector<SurfaceDef> surfaces;
  std::vector<ContactDef> contacts;  ///< rigid ones
  std::vector<LayerDef> layers;
  std::vector<LigamentDef> ligaments;
  std::vector<LoadDef> loads;
  std::vector<StepDef> steps;  ///< empty where there is dynamics
  SolverDef solver;
  std::optional<DynamicsDef> dynamics;
  std::vector<SolidDef> solids;  ///< of a file for `genu mesh` alone
};

/// A scene as read: points on a body are measured from the body's origin in the file.
struct Scene : SceneTables {};

/// A scene as it is solved: points on a body (surfaces, ends of ligaments, points of loads, centre of mass, regions)
/// are measured from an origin chosen near them (centre_bodies.h). Neither kind of scene converts to the other.
struct PlacedScene : SceneTables {
  std::vector<Vec3> origins;  ///< m, of each body: where that origin is in the body as the file has it
};

/// Length (m) of a ligament from point to point, bodies of the scene at `poses`. Every body must be known.
double path_length(const LigamentDef& ligament, const std::vector<Pose>& poses);

/// All files that the scene names, as opened; a file named twice stands there twice.
std::vector<std::string> mesh_files(const SceneTables& scene);

/// "knee.flexion"
std::string coordinate_name(const SceneTables& scene, const CoordinateRef& c);

/// "knee.flexion", or the name of a combination
std::string quantity_name(const SceneTables& scene, const QuantityRef& q);

}  // namespace genu
