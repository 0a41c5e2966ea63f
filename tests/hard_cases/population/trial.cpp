#include "hard_cases/population/trial.h"

#include <chrono>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "hard_cases/population/draw_knee.h"
#include "hard_cases/population/knee_files.h"
#include "hard_cases/population/mirror_check.h"
#include "hard_cases/population/process.h"
#include "hard_cases/population/twin_check.h"

namespace genu::population {
namespace {

namespace fs = std::filesystem;

std::string last_line(const std::string& path) {
  std::ifstream in(path);
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && line.rfind("what to do:", 0) != 0) last = line;
  return last;
}

/// What is wrong with how a program ended, "" where it ended as it may.
std::string bad_end(const char* what, const ProcessEnd& end, const std::string& said) {
  if (end.too_long) return fmt::format("{} took too long", what);
  if (end.signal != 0) return fmt::format("{} died of signal {}: {}", what, end.signal, last_line(said));
  if (end.exit_code != 0 && end.exit_code != 2 && end.exit_code != 3 && end.exit_code != 4)
    return fmt::format("{} ended with exit code {}: {}", what, end.exit_code, last_line(said));
  return "";
}

/// Counts poses that are ok; "" or what is wrong with the table.
std::string look_at(const RunTable& results, int exit_code, Trial& out) {
  if (results.rows.empty()) return "no rows were written";
  bool all = true;
  for (std::size_t row = 0; row < results.rows.size(); ++row) {
    const std::string& status = results.text(row, "status");
    if (status != "ok") {
      if (status.empty()) return "a row has no status";
      if (all) out.status = status;
      all = false;
      continue;
    }
    ++out.poses;
    for (const std::string& cell : results.rows[row])
      if (cell.find("nan") != std::string::npos) return fmt::format("row {} is ok and holds {}", row, cell);
  }
  if (all != (exit_code == 0 || exit_code == 4)) return fmt::format("exit code {} does not fit the rows", exit_code);
  out.end = all ? Trial::End::solved : Trial::End::diagnosed;
  return "";
}

/// What genu says the meshes of a scene leave open, found in `folder`.
RunTable error_bars(const std::string& scene, const std::string& folder, const TrialOptions& options) {
  // Some ten runs; where they take too long nothing is left open.
  run_process({options.genu, "run", scene, "--out", folder, "--quiet", "--error-bars"}, folder + ".txt",
              options.seconds);
  return RunTable::read(folder + "/error_bars.csv");
}

/// The mirror image of a knee that was solved to `table`.
std::string try_mirror(const Knee& knee, const std::string& of_knee_scene, std::uint64_t noise_seed,
                       const std::string& of_knee, const TrialOptions& options, const RunTable& table, Trial& out) {
  const std::string folder = of_knee + "/mirror", said = folder + "/run.txt";
  fs::create_directories(folder);
  const std::string scene = write_knee(knee, folder, noise_seed, {true});
  const ProcessEnd run =
      run_process({options.genu, "run", scene, "--out", folder + "/out", "--quiet"}, said, options.seconds);
  if (const std::string wrong = bad_end("genu run of the mirror image", run, said); !wrong.empty()) return wrong;
  const RunTable mirrored = RunTable::read(folder + "/out/results.csv");
  MirrorVerdict verdict = compare_with_mirror(knee, table, mirrored);
  if (!verdict.wrong.empty() && knee.meshed() && !mirrored.rows.empty()) {
    verdict = compare_with_mirror(
        knee, table, mirrored,
        {error_bars(of_knee_scene, of_knee + "/bars", options), error_bars(scene, folder + "/bars", options)});
    out.within_bars = verdict.wrong.empty();
  }
  if (verdict.wrong.empty()) out.mirrored += verdict.compared;
  return verdict.wrong;
}

std::string try_knee(const Knee& knee, std::uint64_t noise_seed, const std::string& folder, const TrialOptions& options,
                     Trial& out) {
  const std::string scene = write_knee(knee, folder, noise_seed);
  const std::string results = folder + "/out", said = folder + "/run.txt", judged = folder + "/judge.txt";
  const ProcessEnd run = run_process({options.genu, "run", scene, "--out", results, "--quiet"}, said, options.seconds);
  if (const std::string wrong = bad_end("genu run", run, said); !wrong.empty()) {
    out.grave = !run.too_long;  // it fails, but says nothing wrong
    return wrong;
  }
  out.why = last_line(said);
  if (run.exit_code == 2) {
    if (out.why.empty()) return "refused without a word";
    out.end = Trial::End::refused;
    return "";
  }
  const RunTable table = RunTable::read(results + "/results.csv");
  if (const std::string wrong = look_at(table, run.exit_code, out); !wrong.empty()) return wrong;
  const ProcessEnd judge =
      run_process({options.genu, "judge", results, "--samples", "60", "--every", "3"}, judged, options.seconds);
  if (const std::string wrong = bad_end("genu judge", judge, judged); !wrong.empty()) return wrong;
  const bool nothing_to_judge = judge.exit_code == 3 && out.poses == 0;
  if (judge.exit_code != 0 && !nothing_to_judge) return "the judge rejects it: " + last_line(judged);
  out.grave = false;
  if (options.mirror && knee.text.empty())
    if (const std::string wrong = try_mirror(knee, scene, noise_seed, folder, options, table, out); !wrong.empty())
      return wrong;
  if (!options.compare || !knee.comparable()) return "";
  const TwinVerdict twin = compare_with_twin(knee, table);
  out.compared = twin.compared;
  return twin.wrong;
}

}  // namespace

Trial run_trial(std::uint64_t seed, int index, const TrialOptions& options) {
  Trial out;
  const auto begin = std::chrono::steady_clock::now();
  const Knee knee = draw_knee(seed, index, options.data);
  out.kind = knee.kind;
  const std::string folder = options.folder + fmt::format("/knee-{}-{}", seed, index);
  fs::create_directories(folder);
  out.grave = true;
  const std::string wrong = try_knee(knee, seed + static_cast<std::uint64_t>(index), folder, options, out);
  if (!wrong.empty()) {
    out.end = Trial::End::failed;
    out.why = wrong;
  } else {
    out.grave = false;
  }
  if (!options.keep) fs::remove_all(folder);
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

}  // namespace genu::population
