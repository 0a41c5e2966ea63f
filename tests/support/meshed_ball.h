// A ball as triangles on a plate, pressed onto it: held in its place by springs it rises and falls with what its mesh
// has at the bottom.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_writer.h"
#include "genu/surface/analytic.h"
#include "support/temporary_folder.h"

namespace genu::test {

inline const std::string kMeshedBall = R"(format = 1
title = "meshed ball on a plate"
units = { length = "mm", angle = "deg" }
[body.plate]
fixed = true
[body.ball]
[joint.j]
type = "free"
parent = "plate"
child = "ball"
rotations = ["rx x", "ry y", "rz z"]
translations = ["x", "y", "z"]
reference = { z = 20 }
[surface.skin]
body = "ball"
shape = "mesh"
file = "ball.ply"
units = "mm"
[surface.floor]
body = "plate"
shape = "plane"
[contact.c]
surfaces = ["skin", "floor"]
model = "rigid"
[ligament.front]
from = { body = "plate", point = [0, 100, 20] }
to = { body = "ball", point = [0, 0, 0] }
law = "linear"
stiffness = 1000
slack_length = 95
[ligament.back]
from = { body = "plate", point = [0, -100, 20] }
to = { body = "ball", point = [0, 0, 0] }
law = "linear"
stiffness = 1000
slack_length = 95
[load.weight]
body = "ball"
force = [0, 0, -50]
[[step]]
prescribe = { "j.rx" = [0, 10], "j.ry" = 0, "j.rz" = 0, "j.x" = 0 }
increments = 2
)";

constexpr double kBallRadius = 20e-3;

/// Writes the scene and its mesh, 2 mm edges.
inline std::string meshed_ball(const TemporaryFolder& folder, const std::string& scene = kMeshedBall) {
  const auto ball = make_sphere({}, kBallRadius, false);
  EXPECT_EQ(write_ply(ball->triangles(2e-3, Vec3::Zero(), 0.1), folder / "ball.ply", 1e-3, ""), "");
  return folder.write("ball.toml", scene);
}

/// A study of it whose mesh errs: `head` are its keys before the tables.
inline std::string meshed_ball_study(const TemporaryFolder& folder, const std::string& head,
                                     const std::string& error = "{ sd = 0.02, correlation_length = 15 }") {
  meshed_ball(folder);
  return folder.write("study.toml", "format = 1\nscene = \"ball.toml\"\n" + head + "[vary]\n\"skin.mesh_error\" = " +
                                        error + "\n[[keep]]\ncolumns = \"j.z\"\nat = [0, 10]\n");
}

}  // namespace genu::test
