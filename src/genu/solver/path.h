// Pose after pose along the steps of a scene: prediction along the tangent, adaptive increments, contacts gained and
// lost where it happens, and every pose certified.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "genu/model/step_plan.h"
#include "genu/solver/contact_set.h"
#include "genu/solver/stability.h"
#include "genu/solver/undetermined.h"

namespace genu {

/// One row of the results.
struct PosePoint {
  int step = 0;       ///< from 1
  int increment = 0;  ///< from 0
  double t = 0;       ///< of its step, 0 to 1
  Target target;
  Balanced pose;
  PoseReport report;
  Stability stability;
  Undetermined undetermined;
  bool solved() const { return report.status == PoseStatus::ok; }
};

/// Something that happened between rows, located on the path.
struct PathEvent {
  enum class Kind {
    contact_gained,
    contact_lost,
    taut,
    slack,
    transition,  ///< a ligament passes another break of its law
    held,        ///< a ligament stays at a jump of its law, with a force between those of the two sides
    jump,        ///< no equilibrium beyond that is near: the force of a ligament drops
    stepped_over,
    over_edge,
    overlap,
    flawed_mesh,
    turns_back,         ///< a limit point that ends the walk: no equilibrium lies beyond what is prescribed there
    limit_point,        ///< the same, passed by arc length
    bifurcation,        ///< the smallest stiffness passes 0, and another path branches off
    reaction_turns,     ///< the reaction of what is driven is largest or smallest: a limit point if it were the load
    stability_changed,  ///< the smallest stiffness changes its sign
    closed,             ///< the path is back where it started
    snaps,              ///< the equilibrium ends, the next one is a jump away, and the path ends here
    snapped,            ///< the same, but the path goes on there
    flutter,
    stopped
  };
  Kind kind = Kind::stopped;
  int step = 0;  ///< 0 on the way from the reference pose (or the last step's end) to a step's start
  double t = 0;
  Target target;                              ///< where: prescribed coordinates and load factors
  std::string what;                           ///< e.g. "medial.2"
  std::vector<JointValues> coordinates = {};  ///< of every joint, where the pose is known
  int rows_before = 0;                        ///< how many poses had been handed over when it happened
};
const char* to_string(PathEvent::Kind kind);
/// What ends a path where findings are final().
PathEvent::Kind end_of(const Findings& findings);

struct PathOptions {
  NewtonOptions newton;
  double event_tolerance = 1e-9;     ///< of a step's parameter: how finely an event is located
  double smallest_increment = 1e-8;  ///< of a step's parameter: below this the path is stuck
  double largest_window = 0.0087;    ///< rad (0.5 deg): a stretch without solution longer than this is not stepped over
};

struct PathResult {
  bool complete = false;  ///< every pose asked for was solved
  int substeps = 0;
  int iterations = 0;
  double worst_residual = 0;
};

struct PathObserver {
  /// `layers`: what solving the pose has shown of its elastic layers, for the call alone; null where there are none.
  std::function<void(const PosePoint&, LayerMemories* layers)> pose;
  std::function<void(const PathEvent&)> event;
  Cancelled cancelled;
  /// Called between rows from which a walk can go on later, every 16 or so; may be empty. `save()` gives what it goes
  /// on from, which follow_path() takes: bytes for the same program on the same input, and for nothing else. Rows and
  /// events handed over before are not among them.
  std::function<void(const std::function<std::string()>& save)> rest;
};

/// What follow_path() throws where it is to go on from what another scene has saved.
struct SavedElsewhere : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Walks all steps from the reference pose. What was solved has been handed to the observer whatever happens later; a
/// path that is cancelled ends in the middle of a pose, of which nothing is told. `from`: what PathObserver::rest has
/// saved; what comes after it then is the same to the last bit as if it had never been interrupted.
PathResult follow_path(const JointModel& model, ContactField& field, const std::vector<StepPlan>& steps,
                       const PathOptions& options, const PathObserver& observer, const std::string& from = {});

}  // namespace genu
