// genu laxity knee.toml --at 0,30,60,90 --anterior 134 --without "ACL*" --out out/laxity
//   1. read scene and meshes; refuse with every error at once
//   2. at each flexion angle the neutral pose, then each load up, down and back; with changes the scene as written
//   first
//   3. print laxity, coupled motions and ligament forces; write laxity.csv, laxity.html, pictures, summary.json
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include "advice.h"
#include "changes.h"
#include "commands.h"
#include "genu/core/units.h"
#include "genu/study/laxity.h"

namespace genu::cli {
namespace {

constexpr double kMostLoad = 1e5;
constexpr int kMostIncrements = 1000;

struct LaxityArguments {
  std::string scene;
  SceneChanges changes;
  std::optional<std::string> folder;
  std::vector<double> at = {0, 30, 60, 90};
  double anterior = 134, varus = 10, internal = 5, compression = 0;
  int increments = 10;
  bool envelope = false, quiet = false;
};

int test(const LaxityArguments& arguments, const std::vector<LaxityTest>& tests) {
  LaxityChoice choice;
  choice.tests = tests;
  choice.compression = arguments.compression;
  choice.increments = arguments.increments;
  choice.envelope = arguments.envelope;
  choice.cancelled = stop_on_interrupt();
  for (const double angle : arguments.at) choice.flexions.push_back(units::kDegree * angle);
  Diagnostics diagnostics;
  LaxityResult result;
  const int code = run_laxity({arguments.scene, arguments.changes}, arguments.folder, choice, diagnostics, result);
  print(diagnostics, code == kFailed);
  if (code == kRefused) return code;
  if (!arguments.quiet) fmt::print("{}\n\n{}\n", printable(result.title), result.text);
  if (!arguments.quiet)
    for (const std::string& words : result.scenes.back().knee.prepared.scene.changed.words)
      fmt::print("  {:<12}{}\n", "changed", printable(words));
  for (const std::string& sentence : result.verdict)
    fmt::print("  {:<12}{}\n", &sentence == &result.verdict.front() ? "verdict" : "", printable(sentence));
  if (code != kFailed && arguments.folder && !arguments.quiet)
    fmt::print("  {:<12}{}/laxity.csv, laxity_summary.csv, laxity.html, pictures, summary.json\n", "written",
               result.folder);
  return code;
}

}  // namespace

void add_laxity(CLI::App& command, int& exit_code) {
  auto arguments = std::make_shared<LaxityArguments>();
  command.add_option("SCENE", arguments->scene, "scene file (TOML); the knee's joint has grood_suntay")->required();
  command.add_option("--at", arguments->at, "flexion angles in deg, positive where the knee bends")
      ->delimiter(',')
      ->check(number_within(-180, 180))
      ->capture_default_str();
  const auto load = [&](const char* name, double& value, const char* help) {
    return command.add_option(name, value, help)->check(number_within(1e-6, kMostLoad))->capture_default_str();
  };
  CLI::Option* anterior = load("--anterior", arguments->anterior,
                               "drawer force in N, anterior and posterior, at the tibia's origin of grood_suntay");
  CLI::Option* varus = load("--varus", arguments->varus, "moment in N m, varus and valgus, about the floating axis");
  CLI::Option* internal =
      load("--internal", arguments->internal, "moment in N m, internal and external, about the tibia's long axis");
  command
      .add_option("--compression", arguments->compression,
                  "force in N along the tibia's long axis that presses it against the femur, at all poses")
      ->check(number_within(0, kMostLoad))
      ->capture_default_str();
  command.add_option("--increments", arguments->increments, "steps from 0 to the full load")
      ->check(CLI::Range(1, kMostIncrements))
      ->capture_default_str();
  command.add_flag("--envelope", arguments->envelope,
                   "hold the full loads while the knee bends from the smallest to the largest angle as well");
  add_changes(command, arguments->changes);
  command.add_option("-o,--out", arguments->folder, "folder for the results, replaced as a whole at the end");
  command.add_flag("--quiet", arguments->quiet, "print the verdict only");
  command.footer(
      "Without --anterior, --varus and --internal all three tests are made with the loads above; with one of them only "
      "those named."
      "\nExit code 0: all curves complete; 3: a curve ends early, the verdict says at what load and why; 4: "
      "complete, with doubts, which the verdict says; 2: refused."
      "\nExample: genu laxity knee.toml --at 0,30,60,90 --anterior 134 --without \"ACL*\" --out out/laxity");
  advice().hint(
      "laxity",
      "the verdict above says which curve ends, at what load and why; all other rows of laxity.csv are valid");
  command.callback([arguments, anterior, varus, internal, &exit_code] {
    const bool all = anterior->count() + varus->count() + internal->count() == 0;
    std::vector<LaxityTest> tests;
    if (all || anterior->count() > 0) tests.push_back({LaxityTest::Kind::drawer, arguments->anterior});
    if (all || varus->count() > 0) tests.push_back({LaxityTest::Kind::varus, arguments->varus});
    if (all || internal->count() > 0) tests.push_back({LaxityTest::Kind::rotation, arguments->internal});
    exit_code = test(*arguments, tests);
  });
}

}  // namespace genu::cli
