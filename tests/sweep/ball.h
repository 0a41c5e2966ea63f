// A ball on a spring, pulled along it: z = L0 (1 + F / K). The rotation about the spring changes nothing; it is the
// main coordinate.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "genu/sweep/merge_sweep.h"
#include "genu/sweep/run_sweep.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

namespace genu::test {

inline const std::string kBallOnSpring = R"(format = 1
title = "ball on a spring"
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.ball]
[joint.j]
type = "free"
parent = "ground"
child = "ball"
rotations = ["rx x", "ry y", "rz z"]
translations = ["x", "y", "z"]
reference = { z = 11 }
[ligament.spring]
from = { body = "ground", point = [0, 0, 0] }
to = { body = "ball", point = [0, 0, 0] }
law = "linear"
stiffness = 1000
slack_length = 10
[load.pull]
body = "ball"
force = [0, 0, 50]
[[step]]
prescribe = { "j.rx" = 0, "j.ry" = 0, "j.rz" = [0, 10], "j.x" = 0, "j.y" = 0 }
increments = 2
)";

/// The same ball of 1 kg in motion: z = z0 + (11 mm - z0) cos(sqrt(K / (L0 m)) t) with z0 = L0 (1 + F / K), while the
/// spring is taut.
inline const std::string kBallInMotion = R"(format = 1
title = "ball on a spring in motion"
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.ball]
mass = 1
inertia = [0.001, 0.001, 0.001]
[joint.j]
type = "free"
parent = "ground"
child = "ball"
rotations = ["rx x", "ry y", "rz z"]
translations = ["x", "y", "z"]
reference = { z = 11 }
[ligament.spring]
from = { body = "ground", point = [0, 0, 0] }
to = { body = "ball", point = [0, 0, 0] }
law = "linear"
stiffness = 1000
slack_length = 10
[load.pull]
body = "ball"
force = [0, 0, 50]
[dynamics]
duration = 0.004
output_interval = 0.003
tolerance = 1e-10
)";

/// A study of the ball in `folder`: `head` are its keys before the tables, `tables` its tables before [[keep]].
inline std::string ball_study(const TemporaryFolder& folder, const std::string& head, const std::string& tables) {
  folder.write("ball.toml", kBallOnSpring);
  return folder.write("study.toml", "format = 1\nscene = \"ball.toml\"\n" + head + tables +
                                        "[[keep]]\ncolumns = \"j.z\"\nat = [0, 7.5, \"last\"]\n");
}

inline const std::string kBallVary = R"([vary]
"spring.stiffness" = { lognormal = 1, sd = 0.2, relative = true }
"pull.force.z" = { uniform = [40, 60] }
)";

inline Sweep ready_sweep(const std::string& study) {
  Diagnostics out;
  auto sweep = prepare_sweep(study, out);
  EXPECT_TRUE(sweep.has_value()) << messages(out);
  return sweep ? std::move(*sweep) : Sweep{};
}

/// Runs one shard, which has to succeed.
inline SweepOutcome ran(const Sweep& sweep, const std::string& folder, ShardId shard = {}, int threads = 2) {
  SweepOptions options;
  options.shard = shard;
  options.threads = threads;
  Diagnostics out;
  SweepOutcome outcome;
  EXPECT_EQ(run_shard(sweep, folder, options, out, outcome), kExitOk) << messages(out);
  return outcome;
}

inline void merge(const std::string& folder) {
  Diagnostics out;
  std::string text;
  EXPECT_EQ(merge_sweep(folder, out, text), kExitOk) << messages(out);
}

}  // namespace genu::test
