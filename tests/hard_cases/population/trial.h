// One knee of the population: written, solved and judged by the programs a user has, looked at from outside.
#pragma once

#include <cstdint>
#include <string>

#include "hard_cases/population/knee_spec.h"

namespace genu::population {

struct TrialOptions {
  std::string genu;      ///< the program
  std::string data;      ///< see draw_knee()
  std::string folder;    ///< where the knee's own folder is made
  bool keep = false;     ///< leaves it there
  bool compare = false;  ///< with the energy twin, where that knows the knee
  bool mirror = false;   ///< solves its mirror image too
  double seconds = 300;  ///< a run may take
};

struct Trial {
  enum class End {
    solved,     ///< every pose is ok and the judge accepts them
    diagnosed,  ///< not every pose is, genu says why, and the judge accepts those that are
    refused,    ///< genu refuses the scene and says why
    failed
  };
  End end = End::failed;
  std::string kind;
  std::string status;        ///< diagnosed: of the first pose that is not ok
  std::string why;           ///< failed: what is wrong; else what genu said last
  bool grave = false;        ///< failed: crashed, wrote a NaN, rejected by the judge; not: took too long
  int poses = 0;             ///< ok
  int compared = 0;          ///< with the twin
  int mirrored = 0;          ///< rows compared with those in the mirror, and the same
  bool within_bars = false;  ///< the same in the mirror only within the error bars of both
  double seconds = 0;
};

Trial run_trial(std::uint64_t seed, int index, const TrialOptions& options);

}  // namespace genu::population
