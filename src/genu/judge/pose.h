// A judged pose: poses of the bodies, prescribed values, and forces, all from its row.
#pragma once

#include <string>
#include <vector>

#include "genu/judge/findings.h"
#include "genu/judge/results_file.h"
#include "genu/judge/subject.h"

namespace genu::judge {

/// A force and a moment (N, N m) on a body at a point, in the world.
struct Force {
  int body = -1;
  Vec3 point = Vec3::Zero(), force = Vec3::Zero(), moment = Vec3::Zero();
};

/// A contact force between triangles: its direction is known to within two cones.
struct LooseForce {
  int body_a = -1, body_b = -1;
  Vec3 point = Vec3::Zero();
  double size = 0;                ///< N
  Vec3 normal_a, normal_b;        ///< outward, world: means of the facets near
  double turn_a = 0, turn_b = 0;  ///< rad: error bounds of these
  std::string name;
};

struct PoseForces {
  std::vector<Force> forces;
  std::vector<LooseForce> loose;
  /// On coordinates: N m or N.
  struct OnCoordinate {
    CoordinateRef coordinate;
    double value = 0;
  };
  std::vector<OnCoordinate> generalised;
  bool incomplete = false;  ///< a force is missing that cannot be told: then nothing is said of balance
};

struct PoseCase {
  const Subject* subject = nullptr;
  Row row;
  Coordinates q;
  std::vector<Pose> poses;
  double rounding = 0;  ///< m: rounding of places, from the digits of the table
  double slack = 0;     ///< relative: tolerance of the solver, added to the judge's own
  Findings* out = nullptr;

  const Scene& scene() const { return subject->scene; }
  double length_tolerance() const { return 1e-9 * subject->size + rounding + slack * subject->size; }
};

/// The scene's step of a row; null where there is none.
const StepDef* step_of(const Scene& scene, const Row& row);
/// The position of a row in its step.
double part_of(const StepDef& step, const Row& row);

/// The case of a row. False where coordinates are empty, with a note in `out`.
bool begin_pose(const Subject& subject, const Row& row, Findings& out, PoseCase& pose);

/// Step and increment must be those after the row before; the residual must be that of a solved pose.
void check_row(const PoseCase& pose);
/// Prescribed coordinates and load factors of the scene's step against the columns.
void check_prescribed(const PoseCase& pose);
/// Lengths, strains and tensions; adds the tensions of the table.
void check_ligaments(const PoseCase& pose, const std::vector<Motion>* velocities, PoseForces& forces);
/// Displacements and forces of bushings; adds them, in motion with their dampers.
void check_bushings(const PoseCase& pose, const std::vector<Motion>* velocities, PoseForces& forces);
/// Scales and factors; adds the loads and weights.
void add_loads(const PoseCase& pose, PoseForces& forces);
/// Contact points of rigid pairs: on both surfaces, at one place, in compression; adds their forces.
void check_contacts(const PoseCase& pose, PoseForces& forces);
/// No overlap anywhere, by samples of each surface against the other.
void check_gaps(const PoseCase& pose);
/// Force, moment, area and largest pressure of layers against the judge's own integrals; adds the written force.
void check_layers(const PoseCase& pose, bool sum, PoseForces& forces);
/// Sums of forces and moments as work on each coordinate, with reactions of prescribed coordinates and of joints.
/// `more`: N, N m, further tolerance (inertia from differences).
void check_balance(const PoseCase& pose, PoseForces& forces, double more_force = 0, double more_moment = 0);

}  // namespace genu::judge
