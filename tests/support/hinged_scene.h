// A tree of bodies on hinges with everything that a motion without contacts can have.
#pragma once

#include <string>

#include "support/scene_model.h"

namespace genu::test {

inline const std::string kHingedTree = R"(format = 1
units = { length = "mm", angle = "deg" }
gravity = [0.5, -9, 2]
[body.ground]
fixed = true
[body.thigh]
mass = 2
centre_of_mass = [10, -80, 5]
inertia = [0.02, 0.018, 0.025, 0.002, -0.001, 0.003]
[body.shank]
mass = 1.5
centre_of_mass = [-5, -60, 8]
inertia = [0.01, 0.004, 0.012]
[body.foot]
mass = 0.5
centre_of_mass = [30, -10, 0]
inertia = [0.001, 0.002, 0.0015]
[body.patella]
mass = 0.2
centre_of_mass = [12, 3, 1]
inertia = [1e-4, 1.5e-4, 2e-4]
[joint.ankle]
type = "fixed"
parent = "shank"
child = "foot"
origin = [4, -130, 2]
[joint.knee]
type = "revolute"
parent = "thigh"
child = "shank"
origin = [3, -160, 6]
axis = [0.1, 0.2, -1]
stiffness = 0.4
damping = 0.02
limits = { from = -20, to = 30, stiffness = 3 }
[joint.hip]
type = "revolute"
parent = "ground"
child = "thigh"
origin = [20, 30, -10]
axis = [1, 0.3, 0.2]
stiffness = 0.1
[joint.groove]
type = "revolute"
parent = "thigh"
child = "patella"
origin = [25, -140, 0]
axis = [0, 0.1, 1]
damping = 0.005
[ligament.tendon]
from = { body = "shank", point = [20, -30, 5] }
to = { body = "patella", point = [20, -10, 2] }
law = "spring"
stiffness = 10
slack_length = 90
damping = 0.02
[ligament.band]
from = { body = "ground", point = [40, 40, 0] }
via = [{ body = "thigh", point = [30, -20, 10] }, { body = "patella", point = [15, 12, 0] }]
to = { body = "foot", point = [50, 0, 3] }
law = "linear"
stiffness = 3
slack_length = 200
damping = 0.004
[ligament.cord]
from = { body = "ground", point = [-40, 0, 5] }
to = { body = "shank", point = [-10, -20, -8] }
law = "blankevoort"
stiffness = 800
slack_length = 150
transition_strain = 0.06
[load.push]
body = "foot"
point = [10, 5, 0]
force = [3, -7, 2]
moment = [0.1, 0.2, -0.3]
[load.thrust]
body = "shank"
point = [0, -100, 4]
force = [5, 1, 2]
frame = "body"
[load.muscle]
body = "shank"
point = [-20, -10, 0]
toward = { body = "ground", point = [-30, 50, 0] }
magnitude = 12
[load.drive]
on = "knee.angle"
scale = { sine = { amplitude = 4, frequency = 0.5, start = 0 } }
[dynamics]
duration = 1
output_interval = 0.1
tolerance = 1e-9
)";

inline JointModel hinged_model(const std::string& text = kHingedTree) {
  Diagnostics out;
  const auto scene = parse_scene(text, "s", out);
  for (const Diagnostic& d : out.items())
    if (d.severity == Diagnostic::Severity::error) ADD_FAILURE() << to_string(d);
  if (!scene) return {};
  std::vector<std::shared_ptr<const Surface>> surfaces;
  for (const SurfaceDef& s : scene->surfaces) surfaces.push_back(formula_surface(s));
  auto model = build_model(place(*scene), surfaces, out);
  for (const Diagnostic& d : out.items())
    if (d.severity == Diagnostic::Severity::error) ADD_FAILURE() << to_string(d);
  return model.value_or(JointModel{});
}

}  // namespace genu::test
