// A scene as data: what a scene file says, checked, in SI units. See docs/scene-reference.md for the file format.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "genu/core/types.h"
#include "genu/scene/body_def.h"
#include "genu/scene/bundle_def.h"
#include "genu/scene/bushing_def.h"
#include "genu/scene/compartment_def.h"
#include "genu/scene/joint_def.h"
#include "genu/scene/load_def.h"
#include "genu/scene/path_def.h"
#include "genu/scene/plausible_def.h"
#include "genu/scene/scene_changes.h"
#include "genu/scene/solid_def.h"
#include "genu/scene/surface_def.h"

namespace genu {

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
  enum class Rim { weighted, cut };
  ContactDef pair;
  double modulus = 0;     ///< Young's, Pa
  double poisson = 0;     ///< in [0, 0.5)
  double thickness = 0;   ///< m, of both layers together, without what is measured on a surface
  bool measured = false;  ///< on one of the surfaces at least
  Law law = Law::linear;
  Quadrature quadrature = Quadrature::smooth;
  double tolerance = 1e-4;  ///< smooth: relative error of the force
  int cast_from = -1;       ///< triangles: index into Scene::surfaces
  Rim rim = Rim::weighted;  ///< triangles: how they count at the rim of the other surface (contact/rim_cover.h)
  double damping = 0;       ///< c, s/m: the pressure is p (1 + c d'); only with dynamics
  double search_depth = 0;  ///< m: how far rays look; 0: as deep as the layers are thick, where that is measured

  bool operator==(const LayerDef&) const = default;
};

inline constexpr NumberRow kLayerDamping{.key = "damping",
                                         .unit = Unit::time_per_length,
                                         .range = NumberRow::Range::at_least_zero,
                                         .presence = NumberRow::Presence::optional,
                                         .in_motion = true};

struct LigamentDef {
  enum class Rest { slack_length, reference_strain, reference_force };
  using End = PathEnd;
  struct Number {
    std::string key;
    double value = 0;  ///< SI
  };
  std::string name;
  End from, to;
  std::vector<End> via;                           ///< on the way from `from` to `to`
  std::vector<WrapDef> wraps;                     ///< surfaces between them, in order
  std::string law = "quadratic";                  ///< its word in the file (law/laws.h)
  std::vector<Number> numbers;                    ///< of the law, in the order of its table
  std::vector<std::pair<double, double>> points;  ///< (strain, N), of a law with points
  Rest rest = Rest::slack_length;
  double rest_value = 0;  ///< m, strain, or N
  double damping = 0;     ///< N s / m along its whole length; only with dynamics
  SourceLocation where, rest_where;

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

inline constexpr NumberRow kLigamentDamping{.key = "damping",
                                            .unit = Unit::force_per_speed,
                                            .range = NumberRow::Range::at_least_zero,
                                            .presence = NumberRow::Presence::optional,
                                            .in_motion = true};

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

struct StepDef {
  struct Prescribed {
    QuantityRef coordinate;
    double from = 0, to = 0;  ///< rad or m
    /// Loads that hold the coordinate in the place of a reaction: their common factor is an unknown of the pose.
    std::vector<int> drivers = {};
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
  SourceLocation units_where;   ///< of units.length
  std::optional<Vec3> gravity;  ///< m/s^2, in the world
  std::vector<BodyDef> bodies;
  std::vector<JointDef> joints;
  std::vector<CombinationDef> combinations;
  std::vector<CoordinateRef> moment_arms;  ///< coordinates about which those of ligaments and cables are written
  std::vector<SurfaceDef> surfaces;
  std::vector<ContactDef> contacts;  ///< rigid ones
  std::vector<LayerDef> layers;
  std::vector<LigamentDef> ligaments;
  std::vector<BundleDef> bundles;
  std::vector<BushingDef> bushings;
  std::vector<CompartmentDef> compartments;
  std::vector<LoadDef> loads;
  std::vector<StepDef> steps;  ///< empty where there is dynamics
  SolverDef solver;
  PlausibleDef plausible;
  std::optional<DynamicsDef> dynamics;
  std::vector<SolidDef> solids;  ///< of a file for `genu mesh` alone
  std::vector<DisabledTable> disabled;
  AppliedChanges changed;  ///< of what the file says
};

/// A scene as read: points on a body are measured from the body's origin in the file.
struct Scene : SceneTables {};

/// A scene as it is solved: points on a body (surfaces, ends of ligaments, points of loads, centre of mass, regions)
/// are measured from an origin chosen near them (centre_bodies.h). Neither kind of scene converts to the other.
struct PlacedScene : SceneTables {
  std::vector<Vec3> origins;  ///< m, of each body: where that origin is in the body as the file has it
};

/// Straight length (m) of a ligament from point to point, bodies of the scene at `poses`. Every body must be known.
double path_length(const LigamentDef& ligament, const std::vector<Pose>& poses);

/// All files that the scene names, as opened; a file named twice stands there twice.
std::vector<std::string> mesh_files(const SceneTables& scene);

/// "knee.flexion"
std::string coordinate_name(const SceneTables& scene, const CoordinateRef& c);

/// "knee.flexion", or the name of a combination
std::string quantity_name(const SceneTables& scene, const QuantityRef& q);

}  // namespace genu
