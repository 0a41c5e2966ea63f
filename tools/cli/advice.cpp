#include "advice.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

#include <fmt/format.h>

#include "commands.h"

namespace genu::cli {
namespace {

bool holds(const std::string& text, const char* piece) { return text.find(piece) != std::string::npos; }

struct RuleAdvice {
  const char* piece;  ///< of the rule
  const char* what;   ///< {file}: the file that the error is about
};

/// Hints by a piece of the rule, whatever the key. The first match counts.
constexpr std::array<RuleAdvice, 30> kByRule = {{
    {"there is no command", "`genu --help` lists the commands, `genu new NAME` writes a scene to begin with"},
    {"which would be lost", "name another folder with --out"},
    {"summary.json counts", "run the scene again: its results are incomplete"},
    {"is the scene that these results are of", "name the scene of these results with --scene, or run it again"},
    {"is no column of the results", "the first line of results.csv names its columns"},
    {"is no results.csv", "name the folder that `genu run` wrote"},
    {"checksums of another version", "run the scene again with this version"},
    {"is no summary of a run", "name the folder that `genu run` wrote"},
    {"in one frame", "`genu new --help` says what the meshes must be, and which options name their axes and unit"},
    {"one unit", "`genu new --help` says what the meshes must be, and which options name their axes and unit"},
    {"swapped", "`genu new --help` says what the meshes must be, and which options name their axes and unit"},
    {"cannot be written", "name a place that you can write to, or make room there"},
    {"output folder", "name a folder with --out: a new one, or one that holds earlier results of genu"},
    {"will not be replaced", "name another one, or move away what is there"},
    {"no result of genu", "name a folder with --out: a new one, or one that holds earlier results of genu"},
    {"stopped while", "run it again, and let it finish"},
    {"is compared", "write the page to a folder of its own: --out compared.html"},
    {"has no name", "give it one: `genu new knee` writes knee/knee.toml"},
    {"exists already", "choose a name that is not taken"},
    {"--femur", "`genu new --help` shows how meshes are named; `genu mesh` writes meshes of shapes"},
    {"no pose can be trusted",
     "`genu mesh-check FILE --repair OUT` repairs a mesh; name the repaired file in the scene"},
    {"overlap by",
     "give the joint a `start` where the surfaces are apart, or turn an outward side round with `inside`; "
     "`genu explain joints` and `genu explain surfaces` say how"},
    {"no such file", "check the name; it counts from the folder you are in, a mesh's name from the scene's folder"},
    {"is a folder", "name the file in it"},
    {"is not UTF-8", "save the file as UTF-8 text"},
    {"triangles",
     "`genu mesh-check FILE` says what is wrong with a mesh; export it again, or repair it with --repair OUT"},
    {"mesh",
     "`genu mesh-check FILE` says what is wrong with a mesh, and in which unit it seems to be; --repair OUT "
     "repairs it"},
    {"coordinates", "`genu mesh-check FILE` says what is wrong with a mesh; export it again"},
    {"report.html", "run that scene again without --no-report"},
    {"another build", "run the scene again, without --resume"},
}};

/// Sections of a scene and the topic of `genu explain` that describes them.
const std::map<std::string, std::string>& topic_of_section() {
  static const std::map<std::string, std::string> topics = {
      {"format", "header"},      {"title", "header"},      {"units", "units"},
      {"gravity", "header"},     {"body", "bodies"},       {"joint", "joints"},
      {"surface", "surfaces"},   {"contact", "contacts"},  {"combination", "combinations"},
      {"ligament", "ligaments"}, {"load", "loads"},        {"step", "steps"},
      {"solver", "solver"},      {"dynamics", "dynamics"}, {"solid", "solids"}};
  return topics;
}

std::string first_word(const std::string& key) { return key.substr(0, key.find_first_of(".[ ")); }

/// What to do where only the command is known.
std::string advice_on_command(const std::string& command, int exit_code) {
  const std::map<std::string, std::string>& hints = advice().hints();
  if (exit_code == kNotAllOk)
    if (const auto found = hints.find(command); found != hints.end()) return found->second;
  if (exit_code == kFailed)
    return "make room on the disk or in memory, check that the folder can be written, and try again";
  if (command == "explain") return "`genu explain` without a word lists the topics";
  if (command.empty()) return "`genu --help` lists the commands, `genu new NAME` writes a scene to begin with";
  return fmt::format("`genu {} --help` says what it takes, with an example", command);
}

}  // namespace

std::string advice_on(const Diagnostic& problem, const std::string& command) {
  if (holds(problem.rule, "is not there") &&
      (problem.file.ends_with("results.csv") || problem.file.ends_with("summary.json")))
    return "name the folder that `genu run` wrote, with its results.csv and summary.json";
  const std::string section = first_word(problem.key);
  const auto topic = topic_of_section().find(section);
  const bool of_scene = problem.line > 0 && topic != topic_of_section().end();
  const std::string last = problem.key.substr(problem.key.rfind('.') + 1);
  for (const RuleAdvice& r : kByRule)
    if (holds(problem.rule, r.piece) && (!of_scene || last == "file" || last == "bone" || holds("overlap by", r.piece)))
      return r.what;
  if (of_scene)
    return fmt::format("correct {}; `genu explain {}` lists its keys and what each takes",
                       section == "step" ? "the [[step]]" : "[" + section + (section == "units" ? "]" : " ...]"),
                       topic->second);
  const bool table = problem.file.ends_with(".csv") || problem.file.ends_with(".mot") || problem.file.ends_with(".sto");
  if (problem.line > 0 && table)
    return "correct the table there, or let genu write it again: a first line of names, then a row of numbers for each "
           "pose";
  if (problem.line > 0 && !holds(problem.rule, "not valid TOML"))
    return "correct that line; `genu explain whole-scene` shows a scene with its sections";
  if (problem.line > 0)
    return "correct the file there (TOML, https://toml.io: strings in quotes, tables in [ ]); the rest is read once "
           "this is right";
  return advice_on_command(command, kRefused);
}

std::string advice_on_status(const std::string& status) {
  static const std::map<std::string, std::string> by_status = {
      {"no_equilibrium",
       "try smaller `increments`, or a `start` nearer to where the joint balances; check that something "
       "holds each motion that is not prescribed"},
      {"over_edge", "extend the mesh or the `patch` where contact leaves it, or shorten the motion"},
      {"overlap",
       "check frames, units and outward sides (`inside`) of the surfaces, or give the joint another `start`"},
      {"overconstrained", "prescribe fewer coordinates"},
      {"chatter", "try smaller `increments`, or another `fit_radius`: two active sets exclude each other here"},
      {"flawed_mesh", "repair the mesh with `genu mesh-check FILE --repair OUT`, or keep contact away with `patch`"},
      {"undetermined", "prescribe the motion that the verdict calls free, or add the ligament or load that holds it"}};
  const auto found = by_status.find(status);
  return found == by_status.end() ? std::string()
                                  : found->second + "; `genu explain " + status + "` says what the status means";
}

std::vector<std::string> Advice::lines(int exit_code) const {
  std::vector<std::string> out;
  const auto say = [&](const std::string& line) {
    constexpr std::size_t kMost = 3;
    if (!line.empty() && out.size() < kMost && std::find(out.begin(), out.end(), line) == out.end())
      out.push_back(line);
  };
  if (exit_code != kFailed)
    for (const Diagnostic& d : errors_) say(advice_on(d, command_));
  if (out.empty()) say(next_);
  if (out.empty() && exit_code == kNotAllOk) say(advice_on_status(status_));
  if (out.empty()) say(advice_on_command(command_, exit_code));
  return out;
}

Advice& advice() {
  static Advice the_one;
  return the_one;
}

}  // namespace genu::cli
