// A small good scene and the means to spoil it: expect_refused("stiffness = 37200.0", "stiffness = @-2", ...) replaces
// a piece of the scene and expects exactly one error, at the place marked @, so that no error drags others along.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "genu/scene/reader.h"

namespace genu::scene_test {

inline const std::string kGoodScene = R"(format = 1
title = "test knee"
units = { length = "mm", angle = "deg" }

[body.tibia]
fixed = true

[body.femur]

[joint.knee]
type = "free"
parent = "tibia"
child = "femur"
rotations = ["flexion -z", "adduction x", "rotation y"]
translations = ["x", "y", "z"]
reference = { flexion = 30, y = 2.5 }

[surface.ball]
body = "femur"
shape = "sphere"
radius = 20
origin = [1, 2, 3]

[surface.floor]
body = "tibia"
shape = "plane"

[contact.medial]
surfaces = ["ball", "floor"]
model = "rigid"
regions = { inner = "z < 0", outer = "z >= 0 and x < 5" }

[ligament.AAC]
from = { body = "femur", point = [12.25, -7.84, 0.0] }
to = { body = "tibia", point = [-6.04, 4.0, -3.0] }
law = "quadratic"
stiffness = 37200.0
reference_strain = -0.0175

[load.push]
body = "femur"
force = [0, 100, 0]
point = [1, 0, 0]
frame = "body"

[[step]]
prescribe = { "knee.flexion" = [0, 70] }
load = { push = [0, 1] }
increments = 70
)";

inline const std::string kGravity = "gravity = [0, -9.81, 0]\n";

inline std::string all_messages(const Diagnostics& diagnostics) {
  std::string s;
  for (const Diagnostic& d : diagnostics.items()) s += to_string(d) + "\n";
  return s;
}

/// The good scene with the first `piece` replaced.
inline std::string edited(const std::string& piece, const std::string& replacement,
                          const std::string& text = kGoodScene) {
  const std::size_t at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << "the scene has no " << piece;
  if (at == std::string::npos) return text;
  return text.substr(0, at) + replacement + text.substr(at + piece.size());
}

struct Marked {
  std::string text;
  int line = 1, column = 1;
};

/// Takes the marker @ out and says where it stood.
inline Marked unmarked(const std::string& text) {
  Marked m;
  const std::size_t at = text.find('@');
  EXPECT_NE(at, std::string::npos) << "no @ in\n" << text;
  if (at == std::string::npos) return {text};
  for (std::size_t k = 0; k < at; ++k) {
    m.line += text[k] == '\n' ? 1 : 0;
    m.column = text[k] == '\n' ? 1 : m.column + 1;
  }
  m.text = text.substr(0, at) + text.substr(at + 1);
  return m;
}

/// The text marked with @ gives exactly one error, there, with this key and value, and a rule that contains `rule`.
inline void expect_one_error(const std::string& marked_text, const std::string& key, const std::string& found,
                             const std::string& rule) {
  const Marked marked = unmarked(marked_text);
  Diagnostics out;
  EXPECT_FALSE(parse_scene(marked.text, "scene.toml", out).has_value());
  ASSERT_EQ(out.items().size(), 1u) << "wanted: " << key << " = " << found << ": " << rule << "\n" << all_messages(out);
  const Diagnostic& d = out.items()[0];
  const std::string message = to_string(d);
  EXPECT_EQ(d.file, "scene.toml");
  EXPECT_EQ(d.line, marked.line) << message;
  EXPECT_EQ(d.column, marked.column) << message;
  EXPECT_EQ(d.key, key) << message;
  EXPECT_EQ(d.found, found) << message;
  EXPECT_NE(d.rule.find(rule), std::string::npos) << message << "\nwanted: " << rule;
}

inline void expect_refused(const std::string& piece, const std::string& replacement, const std::string& key,
                           const std::string& found, const std::string& rule) {
  SCOPED_TRACE(replacement);
  expect_one_error(edited(piece, replacement), key, found, rule);
}

/// The scene of a text that must be good.
inline Scene good(const std::string& text) {
  Diagnostics out;
  const auto scene = parse_scene(text, "scene.toml", out);
  EXPECT_TRUE(scene.has_value()) << all_messages(out);
  EXPECT_TRUE(out.items().empty()) << all_messages(out);
  return scene.value_or(Scene{});
}

/// The keys of the good scene's surface `ball`.
inline const std::string kBall = "shape = \"sphere\"\nradius = 20\n";

/// The surface `ball` with other keys.
inline SurfaceDef ball_with(const std::string& keys) { return good(edited(kBall, keys)).surfaces.at(0); }

inline void expect_surface_refused(const std::string& keys, const std::string& key, const std::string& found,
                                   const std::string& rule) {
  expect_refused(kBall, keys, "surface.ball" + (key.empty() ? "" : "." + key), found, rule);
}

}  // namespace genu::scene_test
