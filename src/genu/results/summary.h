// What a run did, as facts: for summary.json and for the terminal. Times and the machine stand here alone.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/core/file_checksum.h"
#include "genu/core/types.h"
#include "genu/path/path_options.h"
#include "genu/scene/scene_changes.h"

namespace genu {

/// How well the places of a pair's contacts are known, where that is worst.
struct ContactLocation {
  std::string contact;
  double spread = 0;          ///< m, standard deviation along the direction of least relative curvature
  double typical_spread = 0;  ///< m, the median over the poses in contact
  double least_curvature = std::numeric_limits<double>::infinity();  ///< 1/m, relative, of any contact in any pose
  double curvature_uncertainty = 0;                                  ///< 1/m, from the meshes' noise
  int doubtful = 0;        ///< poses with a contact whose relative curvature is below 10 times its uncertainty
  int poses = 0;           ///< poses in contact
  std::size_t record = 0;  ///< the pose where it is worst

  double ratio() const { return least_curvature / curvature_uncertainty; }
};

/// What half spaces of a layer's material would carry at the same approach (appraise/hertz_check.h), in one row.
struct HertzCheck {
  std::string contact;
  std::size_t row = 0;                                ///< of results.csv, from 1
  double approach = 0;                                ///< m
  double layer_force = 0, layer_peak_pressure = 0;    ///< N, Pa: of the layer itself
  std::string why;                                    ///< why Hertz does not apply; empty where he does
  double force = 0, peak_pressure = 0, a = 0, b = 0;  ///< N, Pa, half axes in m
  double axis_over_thickness = 0;
  bool applies() const { return why.empty(); }
};

struct RunSummary {
  struct Effect {
    std::string name;      ///< "rigid contact", "ligaments", "loads", "weights", "prescribed coordinates"
    int count = 0;         ///< how many of them the scene names
    std::string unknowns;  ///< what each brings, in words
    std::optional<std::int64_t> evaluations = {};  ///< of one of them each; empty where nothing is evaluated by itself
    double seconds = 0;                            ///< in these, about
  };
  struct SurfaceFacts {
    std::string name;
    std::string text;
  };
  /// A body whose mass follows from a mesh.
  struct BodyFacts {
    std::string name, file;
    double density = 0;                  ///< kg/m^3
    double volume = 0;                   ///< m^3
    double mass = 0;                     ///< kg
    Vec3 centre_of_mass = Vec3::Zero();  ///< m, in the body as the file has it
    Mat3 inertia = Mat3::Zero();         ///< kg m^2, about the centre of mass, in the body's axes
  };
  struct Variant {
    std::string cause, name;
    int poses_solved = 0;
  };
  /// Of poses that were given and not solved: there are no counts of what a solver does.
  struct GivenPoses {
    struct Column {
      std::string column, coordinate, unit, how;
    };
    std::string file;
    std::vector<Column> columns;       ///< which column was taken for which coordinate
    std::vector<std::string> ignored;  ///< columns that mean nothing here
    std::size_t left_out = 0;          ///< rows of an earlier run that hold no pose
  };
  /// Of a motion over time, in the place of what a search for equilibria counts.
  struct Motion {
    double duration = 0, output_interval = 0, tolerance = 0;  ///< s, s, 1
    std::string method;                                       ///< in words
    long steps = 0, evaluations = 0, jacobians = 0, starts = 0;
    double worst_residual = 0, worst_drift = 0;  ///< of constraints, MotionPoint
    double worst_energy = 0, energy_scale = 0;   ///< J: error of the balance; largest energy or work
    int switches = 0;                            ///< ligaments that became slack or taut, laws that changed formula
    int impacts = 0;                             ///< contacts that closed or opened
  };
  std::optional<GivenPoses> given;
  std::optional<Motion> motion;
  std::string scene_file, title, version;
  std::string scene_path;  ///< absolute
  AppliedChanges changed;  ///< in what the scene file says
  /// What was read, the scene first: whether it is still the same can be seen later.
  struct InputFile {
    std::string path;  ///< absolute
    FileChecksum checksum;
  };
  std::vector<InputFile> files;
  /// The table of results as it was written: whether it is still whole can be seen later.
  struct TableFile {
    std::size_t rows = 0;
    FileChecksum checksum;
  };
  std::optional<TableFile> results;
  std::vector<Effect> effects;
  std::vector<SurfaceFacts> surfaces;
  std::vector<BodyFacts> bodies;
  std::vector<Variant> variants;  ///< of the surfaces, solved for error bars
  double length_scale = 0;        ///< m
  double force_scale = 0;         ///< N
  int poses_asked = 0, poses_solved = 0, poses_stable = 0;
  int rigid_pairs = 0;  ///< without any nobody wants to know how many contacts there are
  int fewest_contacts = 0, most_contacts = 0;
  int iterations = 0, substeps = 0;
  double worst_residual = 0;
  double bearable_loads = 0;  ///< of all, where there is no first pose under all of them (path/raised_loads.h)
  double smallest_force = 0;  ///< N, +infinity without contact
  double smallest_gap = 0;    ///< m, +infinity without contact
  std::vector<ContactLocation> locations;               ///< of pairs with a noisy mesh
  std::vector<HertzCheck> hertz;                        ///< of layers in contact
  std::vector<std::pair<std::string, double>> seconds;  ///< per stage, in order
  /// solved; solved, with jumps or doubts; not all of it solved.
  enum class Class { solved, doubtful, not_solved };
  Class verdict_class = Class::solved;
  std::vector<std::string> verdict;  ///< sentences
  bool partial = false;              ///< the work was stopped before its end: there would be more rows
  int exit_code = 0;
};

/// s: of a stage of RunSummary::seconds; 0 where there is none.
double seconds_of(const RunSummary& summary, const std::string& stage);

/// "solved", "doubtful", "not_solved"
const char* to_string(RunSummary::Class verdict);

/// Pretty-printed JSON.
std::string to_json(const RunSummary& summary);
/// One line: mass, centre, inertia [xx, yy, zz, xy, xz, yz].
std::string to_text(const RunSummary::BodyFacts& body);
/// A few aligned lines.
std::string to_text(const RunSummary& summary);

}  // namespace genu
