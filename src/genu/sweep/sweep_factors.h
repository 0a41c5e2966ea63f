// Names in [vary] and the numbers of a scene that they move. A factor is one draw of a sample: an entry that ends with
// :together is one factor, any other one is a factor for each number that it names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/core/source_location.h"
#include "genu/model/parameters.h"
#include "genu/scene/toml_document.h"
#include "genu/surface/mesh_noise.h"
#include "genu/sweep/sweep_def.h"

namespace genu {

/// One number of a scene that a factor moves.
struct VariedNumber {
  std::string name;  ///< as --set takes it: "AAC.stiffness"; "femur.mesh_error"
  /// Empty for a number of a surface or contact: a scene with another one is prepared from its file.
  std::optional<Parameter> parameter;
  double unit = 1;       ///< SI per unit of the file; without a parameter unknown
  double base = 0;       ///< the scene's number in the file's unit; without a parameter unknown
  SourceLocation where;  ///< in the scene's file
  /// The surface whose mesh a draw moves, and by how much: no number of the file. -1: any other number.
  int surface = -1;
  MeshNoise noise{};
};

struct Factor {
  std::string name;         ///< the entry's, or that of its only number
  std::size_t vary = 0;     ///< index into SweepDef::vary
  bool mesh_error = false;  ///< its draws name random fields (assemble/drawn_meshes.h) and are no amounts
};

struct SceneFactors {
  std::vector<Factor> factors;
  std::vector<std::vector<VariedNumber>> numbers;  ///< of each factor

  /// Whether a number is one that only a newly prepared scene can have.
  bool prepares_anew() const;
  /// Whether a number of a joint is varied, which may move where the search begins.
  bool moves_start() const;
};

/// The factors of a scene in the order of [vary] and of the scene. In `out`: patterns that name nothing or numbers that
/// cannot be varied, numbers that two entries name, and distributions that reach numbers <= 0 where only positive ones
/// are possible.
[[nodiscard]] SceneFactors find_factors(const SweepDef& sweep, const Prepared& scene, const TomlNode& document,
                                        Diagnostics& out);

/// The same factors in a scene where something is left out or set: those of its numbers that are still there.
[[nodiscard]] SceneFactors factors_of_what_if(const SceneFactors& as_it_is, const Prepared& scene,
                                              const TomlNode& document);

/// The number in the file's unit at a draw; needs VariedNumber::parameter.
double number_at(const VariedNumber& number, VaryDef::How how, double draw);

/// "AAC.stiffness=1234.5", "contact.tf.modulus=x1.1": what --set takes for the number at a draw.
std::string set_option(const VariedNumber& number, VaryDef::How how, double draw);

}  // namespace genu
