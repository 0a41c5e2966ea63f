// genu: quasi-static equilibrium of articular joints.
#include <fcntl.h>
#include <malloc.h>
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
#include "genu/core/disk_cache.h"
#include "genu/scene/words.h"
#include "print_error.h"
#include "registry.h"

namespace {

std::vector<std::string> names_of_commands() {
  std::vector<std::string> names;
  for (const genu::cli::Command& c : genu::cli::registry()) names.push_back(c.name);
  return names;
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
    "genu --help lists all commands; genu COMMAND --help lists the options of one.\n";

/// "--out --quiet": the parser would take the second for the name of a folder.
std::string name_forgotten(int argc, char** argv) {
  const std::vector<std::string> words(argv, argv + argc);
  for (std::size_t i = 1; i < words.size(); ++i)
    if (words[i].starts_with("-o") && words[i].size() > 2)
      return fmt::format("genu: no option {}; did you mean --out FOLDER, or -o FOLDER?", words[i]);
  for (std::size_t i = 1; i + 1 < words.size(); ++i)
    for (const char* const option :
         {"-o", "--out", "--save-failure", "--repair", "--table", "--scene", "--poses", "--target"})
      if (words[i] == option && words[i + 1].starts_with("--"))
        return fmt::format("genu: {} names nothing: \"{}\" is an option", words[i], words[i + 1]);
  return {};
}

/// `genu help` and `genu help COMMAND` are `genu --help` and `genu COMMAND --help`.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

/// Options that the command does not have, a line each, with what was meant.
std::vector<std::string> unknown_options(const CLI::App& app, const std::vector<std::string>& words) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  if (chosen.empty()) return {};
  std::vector<std::string> known, lines;
  for (const CLI::Option* option : chosen.front()->get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (!name.starts_with("--") || name == "--" || std::find(known.begin(), known.end(), name) != known.end()) continue;
    lines.push_back(
        fmt::format("genu {} has no option {}{}", chosen.front()->get_name(), name, genu::did_you_mean(name, known)));
  }
  return lines;
}

int run_command(int argc, char** argv) {
  const std::vector<std::string> words = words_of(argc, argv);
  CLI::App app{"genu solves articular joints: the poses in which surfaces, ligaments and loads balance.\n\n" +
                   genu::cli::command_list(genu::cli::registry()) +
                   "\n`genu COMMAND --help` lists the options of a command; `genu explain` lists topics.",
               "genu"};
  app.set_version_flag("--version", genu::cli::version_text);
  app.require_subcommand(1);
  int exit_code = 0;
  genu::cli::add_commands(app, exit_code);
  if (argc == 1) {
    std::fputs(kFirst, stdout);
    return genu::cli::kRefused;
  }
  if (const std::string& word = words.front(); !word.empty() && word.front() != '-') {
    std::vector<std::string> names = names_of_commands();
    names.emplace_back("help");
    if (std::find(names.begin(), names.end(), word) == names.end())
      return genu::cli::refuse(genu::Code::unknown_command,
                               fmt::format("genu: there is no command \"{}\"{}; known: {}", word,
                                           genu::did_you_mean(word, names), fmt::join(names, ", ")));
    genu::cli::advice().command(word);
  }
  if (const std::string problem = name_forgotten(argc, argv); !problem.empty())
    return genu::cli::refuse(genu::Code::usage, problem);
  try {
    std::vector<std::string> reversed(words.rbegin(), words.rend());  // as the parser takes them
    app.parse(reversed);
  } catch (const CLI::ExtrasError& error) {
    std::vector<std::string> lines = unknown_options(app, words);
    if (lines.empty()) lines.emplace_back(error.what());
    for (const std::string& line : lines) genu::cli::print_error("{}\n", genu::printable(line));
    return genu::cli::kRefused;
  } catch (const CLI::ParseError& error) {
    std::ostringstream said, wrong;
    const int code = app.exit(error, said, wrong);
    std::fputs(said.str().c_str(), stdout);
    std::istringstream lines(wrong.str());  // they quote what was typed
    for (std::string line; std::getline(lines, line);) genu::cli::print_error("{}\n", genu::printable(line));
    return code == 0 ? 0 : genu::cli::kRefused;
  }
  return exit_code;
}

/// A standard stream that is closed: the next file to be opened would take its place, and get what is printed.
void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) == -1 && errno == EBADF)
      // Standard output opens for reading, so that printing fails and is reported.
      static_cast<void>(::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY));
}

/// Whoever gets an error gets what to do about it.
int ended(int code) {
  genu::cli::print_advice(code);
  return code;
}

/// Large arrays come and go while surfaces and trees are built. Their memory is kept for the next one: a page that goes
/// back to the system is faulted in again, which takes a tenth of a short run. At most 1 GB is kept.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  open_standard_streams();
  genu::use_user_cache(true);     // --no-cache turns it off
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
