// Scenes for tests of the program, and the program run as a user runs it.
#pragma once

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "support/places.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu::test {

/// A ball on a plate, held by a spring at each side: its equilibria are known.
inline const std::string kBall = R"(format = 1
title = "ball on a plate"
units = { length = "mm", angle = "deg" }
[body.tibia]
fixed = true
[body.femur]
[joint.knee]
type = "free"
parent = "tibia"
child = "femur"
rotations = ["flexion x", "adduction y", "rotation z"]
translations = ["x", "y", "z"]
reference = { z = 20 }
[surface.ball]
body = "femur"
shape = "sphere"
radius = 20
[surface.plate]
body = "tibia"
shape = "plane"
[contact.medial]
surfaces = ["ball", "plate"]
model = "rigid"
[ligament.front]
from = { body = "femur", point = [0, 20, 0] }
to = { body = "tibia", point = [5, 30, -20] }
law = "quadratic"
stiffness = 20000
reference_strain = 0.05
[ligament.back]
from = { body = "femur", point = [0, -20, 0] }
to = { body = "tibia", point = [5, -30, -20] }
law = "quadratic"
stiffness = 20000
reference_strain = 0.05
[ligament.side]
from = { body = "femur", point = [20, 0, 5] }
to = { body = "tibia", point = [30, 0, -20] }
law = "quadratic"
stiffness = 20000
reference_strain = 0.05
[ligament.far]
from = { body = "femur", point = [-20, 0, 5] }
to = { body = "tibia", point = [-30, 0, -20] }
law = "quadratic"
stiffness = 20000
reference_strain = 0.05
[[step]]
prescribe = { "knee.flexion" = [0, 10] }
increments = 5
)";

struct Outcome {
  int exit_code = -1;  ///< -1: ended by a signal
  std::string out, err;
};

inline std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

/// Runs a command of the shell.
inline Outcome shell(const std::string& command) {
  const TemporaryFolder folder;
  const int status = std::system(("(" + command + ") >" + (folder / "out") + " 2>" + (folder / "err")).c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(folder / "out"), read_file(folder / "err")};
}

/// Runs `genu ARGUMENTS`; longer than 120 s counts as a hang (exit code 124). Whatever does not end well ends with what
/// to do next.
inline Outcome genu(const std::string& arguments) {
  Outcome done = shell("timeout 120 " + genu::test::program() + " " + arguments);
  if (done.exit_code >= 1 && done.exit_code <= 3) {
    EXPECT_EQ(last_line(done.err).rfind("what to do: ", 0), 0u) << "genu " << arguments << "\n" << done.err;
  }
  return done;
}

}  // namespace genu::test
