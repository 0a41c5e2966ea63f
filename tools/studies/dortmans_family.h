// The numbers that the report of Dortmans et al. 1984 no longer tells: a search for sets of them with which all of its
// statements hold at once, in either reading of "15 and 5 mm".
//
// Free are, within bounds chosen from anatomy about the springs of meshes/dortmans1984: both ends of each spring in the
// sagittal plane, its reference strain and stiffness, the condyles' distance and the slope of the plateaus. An
// evolution strategy with a variance of its own for each number (sep-CMA-ES: Ros and Hansen 2008, PPSN X, 296-305)
// lowers the sum of squares of what the statements are missed by. It starts from several seeds, so that a family is
// found.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "genu/scene/scene.h"
#include "studies/dortmans_study.h"

namespace genu::studies {

/// A free number: what the set's entry in [-1, 1] is multiplied by and changes.
struct FreeNumber {
  std::string name;  ///< "AAC.from.y_mm"
  double span = 0;   ///< in the name's unit; of a stiffness the factor to the power of the entry
};
std::vector<FreeNumber> free_numbers(const Scene& scene);

/// The scene with a set of them.
Scene with_numbers(Scene scene, const std::vector<double>& set);

/// A statement of the report on a solved scene.
struct DortmansStatement {
  std::string words, measured;
  double missed = 0;  ///< 0 where it holds
  bool holds() const { return missed == 0; }
};
std::vector<DortmansStatement> statements_of(const DortmansReading& reading);

/// The best set from a seed, and what it misses (0: every statement holds).
struct FamilyMember {
  std::vector<double> set;
  double missed = 0;
};
FamilyMember search_family(const Scene& scene, std::uint64_t seed, int generations);

/// A member as it is kept.
struct KeptMember {
  std::string scene;
  int seed = 0;
  std::vector<double> set;
};
std::vector<KeptMember> read_family(const std::string& file, Diagnostics& out);
std::string family_text(const std::vector<KeptMember>& members, const std::vector<FreeNumber>& numbers);

/// FAMILY.md: every statement with the numbers of both scenes, then with those of the family's members, which are
/// solved anew, and how far their free numbers spread. `folder`: meshes/dortmans1984 with its family.csv.
Files family_files(const std::string& folder, Diagnostics& out);

/// A family searched from `seeds` seeds in both readings: family.csv. Members that miss a statement are left out.
Files searched_family(const std::string& folder, int seeds, int generations, Diagnostics& out);

/// Solves a scene in memory as a reading.
std::optional<DortmansReading> solve_reading(const Scene& scene, Diagnostics& out);

}  // namespace genu::studies
