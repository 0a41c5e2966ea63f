// What a run did, as facts: for summary.json and for the terminal. Times and the machine stand here alone.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/solver/path.h"

namespace genu {

struct RunSummary {
  struct Effect {
    std::string name;      ///< "rigid contact", "ligaments", "loads", "weights", "prescribed coordinates"
    int count = 0;         ///< how many of them the scene names
    std::string unknowns;  ///< what each brings, in words
  };
  struct SurfaceFacts {
    std::string name;
    std::string text;
  };
  struct Variant {
    std::string cause, name;
    int poses_solved = 0;
  };
  std::string scene_file, title, version;
  std::vector<Effect> effects;
  std::vector<SurfaceFacts> surfaces;
  std::vector<Variant> variants;  ///< of the surfaces, solved for error bars
  double length_scale = 0;        ///< m
  double force_scale = 0;         ///< N
  int poses_asked = 0, poses_solved = 0, poses_stable = 0;
  int fewest_contacts = 0, most_contacts = 0;
  int iterations = 0, substeps = 0;
  double worst_residual = 0;
  double smallest_force = 0;                            ///< N, +infinity without contact
  double smallest_gap = 0;                              ///< m, +infinity without contact
  std::vector<std::pair<std::string, double>> seconds;  ///< per stage, in order
  std::vector<std::string> verdict;                     ///< sentences
  int exit_code = 0;
};

/// Pretty-printed JSON.
std::string to_json(const RunSummary& summary);
/// A few aligned lines.
std::string to_text(const RunSummary& summary);

}  // namespace genu
