// A study of many samples as its file says (docs/sweep.md): what varies, how it is sampled, what is kept.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "genu/core/source_location.h"
#include "genu/core/types.h"
#include "genu/scene/scene_changes.h"
#include "genu/sweep/distribution.h"

namespace genu {

enum class DesignKind { monte_carlo, latin_hypercube, sobol, factorial, fractional_factorial, one_at_a_time, points };

/// The error of a mesh: its vertices' heights about the surface that was measured.
struct MeshErrorDef {
  bool estimated = false;                 ///< as genu sees it in the mesh itself (surface/mesh_noise.h)
  double sd = 0, correlation_length = 0;  ///< in the scene's unit of length
};

/// An entry of [vary].
struct VaryDef {
  enum class How {
    absolute,  ///< the draw is the number, in the file's unit
    relative,  ///< it multiplies the scene's number
    added      ///< it is added to the scene's number
  };
  std::string name;                   ///< as written: "MCL*.stiffness:together"
  std::vector<std::string> patterns;  ///< "MCL*.stiffness"
  bool together = false;              ///< one draw for all numbers that it names
  How how = How::absolute;
  Distribution distribution;
  std::optional<MeshErrorDef> mesh_error;  ///< instead of a distribution
  SourceLocation where;
};

/// Correlations of the normal scores of some factors.
struct CorrelationDef {
  std::vector<std::string> factors;  ///< names of factors (sweep_factors.h)
  std::vector<SourceLocation> places;
  MatX matrix;
  SourceLocation where;
};

/// The scene with something changed; each sample is solved in every one of them.
struct WhatIfDef {
  std::string name;
  SceneChanges changes;
  SourceLocation where;
};

/// Columns of results.csv at rows.
struct KeepDef {
  struct Column {
    std::string pattern;
    SourceLocation where;
  };
  struct Row {
    enum class Kind { value, all, last, max, min } kind = Kind::value;
    double value = 0;  ///< of the main coordinate, in its column's unit
    SourceLocation where;
  };
  std::vector<Column> columns;
  std::vector<Row> rows;
};

/// Something that happens in a sample or not: a column beyond a limit at a row; at any row where `keep` names its
/// extreme.
struct EventDef {
  std::string name;
  KeepDef keep;       ///< one pattern, one row
  bool above = true;  ///< beyond the limit is above it
  double limit = 0;   ///< in the column's unit
};

/// The samples of which the whole results.csv is kept.
struct TablesDef {
  struct Word {
    std::string text;  ///< a class, "jumped" or the name of an event
    SourceLocation where;
  };
  struct Sample {
    std::uint64_t number = 0;
    SourceLocation where;
  };
  bool all = false;
  std::vector<Word> words;
  std::vector<Sample> samples;

  bool empty() const { return !all && words.empty() && samples.empty(); }
};

struct SceneFileDef {
  std::string path;
  SourceLocation where;
};

struct SweepDef {
  std::string file, title;
  std::vector<SceneFileDef> scenes;
  DesignKind design = DesignKind::monte_carlo;
  std::uint64_t samples = 1;  ///< of designs that do not count their own; the blocks of `indices`
  std::uint64_t seed = 1;
  bool indices = false;               ///< Saltelli's scheme: Sobol indices of every factor
  std::vector<double> probabilities;  ///< levels of distributions in a factorial or one-at-a-time design
  int resolution = 4;                 ///< of a fractional factorial design
  std::string points;                 ///< CSV file of the design `points`
  SourceLocation points_where;
  std::vector<VaryDef> vary;
  std::optional<CorrelationDef> correlation;
  std::vector<WhatIfDef> what_ifs;  ///< the first: the scene as it is
  std::vector<KeepDef> keep;
  std::vector<EventDef> events;
  TablesDef tables;
};

/// How the name of a mesh in [vary] ends, behind that of its surface.
inline constexpr const char* kMeshError = ".mesh_error";

inline constexpr const char* kAsItIs = "as_is";

/// "latin_hypercube"
const char* to_string(DesignKind design);

/// A random sample of the factors' distributions, of which means and percentiles are estimates.
inline bool is_random(DesignKind design) { return design <= DesignKind::sobol; }

}  // namespace genu
