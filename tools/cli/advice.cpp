#include "advice.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "advice_table.h"
#include "commands.h"

namespace genu::cli {
namespace {

/// Sections of a scene and the topic of `genu explain` that describes them.
const std::map<std::string, std::string>& topic_of_section() {
  static const std::map<std::string, std::string> topics = {
      {"format", "header"},      {"title", "header"},      {"units", "units"},
      {"gravity", "header"},     {"body", "bodies"},       {"joint", "joints"},
      {"surface", "surfaces"},   {"contact", "contacts"},  {"combination", "combinations"},
      {"ligament", "ligaments"}, {"load", "loads"},        {"step", "steps"},
      {"solver", "solver"},      {"dynamics", "dynamics"}, {"solid", "solids"},
      {"plausible", "plausible"}};
  return topics;
}

std::string first_word(const std::string& key) { return key.substr(0, key.find_first_of(".[ ")); }

/// What to do where only the command is known.
std::string advice_on_command(const std::string& command, int exit_code) {
  const std::map<std::string, std::string>& hints = advice().hints();
  if (exit_code == kNotAllOk)
    if (const auto found = hints.find(command); found != hints.end()) return found->second;
  if (exit_code == kDoubtful)
    return "look at the rows that the verdict names in report.html; [plausible] in the scene sets the limits "
           "(`genu explain plausible`), and `control = \"arc_length\"` follows a path that ends";
  if (exit_code == kFailed)
    return "make room on the disk or in memory, check that the folder can be written, and try again";
  if (command == "explain") return "`genu explain` without a word lists the topics";
  if (command.empty()) return "`genu --help` lists the commands, `genu new NAME` writes a scene to begin with";
  return fmt::format("`genu {} --help` says what it takes, with an example", command);
}

/// What to do about an error that is corrected where it points to.
std::string advice_on_place(const Diagnostic& problem, const std::string& command) {
  const std::string section = first_word(problem.key);
  const auto topic = topic_of_section().find(section);
  if (problem.line > 0 && topic != topic_of_section().end())
    return fmt::format("correct {}; `genu explain {}` lists its keys and what each takes",
                       section == "step" ? "the [[step]]" : "[" + section + (section == "units" ? "]" : " ...]"),
                       topic->second);
  const bool table = problem.file.ends_with(".csv") || problem.file.ends_with(".mot") || problem.file.ends_with(".sto");
  if (problem.line > 0 && table)
    return "correct the table there, or let genu write it again: a first line of names, then a row of numbers for each "
           "pose";
  if (problem.line > 0 && command == "sweep")
    return "correct that line; `genu explain sweep` lists the keys of a study and what each takes";
  if (problem.line > 0) return "correct that line; `genu explain whole-scene` shows a scene with its sections";
  return advice_on_command(command, kRefused);
}

/// What to do about an error in a model of OpenSim.
std::string advice_on_model(const Diagnostic& problem) {
  if (problem.code == Code::no_such_file) return "name the folder of the model's meshes with --geometry";
  return "correct the model there, in OpenSim or in an editor; docs/opensim.md says what genu reads and what it "
         "refuses";
}

}  // namespace

std::string advice_on(const Diagnostic& problem, const std::string& command) {
  if (problem.line > 0 && problem.file.ends_with(".osim")) return advice_on_model(problem);
  const std::string by_code = advice_on_code(problem.code);
  return by_code.empty() ? advice_on_place(problem, command) : by_code;
}

std::string advice_on_status(const std::string& status) {
  static const std::map<std::string, std::string> by_status = {
      {"no_equilibrium",
       "check the signs of the loads, and that something holds each motion that is not prescribed; give a `start` "
       "nearer "
       "to where the joint balances, or follow the step with `control = \"arc_length\"`"},
      {"over_edge", "extend the mesh or the `patch` where contact leaves it, or shorten the motion"},
      {"overlap",
       "check frames, units and outward sides (`inside`) of the surfaces, or give the joint another `start`"},
      {"overconstrained", "if several coordinates are prescribed, prescribe fewer; else use a cartilage layer"},
      {"chatter",
       "follow the step with `control = \"arc_length\"`, or try another `fit_radius`: two active sets exclude each "
       "other "
       "here"},
      {"slips_off", "give the path another `side`, a via point, or a surface that holds it; or shorten the motion"},
      {"lifts_off", "name the surface once more in the path of the ligament, or smooth the hollow out of its mesh"},
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
