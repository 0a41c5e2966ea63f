// The judge in tests: every pose that a test has called ok is worked out again by code that shares none with the
// solver.
#pragma once

#include <cstdio>
#include <ctime>

#include <gtest/gtest.h>

#include "genu/judge/judge.h"
#include "genu/results/result_table.h"

namespace genu::test {

/// What tests can afford: overlap and pressure in some ten rows of a run, with samples half as dense as `genu judge`'s.
inline judge::Options quick_judge(std::size_t rows) {
  constexpr std::size_t kLookedOver = 8;
  return {.samples = 60, .every = rows / kLookedOver + 1};
}

/// Judges a table of results of a scene as it was read (not centred).
inline void expect_judged_ok(const Scene& scene, const ResultTable& poses, const judge::Options& options) {
  Diagnostics out;
  const std::clock_t begin = std::clock();
  const auto found = judge::judge_results(scene, poses.to_csv(), "results.csv", options, out);
  for (const Diagnostic& d : out.items())
    if (d.severity == Diagnostic::Severity::error) ADD_FAILURE() << to_string(d);
  if (!found) return;
  EXPECT_TRUE(found->accepted()) << judge::to_text(*found);
  std::printf("judged %zu poses in %.2f s of processor time\n", found->judged,
              static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
}
inline void expect_judged_ok(const Scene& scene, const ResultTable& poses) {
  expect_judged_ok(scene, poses, quick_judge(poses.rows()));
}

}  // namespace genu::test
