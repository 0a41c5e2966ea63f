// Every parameter's number is found in the scene as data and in its text, and is the same there.
#include "genu/assemble/parameter_values.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/assemble/scene_values.h"
#include "genu/scene/reader.h"
#include "support/leskovar.h"
#include "support/scenes.h"

namespace genu {
namespace {

/// Every kind of load, law, rest and number of surfaces, in mm and in m.
std::string scene_in_units(bool metres) {
  const auto l = [&](double mm) { return std::to_string(metres ? mm / 1000 : mm); };
  return std::string("format = 1\nunits = { length = \"") + (metres ? "m" : "mm") + R"(", angle = "deg" }
gravity = [0, -9.81, 0]
[body.ground]
fixed = true
[body.link]
mass = 2
centre_of_mass = [)" +
         l(1) + ", " + l(-100) + R"(, 0]
inertia = [0.03, 0.03, 0.04]
[joint.h]
type = "revolute"
parent = "ground"
child = "link"
axis = [0, 0, 1]
stiffness = 0.5
damping = 0.25
limits = { from = -20, to = 30, stiffness = 4 }
[surface.ring]
body = "link"
shape = "torus"
major_radius = )" +
         l(15) + "\nminor_radius = " + l(5) + "\norigin = [" + l(1) + ", " + l(2) + ", " + l(3) + R"(]
[surface.bowl]
body = "ground"
shape = "polynomial"
origin = [0, 0, )" +
         l(-70) + "]\nterms = [[2, 0, " + (metres ? "10.0" : "0.01") + "], [0, 0, " + l(4) + R"(]]
[ligament.a]
from = { body = "ground", point = [)" +
         l(50) + ", 0, " + l(3) + R"(] }
to = { body = "link", point = [0, )" +
         l(-50) + R"(, 0] }
via = [{ body = "ground", point = [)" +
         l(40) + ", " + l(-20) + R"(, 0] }]
law = "blankevoort"
stiffness = 100
transition_strain = 0.06
reference_strain = -0.01
[ligament.b]
from = { body = "ground", point = [)" +
         l(-50) + R"(, 0, 0] }
to = { body = "link", point = [0, )" +
         l(-60) + R"(, 0] }
law = "spring"
stiffness = 10
slack_length = )" +
         l(70) + R"(
damping = 3
[load.push]
body = "link"
force = [1, 2, 3]
moment = [0.1, 0.2, 0.3]
point = [0, )" +
         l(-80) + R"(, 0]
[load.pull]
body = "link"
magnitude = 5
point = [0, )" +
         l(-70) + R"(, 0]
toward = { body = "ground", point = [)" +
         l(90) + R"(, 0, 0] }
[load.turn]
on = "h.angle"
value = 0.7
[dynamics]
duration = 2
output_interval = 0.5
)";
}

TEST(ParameterValues, TextAndDataSayTheSame) {
  const test::TemporaryFolder folder;
  for (const bool metres : {false, true}) {
    const std::string file = folder.write("scene.toml", scene_in_units(metres));
    Diagnostics out;
    auto scene = read_scene(file, out);
    ASSERT_TRUE(scene) << test::messages(out);
    const auto document = parse_toml(scene_in_units(metres), file, out);
    int found = 0;
    for (const Parameter& p : parameters_of(*scene)) {
      const double* number = parameter_number(*scene, p);
      if (number == nullptr) continue;
      const ParameterPlace place = parameter_place(*scene, p, *document);
      ASSERT_TRUE(place.node) << p.name << " at " << place.key;
      EXPECT_NEAR(place.node->number * place.file_unit, *number, 1e-12 * std::abs(*number)) << p.name;
      EXPECT_EQ(p.positive, p.change_text == "1 %") << p.name;
      ++found;
    }
    // a: 3 + 9, b: 3 + 6, ring: 2 + 3, bowl: 2 + 3, push: 9, pull: 1 + 6, turn: 1, link: 4, h: 5
    EXPECT_EQ(found, 12 + 9 + 5 + 5 + 9 + 7 + 1 + 4 + 5);
  }
}

TEST(ParameterValues, NewNumbersAreReadBack) {
  const test::TemporaryFolder folder;
  for (const bool metres : {false, true}) {
    const std::string file = folder.write("scene.toml", scene_in_units(metres));
    Diagnostics out;
    auto scene = read_scene(file, out);
    ASSERT_TRUE(scene);
    std::vector<std::pair<Parameter, double>> values;
    for (const Parameter& p : parameters_of(*scene))
      if (const double* number = parameter_number(*scene, p)) values.emplace_back(p, *number + 0.7 * p.change);
    const std::string text = with_values(file, *scene, values, folder / "out", out);
    auto changed = parse_scene(text, file, out);
    ASSERT_TRUE(changed) << test::messages(out) << text;
    for (const auto& [p, value] : values)
      EXPECT_NEAR(*parameter_number(*changed, p), value, 1e-14 * std::abs(value)) << p.name;
    EXPECT_EQ(changed->title, scene->title);
  }
}

}  // namespace
}  // namespace genu
