// sweep.json: what a results folder of a sweep belongs to. Written by whoever comes first; all that is done with shards
// later needs this file and no scene.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/sweep/sweep.h"

namespace genu {

struct SweepRecord {
  std::string version, study, title, hash;  ///< study: absolute path of the study file
  std::string design;
  std::uint64_t seed = 1, samples = 1, block = 1, shards = 1;
  bool random = true;  ///< the design is a random sample of the distributions
  struct Case {
    std::string scene, what_if;
  };
  std::vector<Case> cases;
  std::vector<std::string> factors;
  std::vector<std::size_t> mesh_errors;  ///< factors whose draws are no amounts (Factor::mesh_error)
  struct Kept {
    std::string name, column;
    bool at_value = false;  ///< at a value of the main coordinate
    double value = 0;
  };
  std::vector<Kept> kept;
  std::vector<SweepEvent> events;  ///< of the study's own
  std::string main;                ///< column of the main coordinate
  bool tables = false;             ///< whole tables of some samples are kept (table_file.h)

  std::uint64_t runs() const { return cases.size() * samples; }
  bool is_mesh_error(std::size_t factor) const {
    return std::find(mesh_errors.begin(), mesh_errors.end(), factor) != mesh_errors.end();
  }
};

SweepRecord record_of(const Sweep& sweep, std::uint64_t shards);

inline constexpr const char* kSweepRecord = "sweep.json";

/// The record of a folder. Empty, with the reason in `out`, where it has none.
[[nodiscard]] std::optional<SweepRecord> read_record(const std::string& folder, Diagnostics& out);

/// Makes the folder and writes the record, or checks that it is there already. False, with the reason in `out`: the
/// folder holds other things, another study, a changed one, or another number of shards.
[[nodiscard]] bool claim_folder(const std::string& folder, const SweepRecord& record, Diagnostics& out);

}  // namespace genu
