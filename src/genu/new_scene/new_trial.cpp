#include "genu/new_scene/new_trial.h"

#include "genu/new_scene/new_ligaments.h"

namespace genu {

void say_stopped(Diagnostics& out) {
  out.error(Code::interrupted, {}, "stopped while the scene was tried out: nothing is written");
}

void refer_to_balance(Words& words, const Solution& found) {
  const std::string pose = found.summary.poses_solved > 0 ? balanced_reference(found.poses) : "";
  if (pose.empty()) return;
  words["reference"] = pose;
  words["reference_note"] = "In balance under a twentieth of the load, as the trial found it";
}

std::optional<Solution> try_out(const std::string& file, const std::string& name, const NewScene& asked, bool first,
                                Diagnostics& out) {
  RunOptions options;
  options.cancelled = asked.cancelled;
  options.keep_partial = true;
  Diagnostics warnings;
  const auto prepared = prepare(file, warnings);
  std::optional<Solution> found;
  if (prepared)
    found = prepared->scene.dynamics ? move_all(*prepared, options, warnings) : solve_all(*prepared, options, warnings);
  if (found && found->stopped == "interrupted") {
    say_stopped(out);
    return std::nullopt;
  }
  const auto of_meshes = [](const Diagnostic& d) {
    return d.code == Code::mesh_repaired || d.code == Code::layout || d.code == Code::no_thickness;
  };
  for (Diagnostic d : warnings.items())
    if (d.severity == Diagnostic::Severity::error ? !found : first && of_meshes(d)) {
      if (d.file == file) d.file = name;
      out.add(d);
    }
  return found;
}

}  // namespace genu
