// A study ready to run: its scenes prepared, its factors and kept numbers found, its design made.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "genu/assemble/drawn_meshes.h"
#include "genu/assemble/prepare.h"
#include "genu/core/diagnostics.h"
#include "genu/sweep/kept_numbers.h"
#include "genu/sweep/sweep_def.h"
#include "genu/sweep/sweep_design.h"
#include "genu/sweep/sweep_factors.h"

namespace genu {

/// A scene with a what-if: what each sample is solved in.
struct SweepCase {
  std::string scene, what_if;  ///< names in the results
  SceneSource source;
  Prepared prepared;
  SceneFactors factors;
  MainCoordinate main;
};

/// A run is one sample in one case. Runs are counted case by case, the samples of each in order.
struct Sweep {
  SweepDef def;
  std::vector<Factor> factors;
  std::vector<SweepCase> cases;
  std::vector<KeptNumber> kept;
  std::vector<SweepEvent> events;
  SweepDesign design;
  std::string hash;  ///< of the study, its scenes, meshes and points, and genu's version

  std::uint64_t runs() const { return cases.size() * design.samples(); }
  const SweepCase& case_of(std::uint64_t run) const { return cases[run / design.samples()]; }
  std::uint64_t sample_of(std::uint64_t run) const { return run % design.samples(); }
};

/// Reads a study and all its scenes. Empty, with every error in `out`, where anything is wrong.
[[nodiscard]] std::optional<Sweep> prepare_sweep(const std::string& path, Diagnostics& out);

/// The scene of one sample, as --without and --set change it: a normal run of it has the sample's results, unless the
/// sample has other meshes.
SceneSource source_of_sample(const Sweep& sweep, const SweepCase& in, std::uint64_t sample);

/// The meshes of a sample that are not those of its scene's files.
std::vector<MeshDraw> mesh_draws(const SweepCase& in, const std::vector<double>& draws);

}  // namespace genu
