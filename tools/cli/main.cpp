// genu: quasi-static equilibrium of articular joints.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "advice.h"
#include "commands.h"
#include "genu/core/diagnostics.h"
#include "genu/scene/words.h"
#include "tell.h"

namespace {

std::vector<std::string> names_of_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* c : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(c->get_name());
  return names;
}

bool known_command(const CLI::App& app, const std::string& word) {
  const std::vector<std::string> names = names_of_commands(app);
  return std::find(names.begin(), names.end(), word) != names.end();
}

std::string known_commands(const CLI::App& app) {
  std::string out;
  for (const std::string& name : names_of_commands(app)) out += (out.empty() ? "" : ", ") + name;
  return out;
}

constexpr char kFirst[] =
    "genu finds the poses in which a joint balances: surfaces, ligaments, loads; and says what each answer is worth.\n"
    "\n"
    "  genu new knee                    write knee/knee.toml, a commented scene that runs; from your own meshes with\n"
    "                                   --femur femur.stl --tibia tibia.stl\n"
    "  genu run SCENE --out DIR         solve it: genu run knee/knee.toml --out out\n"
    "  xdg-open DIR/report.html         look at it in a browser: the joint, its curves, the verdict\n"
    "  genu explain                     what each key, column and status means; genu explain SCENE: what a scene asks "
    "for\n"
    "\n"
    "genu --help lists all commands; genu COMMAND --help says what one takes.\n";

/// "--out --quiet": the parser would take the second for the name of a folder.
std::string name_forgotten(int argc, char** argv) {
  const std::vector<std::string> words(argv, argv + argc);
  for (std::size_t i = 1; i + 1 < words.size(); ++i)
    for (const char* const option :
         {"--out", "--save-failure", "--repair", "--table", "--scene", "--poses", "--target"})
      if (words[i] == option && words[i + 1].starts_with("--"))
        return fmt::format("genu: {} names nothing: \"{}\" is an option", words[i], words[i + 1]);
  return {};
}

int run_command(int argc, char** argv) {
  CLI::App app{
      "genu solves articular joints: the poses in which surfaces, ligaments and loads balance.\n"
      "  genu new NAME                        write a commented scene to start from; --femur F --tibia T: from two "
      "meshes\n"
      "  genu run SCENE --out DIR             solve a scene, write results.csv, curves.svg, ...\n"
      "  genu check SCENE                     say everything that is wrong with a scene and its meshes\n"
      "  genu explain SCENE or TOPIC          say what system a scene asks for, or what a key, column or status means\n"
      "  genu evaluate SCENE --poses FILE --out DIR   contacts and ligament forces at given poses, nothing solved\n"
      "  genu sensitivity SCENE --of OUTPUTS --to PARAMETERS   which number of a scene matters how much, exactly\n"
      "  genu calibrate SCENE --target CSV --vary PARAMETERS   fit numbers of a scene so that its results follow a "
      "curve\n"
      "  genu judge DIR                       check a run's results by code that shares nothing with the solver\n"
      "  genu convert DIR --to vtk|opensim --out DIR   results as files for ParaView or OpenSim\n"
      "  genu fit MESH --out DIR              fit polynomial surfaces to a mesh; --scene SCENE: to all meshes of a "
      "scene\n"
      "  genu mesh SCENE --edge 1 --out DIR   write the analytic surfaces of a scene, or solids, as STL, PLY or OBJ\n"
      "  genu mesh-check FILE ...             say what is wrong with mesh files; --repair OUT mends one\n"
      "  genu reproduce FILE                  see a failure again that genu run --save-failure FILE has saved\n"
      "  genu hard-cases                      run the catalogue of hard cases: is each answered right?",
      "genu"};
  app.set_version_flag("--version", genu::cli::version_text);
  app.require_subcommand(1);
  int exit_code = 0;
  genu::cli::add_new(app, exit_code);
  genu::cli::add_run(app, exit_code);
  genu::cli::add_check(app, exit_code);
  genu::cli::add_explain(app, exit_code);
  genu::cli::add_evaluate(app, exit_code);
  genu::cli::add_sensitivity(app, exit_code);
  genu::cli::add_accuracy(app, exit_code);
  genu::cli::add_calibrate(app, exit_code);
  genu::cli::add_judge(app, exit_code);
  genu::cli::add_compare(app, exit_code);
  genu::cli::add_convert(app, exit_code);
  genu::cli::add_fit(app, exit_code);
  genu::cli::add_mesh(app, exit_code);
  genu::cli::add_mesh_check(app, exit_code);
  genu::cli::add_reproduce(app, exit_code);
  genu::cli::add_hard_cases(app, exit_code);
  genu::cli::add_completion(app, exit_code);
  genu::cli::add_man(app, exit_code);
  if (argc == 1) {
    std::fputs(kFirst, stdout);
    return genu::cli::kRefused;
  }
  if (const std::string word = argv[1]; !word.empty() && word.front() != '-') {
    if (!known_command(app, word))
      return genu::cli::refuse(fmt::format("genu: there is no command \"{}\"{}; known: {}", word,
                                           genu::did_you_mean(word, names_of_commands(app)), known_commands(app)));
    genu::cli::advice().command(word);
  }
  if (const std::string problem = name_forgotten(argc, argv); !problem.empty()) return genu::cli::refuse(problem);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream said, wrong;
    const int code = app.exit(error, said, wrong);
    std::fputs(said.str().c_str(), stdout);
    std::istringstream lines(wrong.str());  // they quote what was typed
    for (std::string line; std::getline(lines, line);) genu::cli::tell("{}\n", genu::printable(line));
    return code == 0 ? 0 : genu::cli::kRefused;
  }
  return exit_code;
}

/// A standard stream that is closed: the next file to be opened would take its place, and get what is printed.
void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) == -1 && errno == EBADF)
      // Standard output for reading: who asked for something to be printed is told that it was not.
      static_cast<void>(::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY));
}

/// Whoever gets an error gets what to do about it.
int ended(int code) {
  genu::cli::print_advice(code);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error to report, not a reason to die
  try {
    const int code = run_command(argc, argv);
    const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (!written) std::fputs("genu: standard output cannot be written\n", stderr);
    return ended(written || code != 0 ? code : genu::cli::kFailed);
  } catch (const std::bad_alloc&) {
    std::fputs("genu: out of memory; no result was written, earlier results are untouched\n", stderr);
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) {  // printing throws
      std::fputs("genu: standard output cannot be written\n", stderr);
      return ended(genu::cli::kFailed);
    }
    std::fprintf(stderr, "genu: internal error: %s; no result was written, earlier results are untouched\n",
                 error.what());
  }
  return ended(genu::cli::kFailed);
}
