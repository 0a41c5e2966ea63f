// What a test has run, judged (judged_table.h): of a scene that was prepared, a folder, a file.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "genu/assemble/changed_scene.h"
#include "genu/judge/run_folder.h"
#include "genu/scene/reader.h"
#include "genu/study/run_scene.h"
#include "support/judged_table.h"

namespace genu::test {

/// The same of a scene that was prepared: from its file where there is one, else as it was read.
inline void expect_judged_ok(const Prepared& prepared, const ResultTable& poses) {
  Diagnostics out;
  std::error_code none;
  if (std::filesystem::is_regular_file(prepared.scene.file, none)) {
    const auto scene = read_scene(prepared.scene.file, out);
    ASSERT_TRUE(scene.has_value()) << prepared.scene.file;
    return expect_judged_ok(*scene, poses);
  }
  expect_judged_ok(prepared.source, poses);
}

/// A solution, judged on its way to the test.
inline Solution judged(const Prepared& prepared, Solution solution) {
  expect_judged_ok(prepared, solution.poses);
  return solution;
}

/// The folder that a run has written.
inline void expect_folder_judged_ok(const std::string& folder, const std::string& scene = {}) {
  Diagnostics out;
  const auto found = judge::read_run_folder(folder, scene, out);
  for (const Diagnostic& d : out.items())
    if (d.severity == Diagnostic::Severity::error) ADD_FAILURE() << to_string(d);
  if (!found) return;
  const auto read = read_changed_scene(found->scene, out);
  ASSERT_TRUE(read.has_value()) << found->scene.path;
  const auto rows = static_cast<std::size_t>(std::count(found->results.begin(), found->results.end(), '\n'));
  const auto judgement = judge::judge_results(*read, found->results, folder, quick_judge(rows), out);
  ASSERT_TRUE(judgement.has_value()) << folder;
  EXPECT_TRUE(judgement->accepted()) << folder << "\n" << judge::to_text(*judgement);
}

/// run_scene(), and what it wrote is judged where it wrote something whole.
inline int judged_run(const std::string& scene, const std::string& folder, const RunOptions& options, Diagnostics& out,
                      Solution* solution) {
  const int code = run_scene(scene, folder, options, out, solution);
  if ((code == kExitOk || code == kExitIncomplete) && std::filesystem::exists(folder + "/results.csv"))
    expect_folder_judged_ok(folder, scene);  // it is not there where the run was stopped
  return code;
}

/// What run_scene() found, of a scene's file.
inline void expect_judged_ok(const std::string& scene_file, const ResultTable& poses) {
  Diagnostics out;
  const auto scene = read_scene(scene_file, out);
  ASSERT_TRUE(scene.has_value()) << scene_file;
  expect_judged_ok(*scene, poses);
}

}  // namespace genu::test
