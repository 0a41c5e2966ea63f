// A hard case: a scene NAME.toml, and beside it NAME.expect.toml with what must come out of it and why that is hard.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/core/types.h"
#include "genu/mesh_care/mesh_damage.h"

namespace genu {

/// A number or word that must stand in a table of results.
struct ExpectedValue {
  enum class Table { results, events, starts };
  Table table = Table::results;
  std::string event;  ///< of events: which kind; `row` counts these
  std::string column;
  std::optional<int> row;  ///< from 1, or from the end where negative; empty: every row that has a number
  std::string value;       ///< a formula (formula.h), columns of the same row in brackets, or the word
  bool is_word = false;
  double tolerance = 0;  ///< in the column's unit
};

/// A mesh file made by rules: a shape of shapes.toml, cut into triangles, then spoilt.
struct MeshRecipe {
  struct Damage {
    MeshDamage kind = MeshDamage::noise;
    double size = 0;            ///< m; of scale: a factor; of subdivide: how often
    Vec3 near = Vec3::Zero();   ///< m: where
    Vec3 shift = Vec3::Zero();  ///< m
  };
  std::string file, shape;
  std::string text;  ///< the file as it is, in the place of a shape
  double edge = 0;   ///< m
  double unit = 1e-3;
  std::vector<Damage> damage;
};

struct Expectation {
  std::string why;            ///< one sentence: why it is hard
  std::string source;         ///< where the expected numbers come from
  std::string safeguard;      ///< mutants/NAME.patch takes it out; empty: none can be
  std::string cannot_switch;  ///< why not
  std::string shortcoming;    ///< what genu still owes here; then the expectation is what it does
  int exit_code = 0;
  std::vector<std::pair<std::string, int>> statuses;  ///< how many rows of each; nothing said where empty
  std::vector<std::pair<std::string, int>> events;    ///< how many of each kind that is named
  std::vector<std::string> says, says_not;
  std::vector<ExpectedValue> values;
  std::vector<MeshRecipe> meshes;
  bool takes_long = false;
  int starts = 0;                      ///< of `genu run --starts`
  std::optional<int> most_iterations;  ///< of Newton's method; of a motion: steps
  double limit = 60;                   ///< s: a case that takes longer is missed
};

struct HardCase {
  std::string family, name;
  std::string scene_file;
  Expectation expected;
};

/// Reads CATALOGUE/FAMILY/NAME.expect.toml. Reports every error in `out`; a safeguard without a patch in
/// CATALOGUE/mutants is one.
std::optional<Expectation> read_expectation(const std::string& path, Diagnostics& out);

/// The cases of a folder FAMILY/NAME.toml, sorted by family and name.
std::vector<HardCase> find_hard_cases(const std::string& folder, Diagnostics& out);

}  // namespace genu
