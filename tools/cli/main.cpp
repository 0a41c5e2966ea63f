// genu: quasi-static equilibrium of articular joints.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "commands.h"
#include "genu/core/diagnostics.h"

namespace {

bool known_command(const CLI::App& app, const std::string& word) {
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  return std::any_of(commands.begin(), commands.end(), [&](const CLI::App* c) { return c->get_name() == word; });
}

int run_command(int argc, char** argv) {
  CLI::App app{
      "genu solves articular joints: the poses in which surfaces, ligaments and loads balance.\n"
      "  genu run SCENE --out DIR             solve a scene, write results.csv, curves.svg, ...\n"
      "  genu check SCENE                     say everything that is wrong with a scene and its meshes\n"
      "  genu explain SCENE                   say what system a scene asks for, before it is solved\n"
      "  genu evaluate SCENE --poses FILE --out DIR   contacts and ligament forces at given poses, nothing solved\n"
      "  genu sensitivity SCENE --of OUTPUTS --to PARAMETERS   which number of a scene matters how much, exactly\n"
      "  genu calibrate SCENE --target CSV --vary PARAMETERS   fit numbers of a scene so that its results follow a "
      "curve\n"
      "  genu fit MESH --out DIR              fit polynomial surfaces to a mesh; --scene SCENE: to all meshes of a "
      "scene\n"
      "  genu mesh SCENE --edge 1 --out DIR   write the analytic surfaces of a scene, or solids, as STL, PLY or OBJ\n"
      "  genu mesh-check FILE ...             say what is wrong with mesh files; --repair OUT mends one",
      "genu"};
  app.set_version_flag("--version", GENU_VERSION_TEXT);
  app.require_subcommand(1);
  int exit_code = 0;
  genu::cli::add_run(app, exit_code);
  genu::cli::add_check(app, exit_code);
  genu::cli::add_explain(app, exit_code);
  genu::cli::add_evaluate(app, exit_code);
  genu::cli::add_sensitivity(app, exit_code);
  genu::cli::add_accuracy(app, exit_code);
  genu::cli::add_calibrate(app, exit_code);
  genu::cli::add_fit(app, exit_code);
  genu::cli::add_mesh(app, exit_code);
  genu::cli::add_mesh_check(app, exit_code);
  if (argc == 1) {
    std::fputs(app.help().c_str(), stdout);
    return genu::cli::kRefused;
  }
  if (const std::string word = argv[1]; !word.empty() && word.front() != '-' && !known_command(app, word)) {
    fmt::print(stderr,
               "genu: there is no command \"{}\"; known: run, check, explain, evaluate, sensitivity, calibrate, fit, "
               "mesh, mesh-check\n",
               genu::printable(word));
    return genu::cli::kRefused;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream said, wrong;
    const int code = app.exit(error, said, wrong);
    std::fputs(said.str().c_str(), stdout);
    std::istringstream lines(wrong.str());  // they quote what was typed
    for (std::string line; std::getline(lines, line);) fmt::print(stderr, "{}\n", genu::printable(line));
    return code == 0 ? 0 : genu::cli::kRefused;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error to report, not a reason to die
  try {
    const int code = run_command(argc, argv);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    std::fputs("genu: standard output cannot be written\n", stderr);
    return code == 0 ? 1 : code;
  } catch (const std::bad_alloc&) {
    std::fputs("genu: out of memory; no result was written, earlier results are untouched\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "genu: internal error: %s; no result was written, earlier results are untouched\n",
                 error.what());
  }
  return 1;
}
